#include <cstring>

#include "boards/common/picture_crc.h"
#include "gfx_subsystem/engine_soft/soft_engine.h"
#include "hal/memory_regions.h"
#include "tests/golden/player/cases.h"

namespace usuzumi::golden {
namespace {

/// Arbitrary, and no depth or colour of a scene.
constexpr std::byte kUntouched{0xA5};

/// Vertices and indices as they lie in the bundle, and VRAM, at the addresses that the lists have.
class SceneBus final : public MemoryRegions<2> {
 public:
  SceneBus(std::span<const std::byte> data, std::span<std::byte> vram)
      : MemoryRegions({MemoryRegion{bundle::kDataBase, {const_cast<std::byte*>(data.data()), data.size()}, false},
                       MemoryRegion{bundle::kVramBase, vram, true}}) {}
};

/// Calls visit(row's bytes) for each row of the plane's pixels.
template <class Visit>
void for_each_row(const bundle::PlaneRecord& plane, std::uint32_t height, std::span<std::byte> vram, Visit visit) {
  for (std::uint32_t y = 0; y < height && plane.row_bytes > 0; ++y)
    visit(vram.subspan(plane.offset + std::size_t{y} * plane.stride_bytes, plane.row_bytes));
}

void fill_background(const SceneCase& scene, std::span<std::byte> vram) {
  std::memset(vram.data(), static_cast<int>(kUntouched), vram.size());
  const std::uint32_t size = command::bytes_per_pixel(scene.pixel_format);
  for_each_row(scene.colour, scene.height, vram, [&](std::span<std::byte> row) {
    for (std::size_t i = 0; i < row.size(); i += size) std::memcpy(&row[i], &scene.background_pixel, size);
  });
}

/// Whether a byte outside the planes' pixels has changed. Overwrites the planes.
bool strayed(const SceneCase& scene, std::span<std::byte> vram) {
  const auto forgive = [](std::span<std::byte> row) {
    std::memset(row.data(), static_cast<int>(kUntouched), row.size());
  };
  for_each_row(scene.colour, scene.height, vram, forgive);
  for_each_row(scene.depth, scene.height, vram, forgive);
  for (const std::byte b : vram)
    if (b != kUntouched) return true;
  return false;
}

}  // namespace

Status play_scene(const Bundle& bundle, std::uint32_t n, std::string_view name, const PlayerMemory& memory,
                  ResultSink& out) {
  const auto scene = bundle.scene(n);
  if (!scene.ok()) return scene.status();
  if (scene->vram_bytes > memory.vram.size())
    return {StatusCode::kResourceExhausted, "VRAM is too small for the scene; bytes needed", scene->vram_bytes};
  const std::span<std::byte> vram = memory.vram.first(scene->vram_bytes);
  fill_background(*scene, vram);
  SceneBus bus(scene->data, vram);
  gfx::SoftEngine engine({.work_memory = memory.engine_work});
  for (std::uint32_t i = 0; i < scene->list_count; ++i) {
    const auto list = bundle.list(n, i);
    if (!list.ok()) return list.status();
    if (const gfx::ExecutionReport report = engine.execute(*list, bus); !report.status.ok()) return report.status;
  }
  const Scanout shown{scene->width, scene->height, scene->pixel_format, scene->colour.stride_bytes, {}};
  const std::uint32_t crc = boards::picture_crc32(shown, vram.subspan(scene->colour.offset));
  if (strayed(*scene, vram)) return {StatusCode::kDataLoss, "the engine wrote to VRAM outside its targets", 0};
  out.line(add_result(boards::TextLine().text(name), scene->width, scene->height, crc));
  return ok_status();
}

}  // namespace usuzumi::golden
