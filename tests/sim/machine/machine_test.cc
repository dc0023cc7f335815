// The machine by registers and virtual time only. Addresses, offsets and times are literals here.
#include "sim/machine/machine.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>
#include <vector>

#include "machine_fakes.h"

namespace usuzumi::sim {
namespace {

constexpr BusAddress kEngine = 0xF0000000u, kDisplay = 0xF0001000u, kInterrupts = 0xF0002000u;
constexpr BusAddress kEngineStat = kEngine + 0x0C, kEngineLadr = kEngine + 0x10, kEngineLwrd = kEngine + 0x14,
                     kEngineBell = kEngine + 0x18, kEngineIntSt = kEngine + 0x1C, kEngineIntEn = kEngine + 0x20;
constexpr BusAddress kDisplayIntSt = kDisplay + 0x20, kDisplayIntEn = kDisplay + 0x24, kDisplayFcnt = kDisplay + 0x28;
constexpr BusAddress kPend = kInterrupts + 0x08, kEnable = kInterrupts + 0x0C;

/// The small board: CPU 400 MHz (a register access is 40 cycles), engine 100 MHz (4 cycles a clock).
struct MachineTest : ::testing::Test {
  ScriptedEngine engine;
  CountingPanel panel;
  Machine machine{small_board(), {}, engine, panel};

  /// Rings for a list of 4 words in RAM; returns the doorbell's time. With no counters it ends 200 clocks later.
  static std::uint64_t ring(Machine& m) {
    m.write32(kEngineIntEn, 3);
    m.write32(kEngineLadr, 0x50000000u);
    m.write32(kEngineLwrd, 4);
    m.write32(kEngineBell, 1);
    return m.now_cycles();
  }

