// The cable between display controller and panel: pixels and sync, nothing else. Whoever wants a picture rebuilds it.
#pragma once

#include <cstdint>

namespace usuzumi::gfx {

/// A run of pixel clocks during which the sync lines do not change. Syncs are given as asserted or not; polarity is the
/// panel's affair.
struct VideoSegment {
  bool hsync = false;
  bool vsync = false;
  bool data_enable = false;
  std::uint32_t pixel_count = 0;
  const std::uint32_t* xrgb = nullptr;  // pixel_count words 0x00RRGGBB, valid during the call; nullptr in blanking
};

class VideoSink {
 public:
  /// Segments come in the order of time, without gaps while the display runs.
  void segment(const VideoSegment& segment) { do_segment(segment); }

 protected:
  ~VideoSink() = default;

 private:
  virtual void do_segment(const VideoSegment& segment) = 0;
};

}  // namespace usuzumi::gfx
