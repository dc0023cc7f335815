// The drivers of boards/cortex-a9 on registers that are an array: what QEMU never does, and what takes hours there.
// Offsets and bits are those of the data sheets, not the drivers' own constants.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "boards/cortex-a9/ignition_times.h"
#include "boards/cortex-a9/pl011.h"
#include "boards/cortex-a9/pl061.h"
#include "boards/cortex-a9/pl111.h"
#include "boards/cortex-a9/sp804.h"

namespace usuzumi::boards::cortex_a9 {
namespace {

/// Reads give what was written last. A test plays the device.
class Words {
 public:
  std::uint32_t& at(std::uint32_t offset) { return words_[offset / 4]; }
  Registers registers() { return Registers(reinterpret_cast<std::uintptr_t>(words_.data())); }

 private:
  std::array<std::uint32_t, 1024> words_{};
};

Scanout scanout_of(std::uint32_t width, std::uint32_t height, command::PixelFormat format) {
  return {width, height, format, width * command::bytes_per_pixel(format), {0x01000000, 0x01177000}};
}
constexpr auto kXrgb8888 = command::PixelFormat::kXrgb8888;
constexpr auto kRgb565 = command::PixelFormat::kRgb565;

constexpr std::uint32_t kUpBase = 0x10, kControl = 0x18, kImsc = 0x1C, kRis = 0x20, kIcr = 0x28;
constexpr std::uint32_t kFuf = 2, kLnbu = 4, kVcomp = 8, kMbError = 16;

TEST(Pl111, StartsBlackAndIsPoweredByTheFirstPicture) {
  Words words;
  Pl111 display(words.registers());
  display.start(scanout_of(800, 480, kXrgb8888));
  EXPECT_EQ(words.at(0x00) >> 2 & 0x3F, 800u / 16 - 1);
  EXPECT_EQ(words.at(0x04) & 0x3FF, 480u - 1);
  EXPECT_EQ(words.at(0x08) >> 16 & 0x3FF, 800u - 1);
  EXPECT_EQ(words.at(kImsc), kVcomp);
  const std::uint32_t control = words.at(kControl);
  EXPECT_EQ(control & 1, 1u) << "enabled, so that syncs run";
  EXPECT_EQ(control >> 11 & 1, 0u) << "no power: colours are held low";
  EXPECT_EQ(control >> 1 & 7, 5u) << "24 bits a pixel";
  EXPECT_EQ(control >> 8 & 1, 1u) << "BGR: red in the upper bits";

  display.send(0x01177000);
  EXPECT_EQ(words.at(kUpBase), 0x01177000u);
  EXPECT_EQ(words.at(kControl), control | 1u << 11);
}

TEST(Pl111, IsDarkAtOnceAndUntilTheNextPicture) {
  Words words;
  Pl111 display(words.registers());
  display.start(scanout_of(800, 480, kXrgb8888));
  display.send(0x01000000);
  const std::uint32_t lit = words.at(kControl);
  display.darken();
  EXPECT_EQ(words.at(kControl), lit & ~(1u << 11)) << "syncs run on, colours are held low";
  display.send(0x01177000);
  EXPECT_EQ(words.at(kControl), lit);
}

TEST(Pl111, Rgb565IsModeSix) {
  Words words;
  Pl111 display(words.registers());
  display.start(scanout_of(480, 272, kRgb565));
  EXPECT_EQ(words.at(kControl) >> 1 & 7, 6u);
  EXPECT_EQ(words.at(kControl) >> 8 & 1, 1u);
}

TEST(Pl111, APictureIsSentAtTheVerticalCompareBehindTheTakeOverOfItsBase) {
  Words words;
  Pl111 display(words.registers());
  display.start(scanout_of(800, 480, kXrgb8888));
  words.at(kRis) = kLnbu;  // the old base's
  display.send(0x01000000);
  EXPECT_EQ(words.at(kIcr), kLnbu | kVcomp) << "what was before the new base counts no more";

  words.at(kRis) = kVcomp;  // of a frame that had begun
  display.on_interrupt();
  EXPECT_FALSE(display.sent());
  words.at(kRis) = kLnbu;  // another's interrupt, in between
  display.on_interrupt();
  EXPECT_FALSE(display.sent());
  words.at(kRis) = kVcomp | kLnbu;
  display.on_interrupt();
  EXPECT_TRUE(display.sent());
  EXPECT_EQ(words.at(kIcr), kVcomp | kLnbu);
  EXPECT_EQ(display.vertical_compares(), 2u);

  display.send(0x01000000);
  EXPECT_FALSE(display.sent()) << "of a picture that is shown already, too";
}

TEST(Pl111, AnEmptyFifoAndARefusedFetchAreFaultsOnce) {
  Words words;
  Pl111 display(words.registers());
  EXPECT_TRUE(display.take_fault().ok());
  words.at(kRis) = kVcomp | kFuf;
  const Status underflow = display.take_fault();
  EXPECT_EQ(underflow.code, StatusCode::kUnavailable);
  EXPECT_NE(std::string(underflow.message).find("FIFO"), std::string::npos);
  EXPECT_EQ(words.at(kIcr), kFuf) << "the vertical compare is the handler's";
  words.at(kRis) = kMbError;
  EXPECT_NE(std::string(display.take_fault().message).find("bus"), std::string::npos);
  words.at(kRis) = kVcomp;
  EXPECT_TRUE(display.take_fault().ok());
}

TEST(Pl111, RefusesWhatItsRegistersCannotSay) {
  EXPECT_TRUE(Pl111::check_mode(scanout_of(16, 1, kRgb565)).ok());
  EXPECT_TRUE(Pl111::check_mode(scanout_of(1024, 1024, kXrgb8888)).ok());
  for (const auto& [width, height] : {std::pair{0u, 480u}, {808u, 480u}, {1040u, 480u}, {800u, 0u}, {800u, 1025u}})
    EXPECT_EQ(Pl111::check_mode(scanout_of(width, height, kXrgb8888)).code, StatusCode::kInvalidArgument)
        << width << "x" << height;
  Scanout gaps = scanout_of(800, 480, kXrgb8888);
  gaps.stride_bytes += 64;
  EXPECT_FALSE(Pl111::check_mode(gaps).ok());
}

TEST(Sp804, TimeRisesThroughEveryWrap) {
  Words words;
  Sp804 timers(words.registers());
  constexpr std::uint32_t kValue = 0x04;
  words.at(kValue) = 50'000;  // it counts down from here
  timers.start();
  EXPECT_EQ(words.at(0x18), 0xFFFFFFFFu) << "reloaded with all ones";
  EXPECT_EQ(timers.now_ns(), 0u);
  words.at(kValue) = 1;
  EXPECT_EQ(timers.now_ns(), 49'999'000u);
  words.at(kValue) = 0xFFFFFFFF;
  EXPECT_EQ(timers.now_ns(), 50'001'000u);
  std::uint64_t before = timers.now_ns();
  for (std::uint32_t i = 1; i <= 8; ++i) {  // a look every 36 minutes: four wraps
    words.at(kValue) = 0xFFFFFFFFu - i * 0x80000000u;
    const std::uint64_t now = timers.now_ns();
    EXPECT_EQ(now - before, 0x80000000ull * 1000);
    before = now;
  }
}

TEST(Sp804, AnAlarmRingsByItsOwnInterruptOnly) {
  Words words;
  Sp804 timers(words.registers());
  timers.start();
  timers.set_alarm(500);
  EXPECT_EQ(words.at(0x20), 500u);
  EXPECT_EQ(words.at(0x28), 0xA3u) << "enabled, interrupts, 32 bits, one shot";
  timers.on_interrupt();  // the other timer's
  EXPECT_FALSE(timers.alarm_rang());
  words.at(0x34) = 1;
  timers.on_interrupt();
  EXPECT_TRUE(timers.alarm_rang());
  timers.cancel_alarm();
  EXPECT_FALSE(timers.alarm_rang());
  EXPECT_EQ(words.at(0x28), 0u);
}

TEST(Pl061, AnEdgeIsKeptUntilItIsTaken) {
  Words words;
  Pl061 gpio(words.registers());
  gpio.start(1u << 4, 3);
  EXPECT_EQ(words.at(0x400), 1u << 4) << "one output";
  EXPECT_EQ(words.at(0x408), 3u) << "both edges";
  EXPECT_EQ(words.at(0x410), 3u) << "interrupts";
  EXPECT_EQ(gpio.edges(), 0u);

  words.at(0x418) = 2;
  gpio.on_interrupt();
  EXPECT_EQ(words.at(0x41C), 2u) << "no other edge is cleared";
  words.at(0x418) = 1;  // one more, whose interrupt is masked
  EXPECT_EQ(gpio.edges(), 3u);
  EXPECT_EQ(gpio.take_edges(), 3u);
  words.at(0x418) = 0;
  EXPECT_EQ(gpio.take_edges(), 0u);
}

TEST(Pl061, AnAddressNamesTheLinesOfAnAccess) {
  Words words;
  Pl061 gpio(words.registers());
  gpio.write(1u << 4, true);
  EXPECT_EQ(words.at(0x040), 0xFFu);
  gpio.write(1u << 4, false);
  EXPECT_EQ(words.at(0x040), 0u);
  words.at(0x004) = 1;
  EXPECT_EQ(gpio.read(1u << 0), 1u);
}

TEST(Pl011, ALineThatStandsStillLosesTextAndNoTime) {
  Words words;
  Pl011 console(words.registers());
  console.start();
  EXPECT_EQ(words.at(0x24), 13u);
  EXPECT_EQ(words.at(0x30), 0x301u);
  words.at(0x18) = 1u << 5;  // the FIFO is full, for ever
  for (int i = 0; i < 1000; ++i) console.print("a line of text\n");
  EXPECT_EQ(words.at(0x00), 0u);
  words.at(0x18) = 0;
  console.print("x");
  EXPECT_EQ(words.at(0x00), static_cast<std::uint32_t>('x'));

  words.at(0x00) = 'h';
  EXPECT_EQ(console.receive(), 'h');
  words.at(0x18) = 1u << 4;  // nothing has come
  EXPECT_EQ(console.receive(), '\0');
}

std::string line_of(IgnitionTimes& times) {
  TextLine line;
  return times.take_line(line) ? std::string(line.finish()) : "";
}

TEST(IgnitionTimes, TellOfAnEdgeOnceItHasBeenFollowed) {
  IgnitionTimes times;
  times.ignition(true, {1'000'000, 10});
  EXPECT_EQ(line_of(times), "");
  times.handed(false, {41'000'000, 12});
  times.sent(false, {55'000'000, 13});
  EXPECT_EQ(line_of(times), "") << "not lit yet";
  times.light(true, {71'000'000, 14});
  EXPECT_EQ(line_of(times), "ignition 1 light_us=70000 vcompares=2\n");
  EXPECT_EQ(line_of(times), "");

  times.ignition(false, {100'000'000, 20});
  times.light(false, {100'004'000, 20});
  times.handed(false, {101'000'000, 20});  // a picture that was on its way
  times.sent(false, {110'000'000, 21});
  EXPECT_EQ(line_of(times), "");
  times.handed(true, {112'000'000, 21});
  times.sent(true, {126'000'000, 22});
  EXPECT_EQ(line_of(times), "ignition 0 light_us=4 black_us=26000 vcompares=1\n");
}

TEST(IgnitionTimes, AnEdgeThatBouncesCountsFromTheLastOne) {
  IgnitionTimes times;
  times.ignition(true, {1'000'000, 1});
  times.ignition(false, {2'000'000, 1});
  times.ignition(true, {3'000'000, 1});
  times.ignition(true, {4'000'000, 1});
  times.handed(false, {5'000'000, 1});
  times.light(true, {9'000'000, 3});
  EXPECT_EQ(line_of(times), "ignition 1 light_us=6000 vcompares=2\n");
}

}  // namespace
}  // namespace usuzumi::boards::cortex_a9
