// The engine's register block, driven by registers and virtual time only. Offsets, resets and costs are literals here,
// so that a slip in hal/registers/engine.h or cost_model.h shows.
#include "gfx_subsystem/engine/engine_device.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace usuzumi::gfx {
namespace {

constexpr std::uint32_t kId = 0x00, kVer = 0x04, kCtrl = 0x08, kStat = 0x0C, kLadr = 0x10, kLwrd = 0x14, kBell = 0x18,
                        kIntSt = 0x1C, kIntEn = 0x20, kECode = 0x24, kEWord = 0x28, kCycL = 0x30, kCycH = 0x34,
                        kFDraw = 0x38, kFIn = 0x3C, kVtx = 0x40;
constexpr std::uint32_t kBusy = 1, kError = 2;
constexpr std::uint32_t kIntDone = 1, kIntError = 2, kIntDoorbellIgnored = 4;

constexpr BusAddress kMemoryBase = 0x1000;

class TestMemory final : public BusMemory {
 public:
  alignas(8) std::array<std::byte, 256> bytes{};

 private:
  std::span<std::byte> resolve(BusAddress address, std::size_t size) const {
    if (address < kMemoryBase || address - kMemoryBase > bytes.size() || size > bytes.size() - (address - kMemoryBase))
      return {};
    return {const_cast<std::byte*>(bytes.data()) + (address - kMemoryBase), size};
  }
  std::span<const std::byte> do_read_window(BusAddress a, std::size_t size) const override { return resolve(a, size); }
  std::span<std::byte> do_write_window(BusAddress a, std::size_t size) override { return resolve(a, size); }
};

/// Draws nothing; reports what the test wants.
class ScriptedEngine final : public Engine {
 public:
  ExecutionReport report;
  std::uint32_t executions = 0;
  std::size_t words_seen = 0;
  std::uint32_t first_word = 0;

 private:
  ExecutionReport do_execute(std::span<const std::uint32_t> list, BusMemory&) override {
    ++executions;
    words_seen = list.size();
    first_word = list.front();
    return report;
  }
};

struct EngineDeviceTest : ::testing::Test {
  TestMemory memory;
  ScriptedEngine engine;
  EngineDevice device{engine, memory, {.time_hz = 400'000'000, .engine_hz = 200'000'000}};

