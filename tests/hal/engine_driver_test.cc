// The engine's driver against a scripted register block: what it writes, in which order, and what it makes of the
// answers. Offsets and values are literals here, so that a slip in hal/registers/engine.h shows.
#include "hal/drivers/engine_driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "hal/registers/engine.h"

namespace usuzumi {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

constexpr BusAddress kBase = 0xF0000000u;
constexpr std::uint32_t kCtrl = 0x08, kStat = 0x0C, kLadr = 0x10, kLwrd = 0x14, kBell = 0x18, kIntSt = 0x1C,
                        kIntEn = 0x20, kECode = 0x24, kEWord = 0x28;

/// Holds what the engine would answer and remembers what was written.
class FakeRegisters final : public RegisterIo {
 public:
  std::map<std::uint32_t, std::uint32_t> answers{{0x00, 0x44335A55u}, {0x04, 0x00010000u}};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> writes;

 private:
  std::uint32_t do_read32(BusAddress address) override { return answers[address - kBase]; }
  void do_write32(BusAddress address, std::uint32_t value) override {
    writes.emplace_back(address - kBase, value);
    if (address - kBase == kIntSt) answers[kIntSt] &= ~value;
  }
};

/// One scripted outcome per wait; after them the deadline passes. An outcome can set INTST as the engine would.
class FakeWaiter final : public InterruptWaiter {
 public:
  struct Wake {
    Status status;
    std::uint32_t interrupt_status = 0;
  };
  explicit FakeWaiter(FakeRegisters& registers) : registers_(registers) {}
  std::vector<Wake> script;
  int waits = 0;

 private:
  Status do_wait(Interrupt interrupt, std::uint32_t) override {
    EXPECT_EQ(interrupt, Interrupt::kEngineDone);
    const auto i = static_cast<std::size_t>(waits++);
    if (i >= script.size()) return {StatusCode::kDeadlineExceeded, "deadline", 0};
    registers_.answers[kIntSt] |= script[i].interrupt_status;
    return script[i].status;
  }
  FakeRegisters& registers_;
};

struct EngineDriverTest : ::testing::Test {
  FakeRegisters registers;
  FakeWaiter waiter{registers};
  EngineDriver driver{registers, kBase, waiter};

