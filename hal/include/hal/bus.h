// The bus as its masters see it: 32-bit addresses, each resolving to memory or to nothing.
//
// The 3D engine and the display controller fetch through BusMemory. On the simulator it is backed by the machine's
// address map; on a board, where addresses are pointers, by its memory map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace usuzumi {

using BusAddress = std::uint32_t;

class BusMemory {
 public:
  /// The `size` bytes at `address` for reading; data() == nullptr when any of them is not memory. `size` 0 gives an
  /// empty span with data() != nullptr only where the address is memory.
  std::span<const std::byte> read_window(BusAddress address, std::size_t size) const {
    return do_read_window(address, size);
  }
  /// The same for writing; data() == nullptr for ROM as well.
  std::span<std::byte> write_window(BusAddress address, std::size_t size) { return do_write_window(address, size); }

 protected:
  ~BusMemory() = default;

 private:
  virtual std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const = 0;
  virtual std::span<std::byte> do_write_window(BusAddress address, std::size_t size) = 0;
};

/// Device registers as the CPU reaches them: aligned 32-bit words.
class RegisterIo {
 public:
  std::uint32_t read32(BusAddress address) { return do_read32(address); }
  void write32(BusAddress address, std::uint32_t value) { do_write32(address, value); }

 protected:
  ~RegisterIo() = default;

 private:
  virtual std::uint32_t do_read32(BusAddress address) = 0;
  virtual void do_write32(BusAddress address, std::uint32_t value) = 0;
};

/// Where a CPU pointer into RAM or ROM lies on the bus. Identity on a board.
class AddressTranslation {
 public:
  /// 0 when the pointer is in no memory that bus masters reach; no such memory begins at address 0.
  BusAddress bus_address(const void* pointer) const { return do_bus_address(pointer); }

 protected:
  ~AddressTranslation() = default;

 private:
  virtual BusAddress do_bus_address(const void* pointer) const = 0;
};

}  // namespace usuzumi
