// A cluster of two meshes, drawn whole and thinned; prints what is in each picture and the picture's CRC-32.
#include <array>
#include <bit>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

#include "firmware/device/scene_commands.h"
#include "firmware/drawing_data/drawing_data.h"
#include "firmware/thinning/thinning.h"
#include "gfx_subsystem/engine_soft/soft_engine.h"
#include "hal/clock.h"
#include "hal/crc32.h"
#include "hal/memory_regions.h"

namespace {

using namespace usuzumi;

constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr std::uint32_t kPictureBytes = kWidth * kHeight * 4;

// All the memory there is. The depth buffer follows the picture in VRAM.
alignas(64) std::array<std::byte, 64 * 1024> ram;
alignas(64) std::array<std::byte, 2 * kPictureBytes> vram;
alignas(64) std::array<std::byte, 256 * 1024> engine_memory;

/// Bare drawing data: mesh-max, then vertex count, thinning level and X Y Z of a strip for each mesh. The first mesh
/// stays, the second may be left out.
constexpr std::uint32_t f(float value) { return std::bit_cast<std::uint32_t>(value); }
constexpr std::uint32_t kKeep = 1, kDelete = 2;
alignas(4) constexpr std::uint32_t rom[] = {
    2,
    4, kKeep,                          // the dial: pixels 40..119 of rows 30..89
    f(-0.5f), f(-0.5f), f(0),  f(0.5f), f(-0.5f), f(0),  f(-0.5f), f(0.5f), f(0),  f(0.5f), f(0.5f), f(0),
    4, kDelete,                        // an ornament: pixels 140..149 of rows 45..74
    f(0.75f), f(-0.25f), f(0),  f(0.875f), f(-0.25f), f(0),  f(0.75f), f(0.25f), f(0),  f(0.875f), f(0.25f), f(0),
};

class Memory final : public MemoryRegions<2> {
 public:
  static constexpr BusAddress kRam = 0x2000'0000, kVram = 0x6000'0000;
  Memory() : MemoryRegions({{{kRam, ram}, {kVram, vram}}}) {}
};

/// Nothing here waits; a board counts a timer.
class StoppedClock final : public Clock {
  std::uint64_t do_now_ns() override { return 0; }
  void do_charge(CpuWork, std::uint64_t) override {}
};

Status draw_picture(firmware::Thinning& thinning, bool thinned, gfx::Engine& engine, Memory& memory,
                    std::span<std::uint32_t> words) {
  const firmware::View view{Mat4{}, kWidth, kHeight};  // the meshes lie in clip space as they are
  firmware::ThinningSettings settings;
  settings.enabled = thinned;
  firmware::ThinningReport report;
  StoppedClock clock;
  if (Status status = thinning.update(settings, view, clock, report); !status.ok()) return status;

  firmware::Lighting lighting;
  lighting.background = rgba8(16, 32, 96);
  const firmware::FrameTarget target{.picture = Memory::kVram,
                                     .picture_stride_bytes = kWidth * 4,
                                     .depth = Memory::kVram + kPictureBytes,
                                     .depth_stride_bytes = kWidth * 4};
  const auto list = firmware::write_scene(thinning, view, lighting, target, memory, words);
  if (!list.ok()) return list.status();
  if (Status status = engine.execute(*list, memory).status; !status.ok()) return status;
  std::printf("%s: %" PRIu32 " of %" PRIu32 " meshes, CRC-32 %08" PRIx32 "\n", thinned ? "thinned" : "whole",
              report.meshes_out, report.meshes_in, crc32(kCrc32Start, std::span(vram).first(kPictureBytes)));
  return ok_status();
}

Status run() {
  const auto data = firmware::DrawingData::open(std::as_bytes(std::span(rom)));
  if (!data.ok()) return data.status();
  Arena arena(ram);
  const auto words = arena.allocate<std::uint32_t>(firmware::scene_command_words(*data));
  firmware::Thinning thinning;
  if (Status status = thinning.begin(*data, arena); !status.ok()) return status;
  Memory memory;
  gfx::SoftEngine engine({.work_memory = engine_memory});
  for (const bool thinned : {false, true})
    if (Status status = draw_picture(thinning, thinned, engine, memory, words); !status.ok()) return status;
  return ok_status();
}

}  // namespace

int main() {
  const Status status = run();
  if (status.ok()) return 0;
  std::fprintf(stderr, "%s: %s (%" PRIu32 ")\n", status_code_name(status.code), status.message, status.where);
  return 1;
}
