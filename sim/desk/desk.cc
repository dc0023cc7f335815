#include "sim/desk/desk.h"

#include <fmt/format.h>

#include <cstring>
#include <memory>
#include <string>

#include "gfx_subsystem/engine_osmesa/osmesa_engine.h"
#include "gfx_subsystem/engine_soft/soft_engine.h"
#include "hal/drivers/display_mode.h"
#include "sim/common/error.h"
#include "sim/machine/host_stopwatch.h"
#include "sim/panel/panel.h"
#include "sim/parallel/thread_runner.h"

namespace usuzumi::sim {
namespace {

/// The engine's own memory for vertices and bins; reserved, used as touched.
constexpr std::size_t kEngineWorkBytes = std::size_t{256} << 20;
/// The panel has the picture within two frames of the flip; more means that its signal broke down.
constexpr std::uint64_t kFramesToWait = 4;
/// Steps of virtual time in which the desk looks at the panel, per frame.
constexpr std::uint64_t kLooksPerFrame = 64;

[[noreturn]] void fail(const std::string& rom_name, const Status& status) {
  const bool input = status.code == StatusCode::kDataLoss || status.code == StatusCode::kUnsupported;
  const char* const remedy = input ? "; pack it again"
                             : status.code == StatusCode::kResourceExhausted
                                 ? "; choose a larger --board (for VRAM also a smaller --size, for RAM also more "
                                   "thinning)"
                                 : "";
  throw Error(input ? ExitCode::kBadInput : ExitCode::kDevice,
              fmt::format("{}: {} {}{}", rom_name, status.message, status.where, remedy));
}

double ms_from_ns(std::uint64_t ns) { return static_cast<double>(ns) / 1e6; }

}  // namespace

struct Desk::Parts {
  Parts(const DeskConfig& desk_config, std::span<const std::byte> rom_bytes, const std::string& name)
      : config(desk_config),
        rom_name(name),
        work(kEngineWorkBytes),
        runner(desk_config.threads),
        soft({.work_memory = work.bytes(), .runner = desk_config.threads > 1 ? &runner : nullptr}),
        osmesa(desk_config.engine == EngineKind::kOsmesa ? std::make_unique<gfx::OsmesaEngine>() : nullptr),
        machine(desk_config.board, rom_bytes, engine(), panel, desk_config.faults),
        device({machine, kEngineBase, kDisplayBase, machine, machine, machine, machine.rom(), machine.ram(), kVramBase,
                static_cast<std::uint32_t>(machine.vram().size())}) {}

  gfx::Engine& engine() {
    if (osmesa == nullptr) return soft;
    if (!osmesa->status().ok()) throw Error(ExitCode::kDevice, fmt::format("OSMesa: {}", osmesa->status().message));
    return *osmesa;
  }

  DeskConfig config;
  std::string rom_name;
  HostPages work;
  ThreadRunner runner;
  gfx::SoftEngine soft;
  std::unique_ptr<gfx::OsmesaEngine> osmesa;
  Panel panel;
  Machine machine;
  firmware::Device device;
  DisplayMode mode;
  std::uint32_t frames = 0;
};

Desk::Desk(const DeskConfig& config, std::span<const std::byte> rom, const std::string& rom_name) {
  DeskConfig complete = config;
  if (complete.width == 0 || complete.height == 0) {
    complete.width = complete.board.width;
    complete.height = complete.board.height;
  }
  parts_ = std::make_unique<Parts>(complete, rom, rom_name);
  firmware::DeviceConfig device;
  device.width = complete.width;
  device.height = complete.height;
  device.pixel_format = complete.board.pixel_format;
  device.depth_format = complete.board.depth_format;
  const Status status = parts_->device.boot(device);
  if (!status.ok()) fail(rom_name, status);
  parts_->mode = *make_display_mode(complete.width, complete.height);
}

Desk::~Desk() = default;

std::uint32_t Desk::width() const { return parts_->config.width; }
std::uint32_t Desk::height() const { return parts_->config.height; }
const firmware::DrawingData& Desk::drawing_data() const { return parts_->device.drawing_data(); }
const Machine& Desk::machine() const { return parts_->machine; }
const firmware::Device& Desk::device() const { return parts_->device; }

Desk::Shown Desk::draw(const firmware::FrameRequest& request) {
  Parts& p = *parts_;
  const HostStopwatch stopwatch;
  FrameRecord record;
  record.frame = p.frames++;
  const Status status = p.device.draw_frame(request, record.firmware);
  if (!status.ok()) fail(p.rom_name, status);

  const std::uint64_t flipped = p.machine.now_cycles();
  const std::uint64_t step = p.mode.frame_ticks() / kLooksPerFrame + 1;
  while (p.panel.frames_completed() < record.firmware.shown_in_frame) {
    if (p.machine.now_cycles() - flipped > kFramesToWait * p.mode.frame_ticks())
      throw Error(ExitCode::kDevice, fmt::format("frame {}: the panel got no stable picture", record.frame));
    p.machine.idle(step);
  }
  record.crc32 = p.device.display().signature().picture_crc;
  record.panel_crc32 = p.panel.last_frame().crc32();
  record.thin_ms = ms_from_ns(record.firmware.thin_ns);
  record.draw_ms = ms_from_ns(record.firmware.draw_ns);
  record.scanout_ms = static_cast<double>(p.mode.frame_ticks()) * 1e3 / static_cast<double>(kMasterHz);
  record.host_ms = stopwatch.elapsed_ms();
  return {record, p.panel.last_frame().picture};
}

Image Desk::picture_in_vram() const {
  const Parts& p = *parts_;
  const firmware::VramLayout& layout = p.device.vram();
  const std::uint32_t shown = p.frames % 2 == 1 ? 0 : 1;  // the first frame is drawn into picture 0
  const std::byte* base = p.machine.vram().data() + (layout.picture[shown] - kVramBase);
  Image image(width(), height());
  for (std::uint32_t y = 0; y < image.height; ++y) {
    const std::byte* row = base + std::size_t{y} * layout.picture_stride_bytes;
    for (std::uint32_t x = 0; x < image.width; ++x) {
      if (p.config.board.pixel_format == command::PixelFormat::kXrgb8888) {
        std::uint32_t v;
        std::memcpy(&v, row + 4 * std::size_t{x}, 4);
        image.at(x, y) = v & 0xFFFFFF;
      } else {
        std::uint16_t v;
        std::memcpy(&v, row + 2 * std::size_t{x}, 2);
        const std::uint32_t r = v >> 11, g = v >> 5 & 63u, b = v & 31u;
        image.at(x, y) = (r << 3 | r >> 2) << 16 | (g << 2 | g >> 4) << 8 | (b << 3 | b >> 2);
      }
    }
  }
  return image;
}

Desk::Memory Desk::memory() const {
  return {parts_->device.ram_peak_bytes(), parts_->device.vram().used_bytes, parts_->machine.rom().size()};
}

}  // namespace usuzumi::sim
