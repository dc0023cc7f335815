#include "firmware/device/device.h"

#include <cstring>

#include "firmware/device/safe_picture.h"

namespace usuzumi::firmware {

Status Device::boot(const DeviceConfig& config) {
  booted_ = display_ready_ = painted_ = false;
  back_ = 0;
  config_ = config;
  // The display first, so that whatever fails later can be told by the safe picture.
  const auto vram = fit_vram(config);
  if (!vram.ok()) return vram.status();
  vram_ = *vram;
  Status status = ports_.display.start(vram_.scanout);
  if (!status.ok()) return status;
  display_ready_ = true;

  const auto data = DrawingData::open(ports_.rom);
  if (!data.ok()) return data.status();
  if (!data->board().empty() && !config.board.empty() && data->board() != config.board)
    return {StatusCode::kUnsupported, "drawing data are for another board, whose name stands at byte offset",
            static_cast<std::uint32_t>(reinterpret_cast<const std::byte*>(data->board().data()) - ports_.rom.data())};
  data_ = *data;
  ram_ = Arena(ports_.ram);
  const std::uint32_t words = scene_command_words(data_);
  command_words_ = ram_.allocate<std::uint32_t>(words);
  if (command_words_.empty())
    return {StatusCode::kResourceExhausted, "RAM has no room for the command list; its words", words};
  status = solids_.begin(data_.solids(), ram_);
  if (!status.ok()) return status;
  status = thinning_.begin(data_, ram_, rom_on_bus(), config.boot_layers_millionths);
  if (status.ok()) status = engine_.probe();
  booted_ = status.ok();
  return status;
}

/// Whether the 3D engine reads all of the ROM.
bool Device::rom_on_bus() const {
  const BusAddress rom = ports_.bus.bus_address(ports_.rom.data());
  return rom != 0 && rom % 4 == 0 && ports_.memory.read_window(rom, ports_.rom.size()).data() != nullptr;
}

/// Why the display has no rows for such a picture: it says so itself.
Status Device::refusal(const Scanout& wanted) {
  const Status status = ports_.display.start(wanted);
  return !status.ok() ? status : Status{StatusCode::kUnavailable, "display: no rows of this width", wanted.width};
}

Result<VramLayout> Device::fit_vram(const DeviceConfig& config) {
  struct Formats {
    command::PixelFormat pixel;
    command::DepthFormat depth;
  };
  const bool depth24 = config.depth_format == command::DepthFormat::kUnorm24;
  const command::DepthFormat smaller = depth24 ? command::DepthFormat::kUnorm16 : config.depth_format;
  const Formats choices[] = {{config.pixel_format, config.depth_format},
                             {config.pixel_format, smaller},
                             {command::PixelFormat::kRgb565, smaller}};
  if (config.width == 0 || config.height == 0)
    return Status{StatusCode::kInvalidArgument, "picture width and height must be 1 to 4096, not", 0};
  Result<VramLayout> first = VramLayout{};
  for (const Formats& f : choices) {
    Scanout wanted{config.width, config.height, f.pixel, 0, {}};
    wanted.stride_bytes = ports_.display.stride_bytes(config.width, config.height, f.pixel);
    const Result<VramLayout> layout = wanted.stride_bytes > 0
                                          ? plan_vram(ports_.vram_base, ports_.vram_bytes, wanted, f.depth)
                                          : refusal(wanted);
    if (layout.ok()) return layout;
    if (first.ok()) first = layout.status();  // what was asked for is what the answer is about
  }
  return first;
}

Status Device::draw_frame(const FrameRequest& request, FrameReport& report) {
  const Status status = draw_picture(request, report);
  return status.ok() ? show_picture(report) : status;
}

Status Device::draw_picture(const FrameRequest& request, FrameReport& report) {
  report = {};
  if (!booted_) return {StatusCode::kFailedPrecondition, "draw_picture before a successful boot", 0};
  const View view{request.model_to_clip, config_.width, config_.height};
  const std::uint64_t begin = ports_.clock.now_ns();
  Status status = thinning_.update(request.thinning, view, ports_.clock, report.thinning);
  const std::uint64_t thinned = ports_.clock.now_ns();
  report.thin_ns = thinned - begin;
  if (status.ok()) status = draw_list(view, request, report);
  report.draw_ns = ports_.clock.now_ns() - thinned;
  return status;
}

Status Device::draw_list(const View& view, const FrameRequest& request, FrameReport& report) {
  const Scanout& scanout = vram_.scanout;
  const FrameTarget target{scanout.picture[back_], scanout.stride_bytes,     scanout.format,
                           vram_.depth,            vram_.depth_stride_bytes, vram_.depth_format};
  SolidSettings settings = request.solids;
  if (!request.thinning.enabled) settings.thresholds = {0, 0, 0};
  const SolidsToDraw solids{solids_, settings, report.solids};
  const auto list = write_scene(thinning_, view, request.lighting, target, ports_.bus, command_words_, &solids);
  if (!list.ok()) return list.status();
  ports_.clock.charge(CpuWork::kCommandWritten, list->size());
  Status status = engine_.start(ports_.bus.bus_address(list->data()), static_cast<std::uint32_t>(list->size()));
  if (status.ok()) status = engine_.wait_done(config_.engine_timeout_us);
  report.engine_cycles = engine_.cycles();
  report.faces_drawn = engine_.faces_drawn();
  return status;
}

Status Device::show_picture(FrameReport& report) {
  const std::uint64_t begin = ports_.clock.now_ns();
  const Status status = ports_.display.show(back_);
  report.wait_ns = ports_.clock.now_ns() - begin;
  if (!status.ok()) return status;
  back_ ^= 1;
  painted_ = false;
  return status;
}

Status Device::complete_picture() {
  return painted_ ? ports_.display.show_part(shown_picture(), painted_part_) : ports_.display.show(shown_picture());
}

std::span<std::byte> Device::back_pixels() {
  if (!display_ready_) return {};
  return ports_.memory.write_window(vram_.scanout.picture[back_],
                                    std::size_t{vram_.scanout.stride_bytes} * vram_.scanout.height);
}

Status Device::show_painted(const PictureRectangle& part) {
  const Status status = ports_.display.show_part(back_, part);
  if (!status.ok()) return status;
  back_ ^= 1;
  painted_ = true;
  painted_part_ = part;
  return status;
}

Status Device::show_safe_picture() {
  const std::span<std::byte> pixels = back_pixels();
  if (pixels.empty()) return {StatusCode::kFailedPrecondition, "no display to show the safe picture on", 0};
  paint_safe_picture(vram_.scanout, pixels);
  return show_painted(safe_picture_part(vram_.scanout.width, vram_.scanout.height));
}

Status Device::blank() {
  const std::span<std::byte> pixels = back_pixels();
  if (pixels.empty()) return {StatusCode::kFailedPrecondition, "no display to blank", 0};
  std::memset(pixels.data(), 0, pixels.size());  // black in every format
  return show_painted({});
}

std::uint64_t Device::ram_peak_bytes() const {
  const std::uint64_t copy_memory = thinning_.copy().capacity_bytes();
  return ram_.used() - copy_memory + thinning_.copy().peak_bytes();
}

}  // namespace usuzumi::firmware
