// Where the 3D engine does not reach all of the ROM, the copy in RAM must hold every vertex.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "firmware/device/device.h"
#include "hal/memory_regions.h"
#include "tests/support/fake_clock.h"
#include "tests/support/test_meshes.h"

namespace usuzumi {
namespace {

/// No engine answers: boot ends there, when RAM has been divided.
class NoEngine final : public RegisterIo, public InterruptWaiter {
  std::uint32_t do_read32(BusAddress) override { return 0; }
  void do_write32(BusAddress, std::uint32_t) override {}
  Status do_wait(Interrupt, std::uint32_t) override { return {StatusCode::kDeadlineExceeded, "", 0}; }
};

class NoDisplay final : public Display {
  Status do_start(const Scanout&) override { return ok_status(); }
  Status do_show(std::uint32_t, const PictureRectangle*) override { return ok_status(); }
};

class Bus final : public MemoryRegions<2> {
 public:
  Bus(std::span<std::byte> ram, BusAddress rom_base, std::span<std::byte> rom)
      : MemoryRegions({{{0x50000000, ram, true}, {rom_base, rom, false}}}) {}
};

bool found_rom_on_bus(BusAddress rom_base, std::size_t bytes_on_bus) {
  testing::RomImage rom = testing::container_rom({testing::hills(4, 3)});
  std::vector<std::byte> ram(1 << 16);
  Bus bus(ram, rom_base, rom.writable().first(bytes_on_bus));
  NoEngine engine;
  NoDisplay display;
  testing::FakeClock clock;
  firmware::Device device({.registers = engine,
                           .engine_base = 0xF0000000,
                           .interrupts = engine,
                           .display = display,
                           .clock = clock,
                           .memory = bus,
                           .bus = bus,
                           .rom = rom.bytes(),
                           .ram = ram,
                           .vram_base = 0x80000000,
                           .vram_bytes = 1 << 20});
  EXPECT_EQ(device.boot({.width = 64, .height = 64}).code, StatusCode::kUnavailable) << "the engine, and no more";
  EXPECT_EQ(device.thinning().copy().mesh_max(), 1u);
  return device.thinning().copy().rom_on_bus();
}

TEST(RomReach, VerticesMayStayInRomThatTheEngineReadsWhole) {
  const std::size_t whole = testing::container_rom({testing::hills(4, 3)}).bytes().size();
  EXPECT_TRUE(found_rom_on_bus(0x10000000, whole));
  EXPECT_FALSE(found_rom_on_bus(0x10000000, 0));
  EXPECT_FALSE(found_rom_on_bus(0x10000000, whole - 1));
  EXPECT_FALSE(found_rom_on_bus(0x10000002, whole)) << "the engine's addresses are multiples of 4";
}

}  // namespace
}  // namespace usuzumi
