// The panel: rebuilds pictures from pixels and sync alone. It knows no register, no frame size and no address.
//
// A picture is what came with data enable between two rises of VSYNC; its lines are parted by rises of HSYNC. The panel
// waits for a first VSYNC. A signal it cannot trust (lines of different length from the first picture line on, VSYNC or
// HSYNC amid pixels, data enable without pixels, pictures beyond 16384 x 16384) is unstable; that picture is dropped.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "gfx_subsystem/display/video_signal.h"
#include "sim/image/image.h"

namespace usuzumi::sim {

struct PanelFrame {
  Image picture;
  std::uint64_t number = 0;  // complete pictures before this one
  /// Computed from the rebuilt picture.
  std::uint32_t crc32() const { return picture_crc32(picture); }
};

class Panel final : public gfx::VideoSink {
 public:
  using FrameCallback = std::function<void(const PanelFrame&)>;

  /// Called when a picture is complete; the frame stays valid until the next one is.
  void on_frame(FrameCallback callback) { callback_ = std::move(callback); }

  /// The last complete picture; empty before the first.
  const PanelFrame& last_frame() const { return shown_; }
  std::uint64_t frames_completed() const { return frames_completed_; }
  std::uint64_t frames_dropped() const { return frames_dropped_; }
  /// False before the first VSYNC and after an unstable picture, until a good one.
  bool stable() const { return stable_; }

 private:
  static constexpr std::uint32_t kMaxSize = 16384;

  void do_segment(const gfx::VideoSegment& segment) override;
  void take_pixels(const gfx::VideoSegment& segment);
  void end_line();
  void end_picture();
  void distrust() { trusted_ = false; }

  FrameCallback callback_;
  PanelFrame shown_;
  std::vector<std::uint32_t> pixels_;  // of the picture being received
  std::uint32_t width_ = 0, height_ = 0;
  std::uint32_t line_pixels_ = 0;          // with data enable, in the line being received
  std::uint64_t line_clocks_ = 0;          // since the last HSYNC rise
  std::uint64_t line_clocks_expected_ = 0; // 0 before the first that counts
  bool hsync_ = false, vsync_ = false;
  bool synchronised_ = false;  // a VSYNC has been seen
  bool line_whole_ = false;    // began after the first picture line, so that its length counts
  bool trusted_ = true;
  bool stable_ = false;
  std::uint64_t frames_completed_ = 0, frames_dropped_ = 0;
};

}  // namespace usuzumi::sim
