// The closed form against the model carried out pixel by pixel, and against hand-worked lines.
#include "gfx_subsystem/display/fifo.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace usuzumi::gfx {
namespace {

/// The model as the header tells it, one pixel clock at a time.
std::uint32_t stepped(const std::vector<FetchSpan>& spans, std::uint32_t width, std::uint32_t ticks_per_pixel,
                      std::uint64_t blank_pixels, const FifoModel& m) {
  const std::uint64_t supply = m.bus_bytes_per_second * ticks_per_pixel, capacity = m.fifo_bytes * m.ticks_per_second;
  std::uint64_t fill = 0;
  for (std::uint64_t i = 0; i < blank_pixels; ++i) fill = std::min(capacity, fill + supply);
  for (std::uint32_t x = 0; x < width; ++x) {
    std::uint64_t demand = 0;
    for (const FetchSpan& s : spans)
      if (x >= s.begin && x < s.end) demand += s.bytes_per_pixel * m.ticks_per_second;
    if (fill < demand) return x;
    fill = std::min(capacity, fill - demand + supply);
  }
  return width;
}

TEST(Fifo, EnoughBusNeverStarves) {
  const FetchSpan span{0, 1920, 4};
  // 400 M ticks, 4 ticks a pixel: 100 M pixels of 4 bytes need 400 MB/s.
  EXPECT_EQ(first_starved_pixel({&span, 1}, 1920, 4, 160, {400'000'000, 400'000'000, 64}), 1920u);
}

TEST(Fifo, OneByteASecondTooLittleStarvesOnceTheFifoIsEmpty) {
  const FetchSpan span{0, 1000, 4};
  // Ten ticks a second, one tick a pixel: a pixel needs 40 of these units, the bus brings 30 bytes a second: 30. The
  // FIFO starts with 8 bytes = 80; before pixel k it holds 80 - 10 k, and starves when that is below 40: k = 5.
  EXPECT_EQ(first_starved_pixel({&span, 1}, 1000, 1, 1000, {10, 30, 8}), 5u);
}

TEST(Fifo, DeadBusStarvesAtTheFirstPixelALayerNeeds) {
  const FetchSpan span{7, 20, 2};
  EXPECT_EQ(first_starved_pixel({&span, 1}, 30, 1, 50, {10, 0, 64}), 7u);
  EXPECT_EQ(first_starved_pixel({}, 30, 1, 50, {10, 0, 64}), 30u) << "nothing is fetched";
}

TEST(Fifo, AFifoSmallerThanAPixelStarvesAtOnce) {
  const FetchSpan span{3, 20, 4};
  EXPECT_EQ(first_starved_pixel({&span, 1}, 20, 1, 50, {10, 1'000'000, 3}), 3u);
}

TEST(Fifo, ClosedFormEqualsTheSteppedModel) {
  std::mt19937 random(7);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  int starved = 0;
  for (int round = 0; round < 20000; ++round) {
    const std::uint32_t width = 2 + below(300);
    std::vector<FetchSpan> spans;
    for (std::uint32_t n = below(6); n > 0; --n) {
      const std::uint32_t begin = below(width), end = begin + 1 + below(width - begin);
      spans.push_back({begin, end, below(2) == 0 ? 2u : 4u});
    }
    const FifoModel model{1 + below(50), below(400), below(200)};
    const std::uint32_t ticks = 1 + below(4), blank = below(60);
    const std::uint32_t expected = stepped(spans, width, ticks, blank, model);
    starved += expected < width ? 1 : 0;
    ASSERT_EQ(first_starved_pixel(spans, width, ticks, blank, model), expected) << "round " << round;
  }
  EXPECT_GT(starved, 2000);
  EXPECT_LT(starved, 18000);
}

}  // namespace
}  // namespace usuzumi::gfx
