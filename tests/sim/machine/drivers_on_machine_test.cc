// The firmware's drivers on the machine's models: what neither side can get wrong alone.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "hal/command_list.h"
#include "hal/drivers/display_driver.h"
#include "hal/drivers/engine_driver.h"
#include "machine_fakes.h"
#include "sim/machine/machine.h"

namespace usuzumi::sim {
namespace {

struct DriversOnMachineTest : ::testing::Test {
  ScriptedEngine engine;
  CountingPanel panel;
  Machine machine{small_board(), {}, engine, panel};
  EngineDriver driver{machine, kEngineBase, machine};

  static std::span<std::uint32_t> words(Machine& m) { return {reinterpret_cast<std::uint32_t*>(m.ram().data()), 64}; }
};

TEST_F(DriversOnMachineTest, AListInRamIsFetchedByItsBusAddress) {
  ASSERT_TRUE(driver.probe().ok());
  command::Writer writer(words(machine));
  writer.put(command::Clear{});
  const auto list = writer.finish();
  ASSERT_TRUE(list.ok());
  engine.report.counters = {.command_words = 5, .vertices_transformed = 3, .faces_in = 2, .faces_drawn = 1};
  ASSERT_TRUE(driver.start(machine.bus_address(list->data()), static_cast<std::uint32_t>(list->size())).ok());
  ASSERT_TRUE(driver.wait_done(1000).ok());
  EXPECT_EQ(engine.executions, 1u);
  EXPECT_EQ(driver.cycles(), 200u + 5 + 3 * 16 + 24);
  EXPECT_EQ(driver.faces_drawn(), 1u);
  EXPECT_EQ(driver.faces_in(), 2u);
  EXPECT_EQ(driver.vertices(), 3u);
  EXPECT_EQ(machine.guest_log().mistakes(), 0u);
}

TEST_F(DriversOnMachineTest, AListOutsideMemoryIsTheEnginesError) {
  ASSERT_TRUE(driver.probe().ok());
  ASSERT_TRUE(driver.start(0x40000000u, 4).ok()) << "the driver does not know the map";
  const Status status = driver.wait_done(1000);
  EXPECT_EQ(status.code, StatusCode::kInvalidArgument);
  EXPECT_EQ(driver.error_code(), 3u);
  EXPECT_EQ(engine.executions, 0u);
}

TEST_F(DriversOnMachineTest, ABusyEngineIsNotStartedTwice) {
  ASSERT_TRUE(driver.probe().ok());
  ASSERT_TRUE(driver.start(kRamBase, 4).ok());
  EXPECT_EQ(driver.start(kRamBase, 4).code, StatusCode::kUnavailable);
  EXPECT_TRUE(driver.wait_done(1000).ok());
  EXPECT_TRUE(driver.start(kRamBase, 4).ok());
}

TEST_F(DriversOnMachineTest, AHungEngineIsResetAndNamedByItsTimeout) {
  Machine broken(small_board(), {}, engine, panel, {.engine_hangs = true});
  EngineDriver on_broken(broken, kEngineBase, broken);
  ASSERT_TRUE(on_broken.probe().ok());
  ASSERT_TRUE(on_broken.start(kRamBase, 4).ok());
  const std::uint64_t begin = broken.now_cycles();
  EXPECT_EQ(on_broken.wait_done(20'000).code, StatusCode::kDeadlineExceeded);
  EXPECT_GE(broken.now_cycles(), begin + cycles_from_us(20'000));
  EXPECT_LT(broken.now_cycles(), begin + cycles_from_us(20'010));
  EXPECT_FALSE(broken.engine().busy());
  EXPECT_EQ(broken.guest_log().mistakes(), 0u);
}

TEST_F(DriversOnMachineTest, DoneJustAfterATimeoutDoesNotEndTheNextWait) {
  engine.report.counters = {.pixels_tested = 100'000};  // 1 ms and 2 us
  ASSERT_TRUE(driver.probe().ok());
  ASSERT_TRUE(driver.start(kRamBase, 4).ok());
  EXPECT_EQ(driver.wait_done(1000).code, StatusCode::kDeadlineExceeded);
  ASSERT_TRUE(driver.start(kRamBase, 4).ok());
  const std::uint64_t bell = machine.engine().start_time();
  EXPECT_TRUE(driver.wait_done(5000).ok());
  EXPECT_GE(machine.now_cycles(), bell + 400'800) << "the second list's own end";
}

TEST_F(DriversOnMachineTest, EnableShowsThePictureAndCountsFrames) {
  DisplayDriver display(machine, kDisplayBase);
  ASSERT_TRUE(display.probe().ok());
  ASSERT_TRUE(display.set_mode(kMode480x272).ok());
  LayerConfig layer;
  layer.format = LayerFormat::kRgb565;
  layer.stride_bytes = 960;
  layer.bank_address[0] = layer.bank_address[1] = kVramBase;
  layer.width = 480;
  layer.height = 272;
  ASSERT_TRUE(display.configure_layer(0, layer).ok());
  ASSERT_TRUE(display.show_layer(0, true).ok());
  machine.vram()[1] = std::byte{0xF8};  // first pixel red
  display.enable_vertical_blank_interrupt(true);
  ASSERT_TRUE(display.enable().ok());
  for (std::uint32_t frame = 1; frame <= 3; ++frame) {
    ASSERT_TRUE(machine.wait(Interrupt::kVerticalBlank, 20'000).ok());
    display.clear_vertical_blank();
    EXPECT_EQ(display.frame_count(), frame);
  }
  EXPECT_EQ(panel.visible_pixels, 3u * 480 * 272);
  EXPECT_FALSE(display.faults().any());
  EXPECT_EQ(machine.guest_log().mistakes(), 0u);
}

}  // namespace
}  // namespace usuzumi::sim
