#include "sim/desk/desk.h"

#include <fmt/format.h>

#include <cstring>
#include <memory>
#include <string>

#include "gfx_subsystem/engine_osmesa/osmesa_engine.h"
#include "gfx_subsystem/engine_soft/soft_engine.h"
#include "hal/drivers/controller_display.h"
#include "hal/drivers/display_mode.h"
#include "sim/common/error.h"
#include "sim/desk/scripted_pins.h"
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

/// Drawing data of another board are named with theirs.
void refuse_foreign(const std::string& rom_name, std::span<const std::byte> rom, std::string_view board) {
  const auto data = firmware::DrawingData::open(rom);
  if (!data.ok() || data->board().empty() || data->board() == board) return;
  const std::string remedy = find_board(data->board()) != nullptr
                                 ? fmt::format("run them with --board {}, or pack them without --board", data->board())
                                 : "which is none of the simulator's; pack them without --board to see them here";
  throw Error(ExitCode::kBadInput,
              fmt::format("{}: drawing data for board {} alone; {}", rom_name, data->board(), remedy));
}

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
        display(machine, kDisplayBase, machine),
        pins(machine, desk_config.pins ? &*desk_config.pins : nullptr),
        instrument({.registers = machine,
                    .engine_base = kEngineBase,
                    .interrupts = machine,
                    .display = display,
                    .clock = machine,
                    .memory = machine,
                    .bus = machine,
                    .rom = machine.rom(),
                    .ram = machine.ram(),
                    .vram_base = kVramBase,
                    .vram_bytes = static_cast<std::uint32_t>(machine.vram().size())},
                   pins) {}

  double starving_slowdown() const;
  void inject_faults(std::uint32_t frame);
  void await_panel(std::uint32_t frame);

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
  ControllerDisplay display;
  ScriptedPins pins;
  firmware::Instrument instrument;
  DisplayMode mode;
  std::uint32_t frames = 0;
  std::size_t next_fault = 0;
  Image dark;  // what a panel shows that has never been sent a picture
};

Desk::Desk(const DeskConfig& config, std::span<const std::byte> rom, const std::string& rom_name) {
  DeskConfig complete = config;
  if (complete.width == 0 || complete.height == 0) {
    complete.width = complete.board.width;
    complete.height = complete.board.height;
  }
  parts_ = std::make_unique<Parts>(complete, rom, rom_name);
  firmware::InstrumentConfig instrument;
  instrument.device.board = complete.board.name;
  instrument.device.width = complete.width;
  instrument.device.height = complete.height;
  instrument.device.pixel_format = complete.board.pixel_format;
  instrument.device.depth_format = complete.board.depth_format;
  instrument.device.boot_layers_millionths = parts_->config.boot_layers_millionths;
  parts_->pins.begin_frame(0);
  const Status status = parts_->instrument.boot(instrument);
  if (status.code == StatusCode::kUnsupported) refuse_foreign(rom_name, rom, complete.board.name);
  if (!status.ok()) fail(rom_name, status);
  parts_->mode = *make_display_mode(complete.width, complete.height);
  parts_->dark = Image(complete.width, complete.height);
}

Desk::~Desk() = default;

std::uint32_t Desk::width() const { return parts_->config.width; }
std::uint32_t Desk::height() const { return parts_->config.height; }

std::vector<std::uint32_t> Desk::layered_meshes() const {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t n = 0; n < drawing_data().mesh_max(); ++n)
    if (device().thinning().layers(n) != nullptr) numbers.push_back(n);
  return numbers;
}

const firmware::DrawingData& Desk::drawing_data() const { return device().drawing_data(); }
const Machine& Desk::machine() const { return parts_->machine; }
const firmware::Device& Desk::device() const { return parts_->instrument.device(); }

