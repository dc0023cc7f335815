// A bus made of a few pieces of memory: what the firmware, the 3D engine and the display reach, and where.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/bus.h"

namespace usuzumi {

/// `bytes` as the CPU sees them lie at `base` on the bus. base + bytes.size() <= 2^32, base > 0, regions apart from
/// each other.
struct MemoryRegion {
  BusAddress base = 0;
  std::span<std::byte> bytes;
  bool writable = true;
};

/// On a board whose addresses are 32 bits wide the bus sees memory where the CPU does.
inline MemoryRegion identity_region(std::span<std::byte> bytes, bool writable = true) {
  return {static_cast<BusAddress>(reinterpret_cast<std::uintptr_t>(bytes.data())), bytes, writable};
}

template <std::size_t N>
class MemoryRegions : public BusMemory, public AddressTranslation {
 public:
  constexpr explicit MemoryRegions(const std::array<MemoryRegion, N>& regions) : regions_(regions) {}

 protected:
  ~MemoryRegions() = default;

 private:
  std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const final {
    return resolve(address, size, false);
  }
  std::span<std::byte> do_write_window(BusAddress address, std::size_t size) final {
    return resolve(address, size, true);
  }

  std::span<std::byte> resolve(BusAddress address, std::size_t size, bool for_writing) const {
    for (const MemoryRegion& region : regions_) {
      if (address < region.base || address - region.base >= region.bytes.size()) continue;
      const std::size_t offset = address - region.base;
      if (size > region.bytes.size() - offset || (for_writing && !region.writable)) return {};
      return region.bytes.subspan(offset, size);
    }
    return {};
  }

  BusAddress do_bus_address(const void* pointer) const final {
    const auto p = reinterpret_cast<std::uintptr_t>(pointer);
    for (const MemoryRegion& region : regions_) {
      const auto first = reinterpret_cast<std::uintptr_t>(region.bytes.data());
      if (p >= first && p - first < region.bytes.size()) return region.base + static_cast<BusAddress>(p - first);
    }
    return 0;
  }

  std::array<MemoryRegion, N> regions_;
};

}  // namespace usuzumi