  void start() {
    ASSERT_TRUE(driver.probe().ok());
    ASSERT_TRUE(driver.start(0x50000100u, 12).ok());
    registers.writes.clear();
  }
};

TEST_F(EngineDriverTest, ProbeResetsTheEngineAndEnablesDoneAndError) {
  EXPECT_TRUE(driver.probe().ok());
  EXPECT_THAT(registers.writes, ElementsAre(Pair(kCtrl, 1u), Pair(kIntEn, 3u)));
}

TEST_F(EngineDriverTest, ProbeRefusesAnotherDeviceWithoutWritingToIt) {
  registers.answers[0x00] = 0xFFFFFFFFu;
  const Status status = driver.probe();
  EXPECT_EQ(status.code, StatusCode::kUnavailable);
  EXPECT_EQ(status.where, 0xFFFFFFFFu);
  EXPECT_TRUE(registers.writes.empty());
  EXPECT_EQ(driver.start(0x50000000u, 1).code, StatusCode::kFailedPrecondition);
}

TEST_F(EngineDriverTest, ProbeTakesAnotherMinorVersionAndRefusesAnotherMajor) {
  registers.answers[0x04] = 0x00010007u;
  EXPECT_TRUE(driver.probe().ok());
  registers.answers[0x04] = 0x00020000u;
  EXPECT_EQ(driver.probe().code, StatusCode::kUnsupported);
  EXPECT_EQ(driver.rasterizer_version(), 0x00020000u);
}

TEST_F(EngineDriverTest, StartWritesTheListAndThenRings) {
  ASSERT_TRUE(driver.probe().ok());
  registers.writes.clear();
  ASSERT_TRUE(driver.start(0x50000100u, 12).ok());
  EXPECT_THAT(registers.writes,
              ElementsAre(Pair(kIntSt, 7u), Pair(kLadr, 0x50000100u), Pair(kLwrd, 12u), Pair(kBell, 1u)));
}

TEST_F(EngineDriverTest, StartRefusesBadListsBeforeAnyRegisterIsWritten) {
  ASSERT_TRUE(driver.probe().ok());
  registers.writes.clear();
  EXPECT_EQ(driver.start(0x50000102u, 12).code, StatusCode::kInvalidArgument);
  EXPECT_EQ(driver.start(0x50000101u, 12).code, StatusCode::kInvalidArgument);
  EXPECT_EQ(driver.start(0, 12).code, StatusCode::kInvalidArgument);
  EXPECT_EQ(driver.start(0x50000100u, 0).code, StatusCode::kInvalidArgument);
  EXPECT_EQ(driver.start(0x50000100u, 0x01000000u).code, StatusCode::kInvalidArgument);
  EXPECT_TRUE(registers.writes.empty());
  EXPECT_TRUE(driver.start(0x50000100u, 0x00FFFFFFu).ok());
}

TEST_F(EngineDriverTest, StartRefusesABusyEngine) {
  ASSERT_TRUE(driver.probe().ok());
  registers.writes.clear();
  registers.answers[kStat] = 1;
  EXPECT_EQ(driver.start(0x50000100u, 12).code, StatusCode::kUnavailable);
  EXPECT_TRUE(registers.writes.empty());
}

TEST_F(EngineDriverTest, WaitClearsTheEnginesFlag) {
  start();
  waiter.script = {{ok_status(), 1}};
  EXPECT_TRUE(driver.wait_done(1000).ok());
  EXPECT_THAT(registers.writes, ElementsAre(Pair(kIntSt, 1u)));
  EXPECT_EQ(driver.wait_done(1000).code, StatusCode::kFailedPrecondition) << "one start, one wait";
}

TEST_F(EngineDriverTest, WaitSaysWhatTheEngineObjectsToAndWhere) {
  const std::pair<std::uint32_t, StatusCode> cases[] = {
      {1, StatusCode::kInvalidArgument},    {2, StatusCode::kInvalidArgument},   {3, StatusCode::kInvalidArgument},
      {4, StatusCode::kDataLoss},           {5, StatusCode::kUnsupported},       {6, StatusCode::kInvalidArgument},
      {7, StatusCode::kFailedPrecondition}, {8, StatusCode::kResourceExhausted}, {9, StatusCode::kUnavailable}};
  for (const auto& [code, expected] : cases) {
    start();
    waiter.waits = 0;
    waiter.script = {{ok_status(), 2}};
    registers.answers[kECode] = code;
    registers.answers[kEWord] = 77;
    const Status status = driver.wait_done(1000);
    EXPECT_EQ(status.code, expected) << "error code " << code;
    EXPECT_EQ(status.where, 77u);
    EXPECT_EQ(driver.error_code(), code);
  }
}

TEST_F(EngineDriverTest, AnErrorCodeOfTheFutureIsReportedByItsNumber) {
  start();
  waiter.script = {{ok_status(), 2}};
  registers.answers[kECode] = 200;
  const Status status = driver.wait_done(1000);
  EXPECT_EQ(status.code, StatusCode::kUnavailable);
  EXPECT_EQ(status.where, 200u);
}

TEST_F(EngineDriverTest, AHangEndsByTheDeadlineAndResetsTheEngine) {
  start();
  const Status status = driver.wait_done(1000);
  EXPECT_EQ(status.code, StatusCode::kDeadlineExceeded);
  EXPECT_EQ(status.where, 1000u);
  EXPECT_THAT(registers.writes, ElementsAre(Pair(kCtrl, 1u), Pair(kIntEn, 3u)));
  EXPECT_TRUE(driver.start(0x50000100u, 12).ok()) << "usable again";
}

TEST_F(EngineDriverTest, AListThatEndsJustAsTheDeadlinePassesHasEnded) {
  start();
  waiter.script = {{{StatusCode::kDeadlineExceeded, "deadline", 0}, 1}};
  EXPECT_TRUE(driver.wait_done(1000).ok());
}

TEST_F(EngineDriverTest, AnInterruptLeftOverFromAnEarlierListIsWaitedThrough) {
  start();
  waiter.script = {{ok_status(), 0}, {ok_status(), 1}};
  EXPECT_TRUE(driver.wait_done(1000).ok());
  EXPECT_EQ(waiter.waits, 2);
}

TEST_F(EngineDriverTest, AStormOfInterruptsIsAFaultAndNotAnEndlessLoop) {
  start();
  waiter.script.assign(100, {ok_status(), 0});
  EXPECT_EQ(driver.wait_done(1000).code, StatusCode::kUnavailable);
  EXPECT_EQ(waiter.waits, 5);
  EXPECT_THAT(registers.writes, ElementsAre(Pair(kCtrl, 1u), Pair(kIntEn, 3u)));
}

TEST_F(EngineDriverTest, CountersComeFromTheirRegisters) {
  registers.answers[0x30] = 0x89ABCDEFu;
  registers.answers[0x34] = 0x01234567u;
  registers.answers[0x38] = 5;
  registers.answers[0x3C] = 6;
  registers.answers[0x40] = 7;
  EXPECT_EQ(driver.cycles(), 0x0123456789ABCDEFu);
  EXPECT_EQ(driver.faces_drawn(), 5u);
  EXPECT_EQ(driver.faces_in(), 6u);
  EXPECT_EQ(driver.vertices(), 7u);
}

}  // namespace
}  // namespace usuzumi
