#include "sim/panel/panel.h"

namespace usuzumi::sim {

void Panel::do_segment(const gfx::VideoSegment& segment) {
  if (segment.hsync && !hsync_) end_line();
  if (segment.vsync && !vsync_) end_picture();
  hsync_ = segment.hsync;
  vsync_ = segment.vsync;
  line_clocks_ += segment.pixel_count;
  if (segment.data_enable) take_pixels(segment);
}

void Panel::take_pixels(const gfx::VideoSegment& segment) {
  if (!synchronised_) return;
  const bool too_large = segment.pixel_count > kMaxSize - line_pixels_ || height_ >= kMaxSize;
  if (segment.hsync || segment.vsync || segment.xrgb == nullptr || too_large) {
    distrust();
    return;
  }
  if (!trusted_) return;
  line_pixels_ += segment.pixel_count;
  pixels_.insert(pixels_.end(), segment.xrgb, segment.xrgb + segment.pixel_count);
}

/// At the rise of HSYNC: a line of picture has its length, as all others of its frame.
void Panel::end_line() {
  if (line_whole_) {
    if (line_clocks_expected_ == 0) line_clocks_expected_ = line_clocks_;
    if (line_clocks_ != line_clocks_expected_) distrust();
  }
  line_clocks_ = 0;
  if (line_pixels_ != 0) {
    if (height_ == 0) width_ = line_pixels_;
    if (line_pixels_ != width_) distrust();
    ++height_;
    line_pixels_ = 0;
  }
  line_whole_ = height_ > 0;
}

/// At the rise of VSYNC: what has been received since the last one is a picture, or nothing.
void Panel::end_picture() {
  if (line_pixels_ != 0) distrust();  // VSYNC amid a line of picture
  if (height_ > 0 || !trusted_) {  // neither before the first VSYNC
    stable_ = trusted_;
    if (trusted_) {
      shown_.picture.width = width_;
      shown_.picture.height = height_;
      shown_.picture.xrgb.swap(pixels_);
      shown_.number = frames_completed_++;
      if (callback_) callback_(shown_);
    } else {
      ++frames_dropped_;
    }
  }
  synchronised_ = true;
  trusted_ = true;
  line_whole_ = false;
  line_clocks_expected_ = 0;
  width_ = height_ = line_pixels_ = 0;
  pixels_.clear();
}

}  // namespace usuzumi::sim
