// Scan-out on the host: frames a second of 1920 x 720 with two layers, the upper one blended by its own alpha.
//
// One iteration is one frame: 720 picture lines composed, signed where the benchmark says so, and sent. The least that
// is of use is 60 frames a second on one core.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "gfx_subsystem/display/display_controller.h"
#include "hal/crc32.h"
#include "hal/drivers/display_driver.h"
#include "sim/panel/panel.h"

namespace usuzumi {
namespace {

constexpr DisplayMode kMode = kMode1920x720;
constexpr std::size_t kPixels = std::size_t{1920} * 720;
constexpr BusAddress kVramBase = 0x80000000, kRegisters = 0xF0001000;

class Vram final : public BusMemory {
 public:
  std::vector<std::uint32_t> words = std::vector<std::uint32_t>(2 * kPixels);

 private:
  std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const override {
    const auto all = std::as_bytes(std::span(words));
    if (address < kVramBase || address - kVramBase > all.size() || size > all.size() - (address - kVramBase)) return {};
    return all.subspan(address - kVramBase, size);
  }
  std::span<std::byte> do_write_window(BusAddress, std::size_t) override { return {}; }
};

/// Looks at one pixel a line, so that nothing is optimised away.
class Glance final : public gfx::VideoSink {
 public:
  std::uint32_t seen = 0;

 private:
  void do_segment(const gfx::VideoSegment& segment) override {
    if (segment.data_enable) seen ^= segment.xrgb[segment.pixel_count / 2];
  }
};

class Device final : public RegisterIo {
 public:
  Device(Vram& vram, gfx::VideoSink& sink) : controller(vram, sink, {}) {}
  gfx::DisplayController controller;

 private:
  std::uint32_t do_read32(BusAddress address) override { return controller.read(address - kRegisters); }
  void do_write32(BusAddress address, std::uint32_t value) override { controller.write(address - kRegisters, value); }
};

enum class Overlay {
  kNoise,      // every alpha different from its neighbour's: the worst case
  kDashboard,  // transparent but for a tenth, edges soft: what overlays look like
};

std::uint32_t overlay_pixel(Overlay overlay, std::size_t i, std::uint32_t noise) {
  if (overlay == Overlay::kNoise) return noise;
  const std::size_t x = i % 1920;
  const std::uint32_t alpha = x % 200 < 20 ? (x % 200 < 2 ? 0x80u : 0xFFu) : 0u;
  return (noise & 0xFFFFFF) | alpha << 24;
}

void fill(Vram& vram, Overlay overlay) {
  std::uint32_t state = 1;
  for (std::size_t i = 0; i < kPixels; ++i) {
    state = state * 1664525 + 1013904223;
    vram.words[i] = state ^ state >> 13;
    vram.words[kPixels + i] = overlay_pixel(overlay, i, state * 2654435761u ^ state >> 7);
  }
}

void show_two_layers(DisplayDriver& driver, bool sign) {
  const auto layer = [](LayerFormat format, BusAddress address) {
    return LayerConfig{.format = format,
                       .stride_bytes = 1920 * 4,
                       .bank_address = {address, address},
                       .width = 1920,
                       .height = 720,
                       .per_pixel_alpha = format == LayerFormat::kArgb8888};
  };
  const BusAddress upper = kVramBase + static_cast<BusAddress>(kPixels * 4);
  const bool ok = driver.set_mode(kMode).ok() &&
                  driver.configure_layer(0, layer(LayerFormat::kXrgb8888, kVramBase)).ok() &&
                  driver.configure_layer(1, layer(LayerFormat::kArgb8888, upper)).ok() &&
                  driver.show_layer(0, true).ok() && driver.show_layer(1, true).ok();
  driver.enable_picture_signature(sign);
  if (!ok || !driver.enable().ok()) std::abort();
}

void scan_frames(benchmark::State& state, gfx::VideoSink& sink, Overlay overlay, bool sign) {
  Vram vram;
  fill(vram, overlay);
  Device device(vram, sink);
  DisplayDriver driver(device, kRegisters);
  show_two_layers(driver, sign);
  for (auto _ : state) device.controller.advance_to(device.controller.next_vertical_blank());
  if (driver.faults().any()) state.SkipWithError("the display raised a fault");
  state.counters["frames/s"] = benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void ScanOut1920x720(benchmark::State& state, Overlay overlay, bool sign) {
  Glance glance;
  scan_frames(state, glance, overlay, sign);
  benchmark::DoNotOptimize(glance.seen);
}

void ScanOutToPanel1920x720(benchmark::State& state, Overlay overlay, bool sign) {
  sim::Panel panel;
  scan_frames(state, panel, overlay, sign);
  benchmark::DoNotOptimize(panel.last_frame().picture.xrgb.data());
}

void Crc32OfALine(benchmark::State& state) {
  const std::vector<std::byte> line(1920 * 3, std::byte{0x5A});
  std::uint32_t crc = kCrc32Start;
  for (auto _ : state) benchmark::DoNotOptimize(crc = crc32(crc, line));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(line.size()));
}

BENCHMARK_CAPTURE(ScanOut1920x720, noise_signed, Overlay::kNoise, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ScanOut1920x720, noise_unsigned, Overlay::kNoise, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ScanOut1920x720, dashboard_signed, Overlay::kDashboard, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ScanOutToPanel1920x720, noise_signed, Overlay::kNoise, true)->Unit(benchmark::kMillisecond);
BENCHMARK(Crc32OfALine);

}  // namespace
}  // namespace usuzumi

BENCHMARK_MAIN();
