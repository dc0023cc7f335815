// The CPU's cost table restated, and how the machine turns clocks into time.
#include "sim/machine/cost_model.h"

#include <gtest/gtest.h>

#include "machine_fakes.h"
#include "sim/machine/machine.h"

namespace usuzumi::sim {
namespace {

TEST(CpuCostModel, HasTheNumbersOfThePage) {
  EXPECT_EQ(cpu_clocks(CpuWork::kVertexCopied), 30u);
  EXPECT_EQ(cpu_clocks(CpuWork::kIndexCopied), 8u);
  EXPECT_EQ(cpu_clocks(CpuWork::kFaceMeasured), 180u);
  EXPECT_EQ(cpu_clocks(CpuWork::kConnectivityBuilt), 100u);
  EXPECT_EQ(cpu_clocks(CpuWork::kEdgeCosted), 200u);
  EXPECT_EQ(cpu_clocks(CpuWork::kQueueOperation), 90u);
  EXPECT_EQ(cpu_clocks(CpuWork::kEdgeCollapsed), 500u);
  EXPECT_EQ(cpu_clocks(CpuWork::kCornerReplayed), 40u);
  EXPECT_EQ(cpu_clocks(CpuWork::kVertexMoved), 320u);
  EXPECT_EQ(cpu_clocks(CpuWork::kCommandWritten), 2u);
  EXPECT_EQ(kRegisterAccessClocks, 40u);
}

struct ChargeTest : ::testing::Test {
  ScriptedEngine engine;
  CountingPanel panel;
};

TEST_F(ChargeTest, TurnsClocksOfTheCpuIntoCyclesOfTheMachine) {
  Machine small(small_board(), {}, engine, panel);  // 400 MHz: one to one
  small.charge(CpuWork::kVertexCopied, 10);
  EXPECT_EQ(small.now_cycles(), 300u);
  Machine desk(host_sim(), {}, engine, panel);  // 800 MHz: two to one
  desk.charge(CpuWork::kVertexCopied, 10);
  EXPECT_EQ(desk.now_cycles(), 150u);
}

TEST_F(ChargeTest, CarriesFractionsOfACycleOver) {
  BoardDescription board = small_board();
  board.cpu_hz = 300'000'000;  // a command word of 2 clocks is 2 2/3 cycles
  Machine machine(board, {}, engine, panel);
  machine.charge(CpuWork::kCommandWritten, 1);
  EXPECT_EQ(machine.now_cycles(), 2u);
  machine.charge(CpuWork::kCommandWritten, 1);
  EXPECT_EQ(machine.now_cycles(), 5u);
  machine.charge(CpuWork::kCommandWritten, 1);
  EXPECT_EQ(machine.now_cycles(), 8u);
}

TEST_F(ChargeTest, HoursOfWorkDoNotOverflow) {
  Machine machine(host_sim(), {}, engine, panel);
  machine.charge(CpuWork::kEdgeCollapsed, 20'000'000'000);  // 10^13 clocks at 800 MHz: 12500 s
  EXPECT_EQ(machine.now_cycles(), 5'000'000'000'000u);
}

TEST_F(ChargeTest, ReadingTheClockIsARegisterAccess) {
  Machine machine(small_board(), {}, engine, panel);
  EXPECT_EQ(machine.now_ns(), 100u);  // 40 clocks of 2.5 ns
  EXPECT_EQ(machine.now_ns(), 200u);
  EXPECT_EQ(machine.now_cycles(), 80u);
}

}  // namespace
}  // namespace usuzumi::sim
