// What device tests of the display controller share: a piece of memory on a bus, a tap on the cable, a small legal
// timing. Registers are written by literal offsets, so that a slip in the register header shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "gfx_subsystem/display/display_controller.h"

namespace usuzumi::gfx {

/// Memory from kBase on; nothing else answers.
class TestMemory final : public BusMemory {
 public:
  static constexpr BusAddress kBase = 0x80000000;
  explicit TestMemory(std::size_t size) : bytes_(size) {}

  void put32(BusAddress address, std::uint32_t value) { std::memcpy(&bytes_[address - kBase], &value, 4); }
  void put16(BusAddress address, std::uint16_t value) { std::memcpy(&bytes_[address - kBase], &value, 2); }
  void fill32(BusAddress address, std::size_t count, std::uint32_t value) {
    for (std::size_t i = 0; i < count; ++i) put32(address + static_cast<BusAddress>(4 * i), value);
  }

 private:
  std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const override {
    if (address < kBase || address - kBase > bytes_.size() || size > bytes_.size() - (address - kBase)) return {};
    return {bytes_.data() + (address - kBase), size};
  }
  std::span<std::byte> do_write_window(BusAddress address, std::size_t size) override {
    const auto window = do_read_window(address, size);
    return {const_cast<std::byte*>(window.data()), window.size()};
  }

  std::vector<std::byte> bytes_;
};

/// Keeps the picture lines, and every segment without its pixels.
class CableTap final : public VideoSink {
 public:
  std::vector<std::vector<std::uint32_t>> lines;
  std::vector<VideoSegment> segments;
  void forget() {
    lines.clear();
    segments.clear();
  }

 private:
  void do_segment(const VideoSegment& segment) override {
    if (segment.data_enable) lines.emplace_back(segment.xrgb, segment.xrgb + segment.pixel_count);
    segments.push_back(segment);
    segments.back().xrgb = nullptr;
  }
};

/// Eight pixels by four lines: front porch 1, sync 2, back porch 1 (12 pixels a line); 1, 1, 1 (7 lines). SC = 3: 4
/// ticks a pixel, 48 ticks a line, 336 a frame. The signal starts in line 5 (VSYNC): line 0 begins 96 ticks, the
/// vertical blank 288 ticks after the start.
class SmallDisplay {
 public:
  static constexpr std::uint64_t kLineTicks = 48, kFrameTicks = 336, kFirstLine0 = 96, kFirstBlank = 288;

  explicit SmallDisplay(const DisplayConfig& config = {}, RegisterLog* log = nullptr)
      : controller(memory, cable, config, log) {
    write(0x004, 11u << 16);                       // HTP
    write(0x008, 7);                               // HDP
    write(0x00C, 0u << 24 | 1u << 16 | 8);         // VSW HSW HSP
    write(0x010, 6u << 16);                        // VTR
    write(0x014, 3u << 16 | 4);                    // VDP VSP
    write(0x100, 3u << 8);                         // SC
  }

  std::uint32_t read(std::uint32_t offset) { return controller.read(offset); }
  void write(std::uint32_t offset, std::uint32_t value) { controller.write(offset, value); }
  void set(std::uint32_t offset, std::uint32_t bits) { write(offset, read(offset) | bits); }
  void clear(std::uint32_t offset, std::uint32_t bits) { write(offset, read(offset) & ~bits); }

  /// Layer n: an XRGB8888 picture of w x h at `address`, stride 4 w, shown from the next latch on.
  void show_layer(std::uint32_t n, BusAddress address, std::int32_t x, std::int32_t y, std::uint32_t w, std::uint32_t h,
                  std::uint32_t mode = 0x00FF0001, std::uint32_t bytes_per_pixel = 4) {
    const std::uint32_t base = 0x140 + 0x40 * n;
    write(base + 0x00, mode);
    write(base + 0x04, w * bytes_per_pixel);
    write(base + 0x08, address);
    write(base + 0x0C, address);
    write(base + 0x10, (static_cast<std::uint32_t>(y) & 0x1FFF) << 16 | (static_cast<std::uint32_t>(x) & 0x1FFF));
    write(base + 0x14, (h - 1) << 16 | (w - 1));
    set(0x100, 1u << (16 + n));
  }
  void turn_on() { set(0x100, 1u << 31); }
  /// To the first vertical blank, with what it sent of picture lines in `cable.lines`.
  void run_one_picture() {
    turn_on();
    controller.advance_to(kFirstBlank);
  }

  TestMemory memory{1 << 20};
  CableTap cable;
  DisplayController controller;
};

}  // namespace usuzumi::gfx
