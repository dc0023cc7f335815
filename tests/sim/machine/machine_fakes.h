// An engine that draws nothing and takes as long as the test says, and a panel that only counts.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>

#include "gfx_subsystem/display/video_signal.h"
#include "gfx_subsystem/engine/engine.h"

namespace usuzumi::sim {

class ScriptedEngine final : public gfx::Engine {
 public:
  gfx::ExecutionReport report;
  std::uint32_t executions = 0;
  BusAddress paint_address = 0;  // one word written by each execution, when not 0
  std::uint32_t paint_word = 0;

 private:
  gfx::ExecutionReport do_execute(std::span<const std::uint32_t>, BusMemory& memory) override {
    ++executions;
    if (paint_address != 0) {
      const std::span<std::byte> target = memory.write_window(paint_address, 4);
      if (target.data() != nullptr) std::memcpy(target.data(), &paint_word, 4);
    }
    return report;
  }
};

class CountingPanel final : public gfx::VideoSink {
 public:
  std::uint64_t pixel_clocks = 0;
  std::uint64_t visible_pixels = 0;
  std::uint32_t first_pixel = 0;  // of the last visible segment

 private:
  void do_segment(const gfx::VideoSegment& segment) override {
    pixel_clocks += segment.pixel_count;
    if (!segment.data_enable) return;
    visible_pixels += segment.pixel_count;
    first_pixel = segment.xrgb[0];
  }
};

}  // namespace usuzumi::sim
