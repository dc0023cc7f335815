// The machine's memories on its bus: ROM that cannot be written, RAM, VRAM. Pages are reserved, used only as touched.
#pragma once

#include <cstddef>
#include <span>

#include "hal/memory_regions.h"

namespace usuzumi::sim {

/// Page-aligned memory from the host, zero at first. Throws Error kDevice when the host has none.
class HostPages {
 public:
  explicit HostPages(std::size_t bytes);
  ~HostPages();
  HostPages(const HostPages&) = delete;
  HostPages& operator=(const HostPages&) = delete;

  std::span<std::byte> bytes() const { return {data_, size_}; }
  /// From here on a write by the CPU faults.
  void make_read_only();

 private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;      // as asked for
  std::size_t reserved_ = 0;  // whole pages
};

/// The pages of the three memories, made before the bus over them.
struct MachineMemories {
  HostPages rom, ram, vram;
};

class MemoryMap : private MachineMemories, public MemoryRegions<3> {
 public:
  /// Copies `rom`. Throws Error: kBadInput when the ROM, kDevice when RAM or VRAM exceed their place in the map.
  MemoryMap(std::span<const std::byte> rom, std::size_t ram_bytes, std::size_t vram_bytes);

  /// Where the CPU sees them. Writing to ROM through a cast ends the process with a fault, as the stray write it is.
  std::span<const std::byte> rom() const { return MachineMemories::rom.bytes(); }
  std::span<std::byte> ram() const { return MachineMemories::ram.bytes(); }
  /// For host tools and tests; the firmware leaves VRAM to the engine.
  std::span<std::byte> vram() const { return MachineMemories::vram.bytes(); }

  /// Of the ROM as it is now: equal before and after a run.
  std::uint32_t rom_crc32() const;

 protected:
  ~MemoryMap() = default;
};

}  // namespace usuzumi::sim
