#include "gfx_subsystem/display/display_controller.h"

#include <algorithm>
#include <span>

#include "hal/crc32.h"

namespace usuzumi::gfx {

using namespace display_registers;

DisplayController::DisplayController(BusMemory& memory, VideoSink& sink, const DisplayConfig& config, RegisterLog* log)
    : memory_(memory),
      sink_(sink),
      fifo_{config.reference_hz, config.bus_bytes_per_second, config.fifo_bytes},
      registers_(kTable, log) {}

// ---------------------------------------------------------------------------------------------------------------- time

/// The signal begins with the vertical sync.
void DisplayController::start() {
  if (!latch()) return;
  geometry_ = next_geometry_;
  running_ = true;
  line_ = geometry_.vsync_line - 1;
  next_line_time_ = now_;
  begin_line();
}

void DisplayController::advance_to(std::uint64_t now) {
  now_ = now;
  while (running_ && next_line_time_ <= now) begin_line();
}

std::uint64_t DisplayController::next_vertical_blank() const {
  if (!running_) return kNever;
  const std::uint64_t next_line = line_ + 1;
  if (next_line <= geometry_.height) return next_line_time_ + (geometry_.height - next_line) * geometry_.line_ticks();
  const std::uint64_t frame_start = next_line_time_ + (geometry_.frame_lines - next_line) * geometry_.line_ticks();
  // The timing latched at this blank rules from the frame's start on.
  return frame_start + next_geometry_.height * next_geometry_.line_ticks();
}

void DisplayController::begin_line() {
  if (++line_ == geometry_.frame_lines) {
    line_ = 0;
    if (Dcm1::kDen.get(registers_.value(Dcm1::kOffset)) == 0) {
      running_ = false;
      return;
    }
    geometry_ = next_geometry_;
  }
  if (line_ == geometry_.height) begin_vertical_blank();
  const LineKind kind = geometry_.kind(line_);
  if (kind == LineKind::kPicture) send_picture_line();
  send_blanking(kind == LineKind::kVerticalSync);
  next_line_time_ += geometry_.line_ticks();
}

void DisplayController::begin_vertical_blank() {
  const std::uint32_t frame = registers_.value(Fcnt::kOffset) + 1;
  registers_.set_value(Fcnt::kOffset, frame);
  finish_signatures();
  if (Lock::kLock.get(registers_.value(Lock::kOffset)) == 0) latch();
  raise(kIntVerticalBlank);
}

// ------------------------------------------------------------------------------------------------------------- picture

void DisplayController::send_picture_line() {
  std::array<LayerRow, FrameConfig::kCursor + 1> rows;
  std::array<FetchSpan, FrameConfig::kCursor + 1> spans;
  const std::size_t count = gather_rows(rows, spans);
  compose_line(frame_.background_rgb, std::span(rows).first(count), std::span(pixels_).first(geometry_.width));

  // Before line 0 the FIFO has had the whole vertical blank to fill.
  const std::uint64_t blank_lines = line_ == 0 ? geometry_.frame_lines - geometry_.height : 0;
  const std::uint64_t blank_pixels =
      geometry_.line_pixels - geometry_.width + blank_lines * geometry_.line_pixels;
  const std::uint32_t starved =
      first_starved_pixel(std::span(spans).first(count), geometry_.width, geometry_.divider, blank_pixels, fifo_);
  if (starved < geometry_.width) starve_line(starved);

  sign_line();
  sink_.segment({.data_enable = true, .pixel_count = geometry_.width, .xrgb = pixels_.data()});
}

/// The rows that meet this line, back to front, with what each fetches. A row that is not in memory is left out.
std::size_t DisplayController::gather_rows(std::array<LayerRow, FrameConfig::kCursor + 1>& rows,
                                           std::array<FetchSpan, FrameConfig::kCursor + 1>& spans) {
  std::size_t count = 0;
  for (const LayerConfig& layer : frame_.layers) {
    const RowCut cut = cut_row(layer, line_, geometry_.width);
    if (!cut.visible) continue;
    const std::uint32_t bytes = bytes_per_pixel(layer.look.format);
    std::span<const std::byte> pixels;
    if (cut.address <= 0xFFFFFFFFu)
      pixels = memory_.read_window(static_cast<BusAddress>(cut.address), std::size_t{cut.x_end - cut.x_begin} * bytes);
    if (pixels.data() == nullptr) {
      raise_configuration_error(layer.error_bit);
      continue;
    }
    rows[count] = layer.look;
    rows[count].pixels = pixels.data();
    rows[count].x_begin = cut.x_begin;
    rows[count].x_end = cut.x_end;
    spans[count] = {cut.x_begin, cut.x_end, bytes};
    ++count;
  }
  return count;
}

/// A starved line goes on with its last delivered pixel; where there is none, with the background colour.
void DisplayController::starve_line(std::uint32_t first_starved) {
  const std::uint32_t shown = first_starved > 0 ? pixels_[first_starved - 1] : frame_.background_rgb;
  std::fill(pixels_.begin() + first_starved, pixels_.begin() + geometry_.width, shown);
  ++starved_lines_;
  raise(kIntFifoUnderflow);
}

void DisplayController::send_blanking(bool vsync) {
  const std::uint32_t picture = line_ < geometry_.height ? 0 : geometry_.width;
  sink_.segment({.vsync = vsync, .pixel_count = picture + geometry_.front_porch});
  sink_.segment({.hsync = true, .vsync = vsync, .pixel_count = geometry_.sync});
  sink_.segment({.vsync = vsync, .pixel_count = geometry_.back_porch});
}

// ----------------------------------------------------------------------------------------------------------- signature

void DisplayController::sign_line() {
  const Window& w = frame_.window;
  const bool in_window = frame_.window_signature && line_ >= w.y && line_ - w.y < w.height;
  if (line_ == 0) picture_crc_ = window_crc_ = kCrc32Start;
  if (!frame_.picture_signature && !in_window) return;
  const std::uint32_t begin = frame_.picture_signature ? 0 : w.x;
  const std::uint32_t end = frame_.picture_signature ? geometry_.width : w.x + w.width;
  pack_rgb(std::span(pixels_).subspan(begin, end - begin), rgb_.data());
  if (frame_.picture_signature) picture_crc_ = crc32(picture_crc_, std::span(rgb_).first(std::size_t{3} * end));
  if (in_window)
    window_crc_ = crc32(window_crc_, std::span(rgb_).subspan(std::size_t{3} * (w.x - begin), std::size_t{3} * w.width));
}

void DisplayController::finish_signatures() {
  if (!frame_.picture_signature && !frame_.window_signature) return;
  if (frame_.picture_signature) registers_.set_value(SgPic::kOffset, picture_crc_);
  if (frame_.window_signature) {
    registers_.set_value(SgWin::kOffset, window_crc_);
    if (frame_.check_window && window_crc_ != frame_.reference_crc) raise(kIntSignatureMismatch);
  }
  registers_.set_value(SgFr::kOffset, registers_.value(Fcnt::kOffset));
}

}  // namespace usuzumi::gfx
