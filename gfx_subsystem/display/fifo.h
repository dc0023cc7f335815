// The FIFO between bus and pixels: when does a line run dry?
//
// Model. The bus delivers a constant `bus_bytes_per_second`. Fetching for a line starts when the last pixel of the
// picture line before it has been sent and fills the FIFO to `fifo_bytes` at most. At each pixel clock the pixel takes
// its bytes (the sum over the layers fetched there) and then the bus adds what it delivers in one clock. A pixel whose
// bytes are not there is starved, and with it the rest of its line: the FIFO is flushed and begins anew with the next
// line.
//
// Between two places where a layer begins or ends, demand d and supply s per pixel are constant, so that the fill q
// before the k-th pixel is q0 + k (s - d), capped at the FIFO's size F:
//   s >= d: q never falls, so that the first pixel decides: starved iff q0 < d;
//   s <  d: q never meets the cap after the first pixel; pixel k is starved iff q0 - k (d - s) < d, the first
//           such being k = floor((q0 - d) / (d - s)) + 1, or 0 when q0 < d.
// All amounts are held in bytes * ticks_per_second, so that nothing is rounded; below 2^63 for 20 bytes a pixel, lines
// of 8192 pixels, and buses and clocks up to 100 G per second.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace usuzumi::gfx {

struct FifoModel {
  std::uint64_t ticks_per_second = 400'000'000;
  std::uint64_t bus_bytes_per_second = 0;
  std::uint32_t fifo_bytes = 0;
};

/// Pixels begin .. end - 1 of a line, for each of which a layer fetches `bytes_per_pixel`.
struct FetchSpan {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t bytes_per_pixel = 0;
};

/// The first starved pixel of a line, `width` when none is. `spans`: at most eight, inside the line.
/// `ticks_per_pixel` 1..64; `blank_pixels`: pixel clocks between the picture line before and this one.
constexpr std::uint32_t first_starved_pixel(std::span<const FetchSpan> spans, std::uint32_t width,
                                            std::uint32_t ticks_per_pixel, std::uint64_t blank_pixels,
                                            const FifoModel& model) {
  const std::uint64_t supply = model.bus_bytes_per_second * ticks_per_pixel;
  const std::uint64_t capacity = model.fifo_bytes * model.ticks_per_second;
  // A FIFO that fills in fewer clocks than the blank has is full, whatever the product would be.
  std::uint64_t fill =
      supply > 0 && blank_pixels > capacity / supply ? capacity : std::min(capacity, supply * blank_pixels);

  for (std::uint32_t x = 0; x < width;) {
    std::uint32_t next = width;
    std::uint64_t demand = 0;
    for (const FetchSpan& s : spans) {
      if (s.begin > x) next = std::min(next, s.begin);
      if (s.end > x) next = std::min(next, s.end);
      if (s.begin <= x && x < s.end) demand += s.bytes_per_pixel * model.ticks_per_second;
    }
    const std::uint64_t pixels = next - x;
    if (fill < demand) return x;
    if (supply >= demand) {
      fill = std::min(capacity, fill + pixels * (supply - demand));
    } else {
      const std::uint64_t starved = (fill - demand) / (demand - supply) + 1;
      if (starved < pixels) return x + static_cast<std::uint32_t>(starved);
      fill -= pixels * (demand - supply);
    }
    x = next;
  }
  return width;
}

}  // namespace usuzumi::gfx