  void ring(std::uint32_t address = kMemoryBase, std::uint32_t words = 4) {
    device.write(kLadr, address);
    device.write(kLwrd, words);
    device.write(kBell, 1);
  }
  std::uint64_t cycles() { return std::uint64_t{device.read(kCycH)} << 32 | device.read(kCycL); }
};

TEST_F(EngineDeviceTest, EveryRegisterHasTheResetOfThePage) {
  EXPECT_EQ(device.read(kId), 0x44335A55u);  // "UZ3D", first letter in the lowest byte
  EXPECT_EQ(device.read(kVer), 0x00010000u);
  for (const std::uint32_t offset :
       {kCtrl, kStat, kLadr, kLwrd, kBell, kIntSt, kIntEn, kECode, kEWord, kCycL, kCycH, kFDraw, kFIn, kVtx})
    EXPECT_EQ(device.read(offset), 0u) << "offset " << offset;
  EXPECT_EQ(device.registers().mistake_count(), 0u);
  EXPECT_EQ(device.next_event(), EngineDevice::kNever);
}

TEST_F(EngineDeviceTest, OnlyTheRegistersOfThePageCanBeWritten) {
  device.write(kLadr, 0xFFFFFFFFu);
  device.write(kLwrd, 0xFFFFFFFFu);
  device.write(kIntEn, 0xFFFFFFFFu);
  EXPECT_EQ(device.read(kLadr), 0xFFFFFFFFu);
  EXPECT_EQ(device.read(kLwrd), 0x00FFFFFFu);
  EXPECT_EQ(device.read(kIntEn), 7u);
  EXPECT_EQ(device.registers().mistake_count(GuestMistake::kReservedBits), 2u);
  for (const std::uint32_t offset : {kId, kVer, kStat, kECode, kEWord, kCycL, kCycH, kFDraw, kFIn, kVtx}) {
    const std::uint32_t before = device.read(offset);
    device.write(offset, 0xA5A5A5A5u);
    EXPECT_EQ(device.read(offset), before) << "offset " << offset;
  }
  EXPECT_EQ(device.registers().mistake_count(GuestMistake::kReadOnlyWrite), 10u);
}

TEST_F(EngineDeviceTest, OffsetsBetweenAndBehindTheRegistersAreMistakes) {
  for (const std::uint32_t offset : {0x2Cu, 0x44u, 0xFFCu}) EXPECT_EQ(device.read(offset), 0u);
  EXPECT_EQ(device.registers().mistake_count(GuestMistake::kUnknownOffset), 3u);
  device.write(0x11, 4);
  EXPECT_EQ(device.registers().mistake_count(GuestMistake::kUnaligned), 1u);
}

TEST_F(EngineDeviceTest, DoorbellHandsTheWholeListToTheEngine) {
  const std::uint32_t word = 0xCAFE0123u;
  std::memcpy(memory.bytes.data() + 8, &word, 4);
  ring(kMemoryBase + 8, 62);  // to the last byte of memory
  EXPECT_EQ(engine.executions, 1u);
  EXPECT_EQ(engine.words_seen, 62u);
  EXPECT_EQ(engine.first_word, 0xCAFE0123u);
}

TEST_F(EngineDeviceTest, ListIsDoneAtItsTickAndNotOneBefore) {
  engine.report.counters.command_words = 100;  // 200 + 100 engine clocks of 2 ticks
  device.advance_to(1000);
  ring();
  EXPECT_EQ(device.start_time(), 1000u);
  EXPECT_EQ(device.done_time(), 1600u);
  EXPECT_EQ(device.next_event(), 1600u);
  device.advance_to(1599);
  EXPECT_EQ(device.read(kStat), kBusy);
  EXPECT_EQ(device.read(kIntSt), 0u);
  EXPECT_EQ(cycles(), 0u) << "the counters are of the last list that ended";
  device.advance_to(1600);
  EXPECT_EQ(device.read(kStat), 0u);
  EXPECT_EQ(device.read(kIntSt), kIntDone);
  EXPECT_EQ(cycles(), 300u);
  EXPECT_EQ(device.next_event(), EngineDevice::kNever);
}

TEST_F(EngineDeviceTest, UnevenClocksRoundTheEndUp) {
  EngineDevice odd(engine, memory, {.time_hz = 400'000'000, .engine_hz = 150'000'000});
  engine.report.counters.command_words = 1;  // 201 clocks of 8/3 ticks: exactly 536
  odd.write(kLadr, kMemoryBase);
  odd.write(kLwrd, 1);
  odd.write(kBell, 1);
  EXPECT_EQ(odd.done_time(), 536u);
  odd.advance_to(536);
  engine.report.counters.command_words = 2;  // 202 clocks: 538.67
  odd.write(kBell, 1);
  EXPECT_EQ(odd.done_time(), 536u + 539u);
}

TEST_F(EngineDeviceTest, HoursOfWorkDoNotOverflow) {
  engine.report.counters.pixels_tested = 1'000'000'000'000;  // 5000 s at 200 MHz
  ring();
  EXPECT_EQ(device.done_time(), 2'000'000'000'400u);
  device.advance_to(device.done_time());
  EXPECT_EQ(cycles(), 1'000'000'000'200u);
  EXPECT_EQ(device.read(kCycH), 232u);
}

TEST_F(EngineDeviceTest, CountersOfTheLastListStandUntilTheNextEnds) {
  engine.report.counters = {
      .command_words = 10, .vertices_transformed = 7, .primitives_in = 6, .faces_in = 5, .faces_drawn = 4};
  ring();
  device.advance_to(device.next_event());
  EXPECT_EQ(device.read(kFDraw), 4u);
  EXPECT_EQ(device.read(kFIn), 5u);
  EXPECT_EQ(device.read(kVtx), 7u);
  engine.report.counters = {.faces_in = 0x1'0000'0001};
  ring();
  EXPECT_EQ(device.read(kFIn), 5u);
  device.advance_to(device.next_event());
  EXPECT_EQ(device.read(kFIn), 0xFFFFFFFFu) << "sticks at the largest value";
  EXPECT_EQ(device.read(kFDraw), 0u);
}

TEST_F(EngineDeviceTest, InterruptLineIsStatusAndEnable) {
  ring();
  device.advance_to(device.next_event());
  EXPECT_FALSE(device.interrupt_asserted());
  device.write(kIntEn, kIntDone);
  EXPECT_TRUE(device.interrupt_asserted()) << "status was latched before it was enabled";
  device.write(kIntSt, kIntError);
  EXPECT_TRUE(device.interrupt_asserted()) << "clearing another bit does not clear this one";
  device.write(kIntSt, kIntDone);
  EXPECT_FALSE(device.interrupt_asserted());
  EXPECT_EQ(device.read(kIntSt), 0u);
}

TEST_F(EngineDeviceTest, DoorbellWhileBusyIsIgnoredAndFlagged) {
  ring();
  const std::uint64_t end = device.done_time();
  device.advance_to(10);
  device.write(kBell, 1);
  EXPECT_EQ(engine.executions, 1u);
  EXPECT_EQ(device.done_time(), end);
  EXPECT_EQ(device.read(kIntSt), kIntDoorbellIgnored);
  EXPECT_EQ(device.registers().mistake_count(GuestMistake::kIllegalValue), 1u);
  device.advance_to(end);
  EXPECT_EQ(device.read(kIntSt), kIntDone | kIntDoorbellIgnored);
}

TEST_F(EngineDeviceTest, WritingZeroRingsNoBell) {
  device.write(kLadr, kMemoryBase);
  device.write(kLwrd, 4);
  device.write(kBell, 0);
  device.write(kCtrl, 0);
  EXPECT_EQ(engine.executions, 0u);
  EXPECT_EQ(device.read(kLwrd), 4u) << "nor resets";
}

TEST_F(EngineDeviceTest, ListsThatCannotBeFetchedEndInTheirErrorCode) {
  struct Case {
    std::uint32_t address, words, code;
  };
  const Case cases[] = {
      {kMemoryBase + 2, 4, 1},      // no multiple of 4
      {kMemoryBase, 0, 2},          // empty
      {kMemoryBase, 65, 3},         // one word beyond memory
      {kMemoryBase - 4, 4, 3},      // one word before it
      {0, 4, 3},                    //
      {0xFFFFFFFC, 0x00FFFFFF, 3},  // past the end of the address space
  };
  for (const Case& c : cases) {
    ring(c.address, c.words);
    EXPECT_EQ(device.read(kStat), kBusy);
    EXPECT_FALSE(device.last_report().status.ok());
    device.advance_to(device.next_event());
    EXPECT_EQ(device.read(kStat), kError);
    EXPECT_EQ(device.read(kECode), c.code) << "address " << c.address;
    EXPECT_EQ(device.read(kEWord), 0u);
    EXPECT_EQ(device.read(kIntSt), kIntError);
    EXPECT_EQ(cycles(), 200u);
    device.write(kIntSt, kIntError);
  }
  EXPECT_EQ(engine.executions, 0u);
}

TEST_F(EngineDeviceTest, AListThatCannotBeFetchedDrewNothing) {
  engine.report.counters = {.command_words = 10, .faces_drawn = 4};
  ring();
  device.advance_to(device.next_event());
  ring(0);
  device.advance_to(device.next_event());
  EXPECT_EQ(device.read(kFDraw), 0u);
  EXPECT_EQ(cycles(), 200u);
}

TEST_F(EngineDeviceTest, FaultsInTheListNameTheirKindAndWord) {
  const std::pair<StatusCode, std::uint32_t> cases[] = {
      {StatusCode::kDataLoss, 4},           {StatusCode::kUnsupported, 5},       {StatusCode::kInvalidArgument, 6},
      {StatusCode::kFailedPrecondition, 7}, {StatusCode::kResourceExhausted, 8}, {StatusCode::kUnavailable, 9}};
  for (const auto& [status, code] : cases) {
    engine.report = {.status = {status, "fault", 17}, .counters = {.command_words = 17}};
    ring();
    device.advance_to(device.next_event());
    EXPECT_EQ(device.read(kStat), kError);
    EXPECT_EQ(device.read(kECode), code);
    EXPECT_EQ(device.read(kEWord), 17u);
    EXPECT_EQ(cycles(), 217u) << "what was done before the fault takes its time";
  }
  engine.report = {};
  ring();
  EXPECT_EQ(device.read(kStat), kBusy) << "ERR falls with the doorbell";
  device.advance_to(device.next_event());
  EXPECT_EQ(device.read(kECode), 0u);
  EXPECT_EQ(device.read(kEWord), 0u);
}

TEST_F(EngineDeviceTest, SoftResetStopsTheListAndRestoresEveryRegister) {
  device.write(kIntEn, 3);
  ring();
  device.write(kCtrl, 1);
  EXPECT_EQ(device.next_event(), EngineDevice::kNever);
  for (const std::uint32_t offset : {kStat, kLadr, kLwrd, kIntSt, kIntEn}) EXPECT_EQ(device.read(offset), 0u);
  EXPECT_EQ(device.read(kId), 0x44335A55u);
  device.advance_to(1'000'000);
  EXPECT_EQ(device.read(kIntSt), 0u) << "the stopped list never ends";
  ring();
  device.advance_to(device.next_event());
  EXPECT_EQ(device.read(kIntSt), kIntDone);
}

TEST_F(EngineDeviceTest, HangingEngineStaysBusyUntilReset) {
  EngineDevice hung(engine, memory, {.hangs = true});
  hung.write(kLadr, kMemoryBase);
  hung.write(kLwrd, 4);
  hung.write(kBell, 1);
  EXPECT_EQ(hung.next_event(), EngineDevice::kNever);
  hung.advance_to(1'000'000'000'000);
  EXPECT_EQ(hung.read(kStat), kBusy);
  hung.write(kCtrl, 1);
  EXPECT_EQ(hung.read(kStat), 0u);
}

TEST_F(EngineDeviceTest, HostSeesTheReportFromTheDoorbellOn) {
  engine.report.counters = {.pixels_tested = 12, .pixels_cleared = 34};
  ring();
  EXPECT_EQ(device.last_report().counters.pixels_cleared, 34u);
  EXPECT_EQ(device.last_cycles(), 200u + 12 + 9);
  EXPECT_EQ(device.lists_executed(), 1u);
}

}  // namespace
}  // namespace usuzumi::gfx
