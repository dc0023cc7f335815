#include "hal/drivers/controller_display.h"

namespace usuzumi {
namespace {

constexpr std::uint32_t kLayer = 0;
/// Longer than four frames of the slowest mode the display driver makes (23 Hz).
constexpr std::uint32_t kVerticalBlankTimeoutUs = 200'000;
/// An interrupt left pending from before costs one wait that ends at once.
constexpr int kVerticalBlankWaits = 3;

LayerFormat layer_format(command::PixelFormat format) {
  return format == command::PixelFormat::kRgb565 ? LayerFormat::kRgb565 : LayerFormat::kXrgb8888;
}

}  // namespace

Status ControllerDisplay::do_start(const Scanout& scanout) {
  scanout_ = scanout;
  partial_ = false;
  Status status = driver_.probe();
  const auto mode = make_display_mode(scanout.width, scanout.height);
  if (status.ok()) status = mode.status();
  if (status.ok()) status = driver_.set_mode(*mode);
  if (status.ok()) status = configure_layer(scanout.whole(), 0);
  if (status.ok()) status = driver_.show_layer(kLayer, true);
  if (!status.ok()) return status;
  driver_.set_background(0);
  driver_.enable_picture_signature(true);
  driver_.enable_vertical_blank_interrupt(true);
  return status;
}

Status ControllerDisplay::configure_layer(const PictureRectangle& part, std::uint32_t picture) {
  // Addresses of a layer are multiples of 4 bytes: two pixels of the smaller format.
  const std::uint32_t x = part.x & ~1u;
  const std::uint32_t offset = part.y * scanout_.stride_bytes + x * command::bytes_per_pixel(scanout_.format);
  LayerConfig layer;
  layer.format = layer_format(scanout_.format);
  layer.stride_bytes = scanout_.stride_bytes;
  layer.bank_address[0] = scanout_.picture[0] + offset;
  layer.bank_address[1] = scanout_.picture[1] + offset;
  layer.bank = picture;
  layer.x = static_cast<std::int32_t>(x);
  layer.y = static_cast<std::int32_t>(part.y);
  layer.width = part.width + (part.x - x);
  layer.height = part.height;
  return driver_.configure_layer(kLayer, layer);
}

Status ControllerDisplay::do_show(std::uint32_t picture, const PictureRectangle* part) {
  const bool shows = part == nullptr || !part->empty();
  Status status = ok_status();
  if (!shows) status = driver_.show_layer(kLayer, false);
  else if (part != nullptr || partial_) status = configure_layer(part != nullptr ? *part : scanout_.whole(), picture);
  else status = driver_.request_flip(kLayer, picture);
  if (!status.ok()) return status;
  if (shows) {
    partial_ = part != nullptr;
    // After the flip: a vertical blank between the two then shows nothing yet, not the other picture.
    status = driver_.show_layer(kLayer, true);
    if (!status.ok()) return status;
  }
  return driver_.running() ? wait_for_vertical_blank() : driver_.enable();
}

Status ControllerDisplay::wait_for_vertical_blank() {
  const std::uint32_t frame = driver_.frame_count();
  for (int i = 0; i < kVerticalBlankWaits; ++i) {
    driver_.clear_vertical_blank();
    const Status status = interrupts_.wait(Interrupt::kVerticalBlank, kVerticalBlankTimeoutUs);
    if (!status.ok()) return status;
    if (driver_.frame_count() != frame) return ok_status();
  }
  return {StatusCode::kDeadlineExceeded, "display: no vertical blank took the picture", 0};
}

Status ControllerDisplay::do_check() {
  const DisplayFaults faults = driver_.faults();
  if (!faults.any()) return ok_status();
  driver_.clear_faults();
  if (faults.configuration_error)
    return {StatusCode::kInvalidArgument, "display: configuration refused; CFGE", faults.configuration_detail};
  if (faults.fifo_underflow)
    return {StatusCode::kUnavailable, "display: FIFO ran empty, the bus is too slow for this picture", 0};
  return {StatusCode::kDataLoss, "display: signature differs from its reference", 0};
}

}  // namespace usuzumi
