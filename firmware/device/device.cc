#include "firmware/device/device.h"

namespace usuzumi::firmware {
namespace {

constexpr std::uint32_t kPictureLayer = 0;
/// Longer than four frames of the slowest mode the display driver makes (23 Hz).
constexpr std::uint32_t kVerticalBlankTimeoutUs = 200'000;
/// An interrupt left pending from before costs one wait that ends at once.
constexpr int kVerticalBlankWaits = 3;

LayerFormat layer_format(command::PixelFormat format) {
  return format == command::PixelFormat::kRgb565 ? LayerFormat::kRgb565 : LayerFormat::kXrgb8888;
}

}  // namespace

Status Device::boot(const DeviceConfig& config) {
  booted_ = showing_ = false;
  back_ = 0;
  config_ = config;
  const auto data = DrawingData::open(ports_.rom);
  if (!data.ok()) return data.status();
  data_ = *data;

  const auto vram = plan_vram(ports_.vram_base, ports_.vram_bytes, config.width, config.height, config.pixel_format,
                              config.depth_format);
  if (!vram.ok()) return vram.status();
  vram_ = *vram;

  ram_ = Arena(ports_.ram);
  command_words_ = ram_.allocate<std::uint32_t>(scene_command_words(data_.mesh_max()));
  if (command_words_.empty())
    return {StatusCode::kResourceExhausted, "RAM has no room for the command list; meshes", data_.mesh_max()};
  Status status = thinning_.begin(data_, ram_);
  if (status.ok()) status = engine_.probe();
  if (status.ok()) status = boot_display();
  booted_ = status.ok();
  return status;
}

Status Device::boot_display() {
  Status status = display_.probe();
  const auto mode = make_display_mode(config_.width, config_.height);
  if (status.ok()) status = mode.status();
  if (status.ok()) status = display_.set_mode(*mode);
  LayerConfig layer;
  layer.format = layer_format(config_.pixel_format);
  layer.stride_bytes = vram_.picture_stride_bytes;
  layer.bank_address[0] = vram_.picture[0];
  layer.bank_address[1] = vram_.picture[1];
  layer.width = config_.width;
  layer.height = config_.height;
  if (status.ok()) status = display_.configure_layer(kPictureLayer, layer);
  if (status.ok()) status = display_.show_layer(kPictureLayer, true);
  display_.enable_picture_signature(true);
  display_.enable_vertical_blank_interrupt(true);
  return status;
}

Status Device::draw_frame(const FrameRequest& request, FrameReport& report) {
  report = {};
  if (!booted_) return {StatusCode::kFailedPrecondition, "draw_frame before a successful boot", 0};
  const View view{request.model_to_clip, config_.width, config_.height};
  const std::uint64_t begin = ports_.clock.now_ns();
  Status status = thinning_.update(request.thinning, view, ports_.clock, report.thinning);
  const std::uint64_t thinned = ports_.clock.now_ns();
  report.thin_ns = thinned - begin;
  if (status.ok()) status = draw_list(view, request.lighting, report);
  const std::uint64_t drawn = ports_.clock.now_ns();
  report.draw_ns = drawn - thinned;
  if (status.ok()) status = show_picture(report);
  report.wait_ns = ports_.clock.now_ns() - drawn;
  return status;
}

Status Device::draw_list(const View& view, const Lighting& lighting, FrameReport& report) {
  const FrameTarget target{vram_.picture[back_], vram_.picture_stride_bytes, config_.pixel_format,
                           vram_.depth,          vram_.depth_stride_bytes,   config_.depth_format};
  const auto list = write_scene(thinning_.copy(), view, lighting, target, ports_.bus, command_words_);
  if (!list.ok()) return list.status();
  ports_.clock.charge(CpuWork::kCommandWritten, list->size());
  Status status = engine_.start(ports_.bus.bus_address(list->data()), static_cast<std::uint32_t>(list->size()));
  if (status.ok()) status = engine_.wait_done(config_.engine_timeout_us);
  report.engine_cycles = engine_.cycles();
  report.faces_drawn = engine_.faces_drawn();
  return status;
}

/// Shows the picture just drawn: the first by switching the display on, each later one by a flip at vertical blank.
Status Device::show_picture(FrameReport& report) {
  if (!showing_) {
    Status status = display_.enable();
    if (!status.ok()) return status;
    showing_ = true;
  } else {
    Status status = display_.request_flip(kPictureLayer, back_);
    if (!status.ok()) return status;
    for (int i = 0; i < kVerticalBlankWaits && display_.flip_pending(kPictureLayer); ++i) {
      display_.clear_vertical_blank();
      status = ports_.interrupts.wait(Interrupt::kVerticalBlank, kVerticalBlankTimeoutUs);
      if (!status.ok()) return status;
    }
    if (display_.flip_pending(kPictureLayer))
      return {StatusCode::kDeadlineExceeded, "display: no vertical blank took the flip", 0};
  }
  report.shown_in_frame = display_.frame_count() + 1;
  back_ ^= 1;
  return ok_status();
}

std::uint64_t Device::ram_peak_bytes() const {
  const std::uint64_t copy_memory = thinning_.copy().capacity_bytes();
  return ram_.used() - copy_memory + thinning_.copy().peak_bytes();
}

}  // namespace usuzumi::firmware