/// How much slower the display's bus must be to give half of what the lines of a whole picture take: too little for
/// the picture, enough for the safe one, which is at most two fifths as wide.
double Desk::Parts::starving_slowdown() const {
  const Scanout& scanout = instrument.device().vram().scanout;
  const double line_s = static_cast<double>(mode.line_pixels()) / mode.pixel_clock_hz();
  const double needed = scanout.width * command::bytes_per_pixel(scanout.format) / line_s;
  return static_cast<double>(config.board.bus_bytes_per_second) / (needed / 2);
}

/// Faults are in order of frames.
void Desk::Parts::inject_faults(std::uint32_t frame) {
  Faults& faults = config.faults;
  const std::size_t before = next_fault;
  for (; next_fault < config.fault_script.size() && config.fault_script[next_fault].frame <= frame; ++next_fault) {
    const FrameEvent& event = config.fault_script[next_fault];
    if (event.name == "engine-hang") faults.engine_hangs = event.level;
    else faults.bus_slowdown = event.level ? starving_slowdown() : 1;
  }
  if (next_fault != before) machine.inject(faults);
}

/// Until the panel has been sent a picture whole that began after now.
void Desk::Parts::await_panel(std::uint32_t frame) {
  if (!machine.display().running()) return;
  const std::uint32_t shown_in_frame = display.driver().frame_count() + 1;
  const std::uint64_t flipped = machine.now_cycles();
  const std::uint64_t step = mode.frame_ticks() / kLooksPerFrame + 1;
  while (panel.frames_completed() < shown_in_frame) {
    if (machine.now_cycles() - flipped > kFramesToWait * mode.frame_ticks())
      throw Error(ExitCode::kDevice, fmt::format("frame {}: the panel got no stable picture", frame));
    machine.idle(step);
  }
}

Desk::Shown Desk::draw(const firmware::FrameRequest& request) {
  Parts& p = *parts_;
  const HostStopwatch stopwatch;
  FrameRecord record;
  record.frame = p.frames++;
  p.pins.begin_frame(record.frame);
  p.inject_faults(record.frame);
  const firmware::StepReport step = p.instrument.step(request);
  if (!step.fault.ok()) {
    if (!p.config.watches_faults()) fail(p.rom_name, step.fault);
    record.fault = fmt::format("{} {}", step.fault.message, step.fault.where);
  }
  p.await_panel(record.frame);
  record.firmware = step.frame;
  record.shown = step.shown;
  record.mode = step.mode;
  record.backlight = p.pins.backlight();
  record.wake_ms = ms_from_ns(step.wake_ns);
  const bool sent = p.panel.frames_completed() > 0;
  const Image& picture = sent ? p.panel.last_frame().picture : p.dark;
  record.panel_crc32 = picture_crc32(picture);
  record.crc32 = sent ? p.display.driver().signature().picture_crc : record.panel_crc32;
  record.thin_ms = ms_from_ns(record.firmware.thin_ns);
  record.draw_ms = ms_from_ns(record.firmware.draw_ns);
  record.scanout_ms = static_cast<double>(p.mode.frame_ticks()) * 1e3 / static_cast<double>(kMasterHz);
  const bool drawn = record.firmware.thinning.meshes_in > 0;
  for (const std::uint32_t n : layered_meshes())
    record.layers.push_back(drawn ? device().thinning().drawn_layer(n) : -1);
  record.host_ms = stopwatch.elapsed_ms();
  return {record, picture};
}

Image Desk::picture_in_vram() const {
  const Parts& p = *parts_;
  const Scanout& scanout = vram().scanout;
  const std::byte* base = p.machine.vram().data() + (scanout.picture[device().shown_picture()] - kVramBase);
  Image image(width(), height());
  for (std::uint32_t y = 0; y < image.height; ++y) {
    const std::byte* row = base + std::size_t{y} * scanout.stride_bytes;
    for (std::uint32_t x = 0; x < image.width; ++x) {
      if (scanout.format == command::PixelFormat::kXrgb8888) {
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
  return {device().ram_peak_bytes(), vram().used_bytes, parts_->machine.rom().size()};
}

}  // namespace usuzumi::sim
