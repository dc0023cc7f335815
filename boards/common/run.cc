#include "boards/common/run.h"

#include <new>

#include "boards/common/engine_registers.h"
#include "boards/common/picture_crc.h"
#include "boards/common/text_line.h"
#include "firmware/device/turntable.h"
#include "firmware/drawing_data/flash_image.h"

namespace usuzumi::boards {
namespace {

class Bus final : public MemoryRegions<3> {
 public:
  explicit Bus(const BoardMemory& memory)
      : MemoryRegions(std::array<MemoryRegion, 3>{memory.ram, memory.rom, memory.vram}) {}
};

/// Everything between the board and its pictures.
struct Parts {
  Parts(Board& board, const BoardMemory& memory)
      : bus(memory),
        engine(bus, memory.engine_work),
        instrument({.registers = engine,
                    .engine_base = EngineRegisters::kBase,
                    .interrupts = engine,
                    .display = board,
                    .clock = board,
                    .memory = bus,
                    .bus = bus,
                    .rom = firmware::image_in_flash(memory.rom.bytes),
                    .ram = memory.ram.bytes,
                    .vram_base = memory.vram.base,
                    .vram_bytes = static_cast<std::uint32_t>(memory.vram.bytes.size())},
                   board) {}

  Bus bus;
  EngineRegisters engine;
  firmware::Instrument instrument;
};

/// Static, not on the stack: the engine's tables alone are larger than some boards' stacks.
Parts& make_parts(Board& board, const BoardMemory& memory) {
  alignas(Parts) static std::byte storage[sizeof(Parts)];
  return *new (storage) Parts(board, memory);
}

void append_status(TextLine& line, const Status& status) {
  line.text(status.message).text(" ").number(status.where);
}

std::uint32_t depth_bits(command::DepthFormat format) {
  return format == command::DepthFormat::kUnorm24 ? 24 : format == command::DepthFormat::kUnorm16 ? 16 : 0;
}

void print_boot(Board& board, const firmware::Device& device, const RunConfig& config) {
  const firmware::VramLayout& vram = device.vram();
  const Scanout& scanout = vram.scanout;
  const bool rgb565 = scanout.format == command::PixelFormat::kRgb565;
  TextLine line;
  line.text("boot ").number(scanout.width).text("x").number(scanout.height);
  line.text(rgb565 ? " rgb565" : " xrgb8888").text(" depth=").number(depth_bits(vram.depth_format));
  line.text(" vram=").number(vram.used_bytes);
  const firmware::DeviceConfig& wanted = config.instrument.device;
  if (scanout.format != wanted.pixel_format) line.text(" reduced to rgb565: VRAM is short");
  else if (vram.depth_format != wanted.depth_format) line.text(" depth reduced: VRAM is short");
  board.print(line.finish());
}

std::uint32_t shown_crc32(const firmware::Device& device, const BusMemory& bus) {
  const Scanout& scanout = device.vram().scanout;
  const auto pixels = bus.read_window(scanout.picture[device.shown_picture()],
                                      std::size_t{scanout.stride_bytes} * scanout.height);
  return pixels.data() != nullptr ? picture_crc32(scanout, pixels) : 0;
}

void print_step(Board& board, const Parts& parts, bool signature, std::uint32_t frame,
                const firmware::StepReport& step) {
  const firmware::FrameReport& f = step.frame;
  const firmware::ThinningReport& t = f.thinning;
  TextLine line;
  line.text("frame ").number(frame).text(" ").text(shown_name(step.shown)).text(" ").text(draw_mode_name(step.mode));
  line.text(" light=").number(step.backlight ? 1 : 0);
  if (signature) line.text(" crc32=").hex(shown_crc32(parts.instrument.device(), parts.bus));
  line.text(" meshes=").number(t.meshes_in).text("->").number(t.meshes_out);
  line.text(" faces=").number(t.faces_in).text("->").number(t.faces_out).text(" drawn=").number(f.faces_drawn);
  line.text(" ram=").number(parts.instrument.device().ram_peak_bytes());
  line.text(" thin_us=").number(f.thin_ns / 1000).text(" draw_us=").number(f.draw_ns / 1000);
  if (t.meshes_dropped > 0) line.text(" dropped=").number(t.meshes_dropped);
  if (t.quota_halvings > 0) line.text(" halvings=").number(t.quota_halvings);
  if (step.wake_ns > 0) line.text(" wake_us=").number(step.wake_ns / 1000);
  if (!step.fault.ok()) {
    line.text(" fault=\"");
    append_status(line, step.fault);
    line.text("\"");
  }
  board.print(line.finish());
}

firmware::FrameRequest request_of(const firmware::Device& device, const firmware::Bounds& bounds, std::uint32_t frame,
                                  const RunConfig& config) {
  const Scanout& scanout = device.vram().scanout;
  const float aspect = static_cast<float>(scanout.width) / static_cast<float>(scanout.height);
  const firmware::Camera camera =
      firmware::turntable_camera(bounds, frame, config.orbit ? config.frames : 0, aspect);
  firmware::FrameRequest request = firmware::lit_request(camera, aspect, config.background);
  request.thinning = config.thinning;
  return request;
}

}  // namespace

int exit_code_of(const Status& status) {
  switch (status.code) {
    case StatusCode::kOk: return kExitOk;
    case StatusCode::kDataLoss:
    case StatusCode::kUnsupported: return kExitBadInput;
    default: return kExitDevice;
  }
}

int run(Board& board, const BoardMemory& memory, const RunConfig& config) {
  Parts& parts = make_parts(board, memory);
  const Status booted = parts.instrument.boot(config.instrument);
  if (!booted.ok()) {
    TextLine line;
    line.text("error: ");
    append_status(line, booted);
    board.print(line.finish());
    board.step_done();
    const int code = exit_code_of(booted);
    // Without good drawing data the safe picture follows the ignition, for as long as the program is to run.
    while (code == kExitBadInput && config.frames == 0 && !board.stop_wanted()) parts.instrument.step({});
    return code;
  }
  const firmware::Device& device = parts.instrument.device();
  print_boot(board, device, config);
  const firmware::Bounds bounds = firmware::bounds_of(device.drawing_data());
  for (std::uint32_t frame = 0; config.frames == 0 || frame < config.frames; ++frame) {
    print_step(board, parts, config.signature, frame,
               parts.instrument.step(request_of(device, bounds, frame, config)));
    board.step_done();
    if (board.stop_wanted()) break;
  }
  return kExitOk;
}

}  // namespace usuzumi::boards
