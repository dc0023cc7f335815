#include "boards/common/engine_registers.h"
#include "boards/common/picture_crc.h"
#include "firmware/device/device.h"
#include "firmware/scene/camera.h"
#include "hal/crc32.h"
#include "hal/memory_regions.h"
#include "tests/golden/player/cases.h"

namespace usuzumi::golden {
namespace {

/// Where the device finds its memories; on a 32-bit board, too, these need not be the CPU's addresses.
constexpr BusAddress kRomBase = 0x10000000, kRamBase = 0x50000000, kVramBase = 0x80000000;

class RunBus final : public MemoryRegions<3> {
 public:
  RunBus(std::span<const std::byte> rom, std::span<std::byte> ram, std::span<std::byte> vram)
      : MemoryRegions({MemoryRegion{kRomBase, {const_cast<std::byte*>(rom.data()), rom.size()}, false},
                       MemoryRegion{kRamBase, ram, true}, MemoryRegion{kVramBase, vram, true}}) {}
};

/// Shows nothing and takes no time: the player looks at VRAM itself.
class NoDisplay final : public Display {
 private:
  Status do_start(const Scanout&) override { return ok_status(); }
  Status do_show(std::uint32_t, const PictureRectangle*) override { return ok_status(); }
};

class NoClock final : public Clock {
 private:
  std::uint64_t do_now_ns() override { return 0; }
  void do_charge(CpuWork, std::uint64_t) override {}
};

/// From a multiple of a cache line on: where an arena begins decides what its alignments waste, and so what fits.
std::span<std::byte> aligned(std::span<std::byte> memory) {
  constexpr std::uintptr_t kLine = 64;
  const std::size_t skip = static_cast<std::size_t>(-reinterpret_cast<std::uintptr_t>(memory.data()) % kLine);
  return skip <= memory.size() ? memory.subspan(skip) : std::span<std::byte>{};
}

firmware::FrameRequest request_for(const RunCase& run, const firmware::Bounds& bounds, std::uint32_t frame,
                                   double azimuth_rad) {
  firmware::FrameRequest request;
  const float aspect = static_cast<float>(run.width) / static_cast<float>(run.height);
  const firmware::Camera camera = firmware::view_of(bounds, azimuth_rad, run.elevation_rad, aspect);
  request.model_to_clip = firmware::model_to_clip(camera, aspect);
  request.lighting.background = run.background;
  request.thinning = run.thinning;
  if (!run.quotas_millionths.empty())
    request.thinning.quota = {firmware::format::QuotaKind::kMillionths, run.quotas_millionths[frame]};
  if (!run.thresholds.empty()) request.solids.thresholds = run.thresholds[frame];
  return request;
}

Status boot(firmware::Device& device, const RunCase& run) {
  firmware::DeviceConfig config;
  config.width = run.width;
  config.height = run.height;
  config.pixel_format = run.pixel_format;
  config.depth_format = run.depth_format;
  config.boot_layers_millionths = run.boot_layers_millionths;
  const Status status = device.boot(config);
  const firmware::VramLayout& vram = device.vram();
  // The device makes do with smaller formats; other pixels are no golden.
  if (status.ok() && (vram.scanout.format != run.pixel_format || vram.depth_format != run.depth_format))
    return {StatusCode::kResourceExhausted, "VRAM is too small for the run's formats; bytes used by smaller ones",
            vram.used_bytes};
  return status;
}

void print_meshes(const firmware::RamCopy& copy, std::string_view name, ResultSink& out) {
  for (std::uint32_t m = 0; m < copy.mesh_max(); ++m) {
    if (!copy.present(m)) continue;
    const firmware::CopyMesh& mesh = copy.mesh(m);
    boards::TextLine line;
    line.text(name).text("/mesh-").text(m < 10 ? "0" : "").number(m);
    out.line(add_result(line, mesh.vertex_count, mesh.index_count,
                        crc32(kCrc32Start, {copy.block(m), copy.block_bytes(m)})));
  }
}

}  // namespace

Status play_run(const Bundle& bundle, std::uint32_t n, std::string_view name, const PlayerMemory& memory,
                ResultSink& out) {
  const auto run = bundle.run(n);
  if (!run.ok()) return run.status();
  std::span<std::byte> ram = aligned(memory.ram);
  if (run->ram_bytes > ram.size())
    return {StatusCode::kResourceExhausted, "RAM is too small for the run; bytes needed", run->ram_bytes};
  ram = ram.first(run->ram_bytes);
  RunBus bus(run->rom, ram, memory.vram);
  boards::EngineRegisters registers(bus, memory.engine_work);
  NoDisplay display;
  NoClock clock;
  firmware::Device device({.registers = registers,
                           .engine_base = boards::EngineRegisters::kBase,
                           .interrupts = registers,
                           .display = display,
                           .clock = clock,
                           .memory = bus,
                           .bus = bus,
                           .rom = run->rom,
                           .ram = ram,
                           .vram_base = kVramBase,
                           .vram_bytes = static_cast<std::uint32_t>(memory.vram.size())});
  if (Status status = boot(device, *run); !status.ok()) return status;
  const firmware::Bounds bounds = firmware::bounds_of(device.drawing_data());
  for (std::uint32_t frame = 0; frame < run->frame_count; ++frame) {
    firmware::FrameReport report;
    const double azimuth_rad = bundle.azimuth_rad(n, frame);
    const firmware::FrameRequest request = request_for(*run, bounds, frame, azimuth_rad);
    if (Status status = device.draw_frame(request, report); !status.ok()) return status;
    const Scanout& scanout = device.vram().scanout;
    const auto pixels = memory.vram.subspan(scanout.picture[device.shown_picture()] - kVramBase);
    boards::TextLine line;
    line.text(name);
    if (frame + 1 < run->frame_count) line.text("/frame-").number(frame);
    out.line(add_result(line, run->width, run->height, boards::picture_crc32(scanout, pixels)));
  }
  print_meshes(device.thinning().copy(), name, out);
  return ok_status();
}

}  // namespace usuzumi::golden