  /// 16 x 8 picture; lines of 24 pixels at 5 cycles each = 120 cycles; 12 lines; sync in line 9. Returns the start's
  /// time. The first vertical blank begins 3 + 8 lines later, at 1320; then every 1440.
  static std::uint64_t start_display(Machine& m) {
    m.write32(kDisplay + 0x04, 23u << 16);                       // HTP
    m.write32(kDisplay + 0x08, 15);                              // HDP
    m.write32(kDisplay + 0x0C, 17u | 1u << 16 | 0u << 24);       // HSP, HSW, VSW
    m.write32(kDisplay + 0x10, 11u << 16);                       // VTR
    m.write32(kDisplay + 0x14, 8u | 7u << 16);                   // VSP, VDP
    m.write32(kDisplay + 0x140, 0x00FF0001u);                    // L0M: opaque XRGB8888
    m.write32(kDisplay + 0x144, 64);                             // L0ST
    m.write32(kDisplay + 0x148, 0x80000000u);                    // L0DA0
    m.write32(kDisplay + 0x154, 15u | 7u << 16);                 // L0S
    m.write32(kDisplay + 0x100, 1u << 31 | 1u << 16 | 4u << 8);  // DCM1: on, layer 0, divider 5
    return m.now_cycles();
  }
};

// ---- address map

TEST_F(MachineTest, EveryDeviceAnswersAtItsAddress) {
  EXPECT_EQ(machine.read32(0xF0000000u), 0x44335A55u);
  EXPECT_EQ(machine.read32(0xF0001000u), 0x31434455u);
  EXPECT_EQ(machine.read32(0xF0002000u), 0x43495A55u);
  EXPECT_EQ(machine.guest_log().mistakes(), 0u);
}

TEST_F(MachineTest, UnmappedAccessReadsZeroAndIsLogged) {
  EXPECT_EQ(machine.read32(0x00000000u), 0u);
  EXPECT_EQ(machine.read32(0x50000000u), 0u);  // memory, but no register
  machine.write32(0xF0003000u, 7);
  machine.write32(0xEFFFFFFCu, 7);
  EXPECT_EQ(machine.guest_log().mistakes(), 4u);
  EXPECT_EQ(machine.guest_log().unimplemented(), 0u);
  ASSERT_EQ(machine.guest_log().lines().size(), 4u);
  EXPECT_EQ(machine.guest_log().lines()[0], "bus (0x00000000): read: no register here");
  EXPECT_EQ(machine.guest_log().lines()[2], "bus (0xF0003000): write of 0x00000007: no register here");
}

TEST_F(MachineTest, DevicesReportMistakesByRegisterAndAddress) {
  machine.write32(0xF0000000u, 1);
  machine.read32(0xF0001FFCu);
  machine.write32(kEngineLwrd, 0xFF000001u);
  ASSERT_EQ(machine.guest_log().lines().size(), 3u);
  EXPECT_EQ(machine.guest_log().lines()[0],
            "engine ID (0xF0000000): write of 0x00000001: write to a read-only register");
  EXPECT_EQ(machine.guest_log().lines()[1], "display (0xF0001FFC): read: no register at this offset");
  EXPECT_EQ(machine.guest_log().lines()[2],
            "engine LWRD (0xF0000014): write of 0xFF000001: ones written to reserved bits");
}

TEST_F(MachineTest, WhatTheModelLacksIsCountedApartFromMistakes) {
  machine.write32(kDisplay + 0x08, 5u << 16 | 15u);  // HDB, the split display
  EXPECT_EQ(machine.guest_log().mistakes(), 0u);
  EXPECT_EQ(machine.guest_log().unimplemented(), 1u);
  EXPECT_EQ(machine.guest_log().lines()[0], "display HDP (0xF0001008): write of 0x0005000F: not modelled");
}

TEST_F(MachineTest, AFloodOfMistakesIsCountedButNotKept) {
  for (int i = 0; i < 1000; ++i) machine.write32(0, 0);
  EXPECT_EQ(machine.guest_log().mistakes(), 1000u);
  EXPECT_EQ(machine.guest_log().lines().size(), 64u);
}

// ---- engine and time

TEST_F(MachineTest, EveryRegisterAccessTakesFortyClocks) {
  machine.read32(kEngineStat);
  EXPECT_EQ(machine.now_cycles(), 40u);
  machine.write32(kEngineIntEn, 3);
  EXPECT_EQ(machine.now_cycles(), 80u);
}

TEST_F(MachineTest, EngineIsDoneAtItsCycleAndNotOneBefore) {
  const std::uint64_t bell = ring(machine);
  EXPECT_EQ(machine.engine().start_time(), bell);
  machine.idle(799);
  EXPECT_TRUE(machine.engine().busy());
  machine.idle(1);
  EXPECT_FALSE(machine.engine().busy());
  EXPECT_EQ(machine.read32(kPend), 1u);
}

TEST_F(MachineTest, WaitSleepsUntilTheEngineIsDone) {
  const std::uint64_t bell = ring(machine);
  ASSERT_TRUE(machine.wait(Interrupt::kEngineDone, 1'000'000).ok());
  EXPECT_EQ(machine.now_cycles(), bell + 800);
  EXPECT_EQ(machine.read32(kPend), 0u) << "acknowledged at the controller";
  EXPECT_EQ(machine.read32(kEngineIntSt), 1u) << "the device's flag is its driver's to clear";
  EXPECT_EQ(machine.read32(kEnable), 1u);
}

TEST_F(MachineTest, AnInterruptAtTheDeadlineIsInTime) {
  const std::uint64_t bell = ring(machine);
  EXPECT_TRUE(machine.wait(Interrupt::kEngineDone, 2).ok());  // 2 us are 800 cycles
  EXPECT_EQ(machine.now_cycles(), bell + 800);
}

TEST_F(MachineTest, AnInterruptOneCycleAfterTheDeadlineIsNot) {
  const std::uint64_t bell = ring(machine);
  machine.idle(399);
  const Status status = machine.wait(Interrupt::kEngineDone, 1);
  EXPECT_EQ(status.code, StatusCode::kDeadlineExceeded);
  EXPECT_EQ(status.where, 1u);
  EXPECT_EQ(machine.now_cycles(), bell + 799);
  EXPECT_TRUE(machine.wait(Interrupt::kEngineDone, 1).ok());
  EXPECT_EQ(machine.now_cycles(), bell + 800);
}

TEST_F(MachineTest, WaitWithoutACauseEndsByItsTimeout) {
  EXPECT_EQ(machine.wait(Interrupt::kVerticalBlank, 1'000'000).code, StatusCode::kDeadlineExceeded);
  EXPECT_EQ(machine.now_cycles(), 400'000'000u);
  EXPECT_EQ(machine.wait(Interrupt::kDisplayFault, 0).code, StatusCode::kDeadlineExceeded);
  EXPECT_EQ(machine.now_cycles(), 400'000'000u) << "a wait of no time takes none";
}

TEST_F(MachineTest, AnInterruptBeforeTheWaitIsNotLost) {
  ring(machine);
  machine.idle(10'000);
  const std::uint64_t before = machine.now_cycles();
  EXPECT_TRUE(machine.wait(Interrupt::kEngineDone, 0).ok());
  EXPECT_EQ(machine.now_cycles(), before);
}

TEST_F(MachineTest, OneInterruptEndsOneWait) {
  ring(machine);
  EXPECT_TRUE(machine.wait(Interrupt::kEngineDone, 100).ok());
  EXPECT_EQ(machine.wait(Interrupt::kEngineDone, 100).code, StatusCode::kDeadlineExceeded) << "nobody cleared the flag";
}

TEST_F(MachineTest, AClearedCauseEndsNoLaterWait) {
  ring(machine);
  machine.idle(800);
  machine.write32(kEngineIntSt, 1);
  EXPECT_EQ(machine.wait(Interrupt::kEngineDone, 100).code, StatusCode::kDeadlineExceeded);
}

TEST_F(MachineTest, PollingMakesTimePass) {
  const std::uint64_t bell = ring(machine);
  int polls = 0;
  while ((machine.read32(kEngineStat) & 1) != 0) ASSERT_LT(++polls, 1000);
  EXPECT_EQ(polls, 19);
  EXPECT_EQ(machine.now_cycles(), bell + 800);
}

TEST_F(MachineTest, WorkOfTheCpuOverlapsTheEngine) {
  const std::uint64_t bell = ring(machine);
  machine.charge(CpuWork::kEdgeCollapsed, 2);  // 1000 clocks
  EXPECT_FALSE(machine.engine().busy());
  EXPECT_TRUE(machine.wait(Interrupt::kEngineDone, 1).ok());
  EXPECT_EQ(machine.now_cycles(), bell + 1000);
}

TEST_F(MachineTest, AHungEngineLeavesTheFirmwareToItsTimeout) {
  Machine broken(small_board(), {}, engine, panel, {.engine_hangs = true});
  const std::uint64_t bell = ring(broken);
  EXPECT_EQ(broken.wait(Interrupt::kEngineDone, 50'000).code, StatusCode::kDeadlineExceeded);
  EXPECT_EQ(broken.now_cycles(), bell + 20'000'000);
  EXPECT_EQ(broken.read32(kEngineStat), 1u);
}

// ---- display

TEST_F(MachineTest, VerticalBlankInterruptsAtItsCycleAndNotOneBefore) {
  machine.write32(kDisplayIntEn, 1);
  const std::uint64_t start = start_display(machine);
  machine.idle(1319);
  EXPECT_FALSE(machine.display().vertical_blank_asserted());
  machine.idle(1);
  EXPECT_TRUE(machine.display().vertical_blank_asserted());
  EXPECT_EQ(machine.now_cycles(), start + 1320);
}

TEST_F(MachineTest, WaitSleepsFromBlankToBlank) {
  machine.write32(kDisplayIntEn, 1);
  const std::uint64_t start = start_display(machine);
  ASSERT_TRUE(machine.wait(Interrupt::kVerticalBlank, 1000).ok());
  EXPECT_EQ(machine.now_cycles(), start + 1320);
  machine.write32(kDisplayIntSt, 1);
  ASSERT_TRUE(machine.wait(Interrupt::kVerticalBlank, 1000).ok());
  EXPECT_EQ(machine.now_cycles(), start + 1320 + 1440);
  EXPECT_EQ(machine.read32(kDisplayFcnt), 2u);
  EXPECT_EQ(panel.visible_pixels, 2u * 16 * 8);
}

TEST_F(MachineTest, EngineAndBlankAreWaitedForApart) {
  machine.write32(kDisplayIntEn, 1);
  const std::uint64_t start = start_display(machine);
  const std::uint64_t bell = ring(machine);  // four writes after the start
  EXPECT_EQ(bell, start + 160);
  EXPECT_TRUE(machine.wait(Interrupt::kVerticalBlank, 1000).ok());
  EXPECT_EQ(machine.now_cycles(), start + 1320);
  EXPECT_TRUE(machine.wait(Interrupt::kEngineDone, 0).ok()) << "done in the meantime";
}

TEST_F(MachineTest, LinesSentBeforeTheDoorbellShowTheOldPicture) {
  const std::uint64_t start = start_display(machine);
  engine.paint_address = 0x80000000u;  // first pixel of line 0
  engine.paint_word = 0x00FFFFFFu;
  machine.idle(start + 360 - machine.now_cycles());  // line 0 begins
  ring(machine);                                     // 160 cycles into it: too late for this frame
  EXPECT_EQ(panel.first_pixel, 0u);
  machine.idle(start + 360 + 1440 - machine.now_cycles());
  EXPECT_EQ(panel.first_pixel, 0x00FFFFFFu);
}

TEST_F(MachineTest, ABusTooSlowRaisesTheDisplaysFault) {
  // 16 pixels of 4 bytes in 200 ns need 320 MB/s; the board's bus has 400, a quarter of it is not enough for line 1.
  machine.write32(kDisplayIntEn, 0xE);
  start_display(machine);
  EXPECT_EQ(machine.wait(Interrupt::kDisplayFault, 100).code, StatusCode::kDeadlineExceeded);

  Machine slow(small_board(), {}, engine, panel, {.bus_slowdown = 4});
  slow.write32(kDisplayIntEn, 0xE);
  const std::uint64_t start = start_display(slow);
  ASSERT_TRUE(slow.wait(Interrupt::kDisplayFault, 100).ok());
  EXPECT_EQ(slow.now_cycles(), start + (3 + 1) * 120);
  EXPECT_EQ(slow.read32(kDisplayIntSt) & 0xEu, 2u);
}

// ---- determinism

TEST_F(MachineTest, TwoRunsHaveEqualTimes) {
  const auto run = [] {
    ScriptedEngine own_engine;
    own_engine.report.counters = {.command_words = 33, .vertices_transformed = 1000, .pixels_tested = 7777};
    CountingPanel own_panel;
    Machine m(host_sim(), {}, own_engine, own_panel);
    m.write32(kDisplayIntEn, 1);
    start_display(m);
    std::vector<std::uint64_t> times;
    for (int frame = 0; frame < 5; ++frame) {
      m.charge(CpuWork::kEdgeCosted, 17);
      ring(m);
      EXPECT_TRUE(m.wait(Interrupt::kEngineDone, 1000).ok());
      m.write32(kEngineIntSt, 1);
      times.push_back(m.now_ns());
      EXPECT_TRUE(m.wait(Interrupt::kVerticalBlank, 1000).ok());
      m.write32(kDisplayIntSt, 1);
      times.push_back(m.now_ns());
    }
    times.push_back(own_panel.pixel_clocks);
    return times;
  };
  const std::vector<std::uint64_t> first = run();
  EXPECT_EQ(first, run());
  EXPECT_TRUE(std::is_sorted(first.begin(), first.end() - 1));
}

}  // namespace
}  // namespace usuzumi::sim
