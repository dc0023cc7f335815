// Makes today's pictures of the software engine the goldens, and says what that changes. Run by approve.sh.
#include <cstdio>
#include <exception>
#include <string_view>

#include "gfx_subsystem/engine_soft/soft_engine.h"
#include "tests/golden/golden_check.h"
#include "tests/golden/golden_store.h"
#include "tests/golden/golden_png.h"

namespace usuzumi::golden {
namespace {

bool chosen(std::string_view scene, int argc, char** argv) {
  if (argc == 1) return true;
  for (int i = 1; i < argc; ++i)
    if (scene == argv[i]) return true;
  return false;
}

void tell_change(const Store& store, const scenes::Scene& scene, const RgbPicture& picture, std::uint32_t crc) {
  const Entry* old = store.find(scene.name);
  if (old == nullptr) {
    std::printf("new      %-24s %08x\n", scene.name, crc);
    return;
  }
  std::printf("changed  %-24s %08x -> %08x", scene.name, old->crc32, crc);
  if (std::filesystem::exists(store.picture_path(scene.name))) {
    const RgbPicture before = read_png(store.picture_path(scene.name));
    if (before.width == picture.width && before.height == picture.height) {
      const Difference d = compare_pictures(before, picture);
      if (d.pixels > 0) std::printf(", %zu pixels, by up to %d, first at (%u, %u)", d.pixels, d.worst, d.first_x, d.first_y);
    } else {
      std::printf(", another size");
    }
  }
  std::printf("\n");
}

bool up_to_date(const Store& store, const scenes::Scene& scene, const RgbPicture& picture) {
  const Entry* entry = store.find(scene.name);
  return entry != nullptr && entry->note == scene.note && entry->crc32 == scenes::picture_crc32(picture) &&
         std::filesystem::exists(store.picture_path(scene.name)) && read_png(store.picture_path(scene.name)) == picture;
}

int approve(int argc, char** argv) {
  Store store(Store::source_folder());
  SoftEngineUnderTest engine;
  int same = 0, asked = 0;
  for (const scenes::Scene& scene : scenes::all_scenes()) {
    if (!chosen(scene.name, argc, argv)) continue;
    ++asked;
    const scenes::SceneDrawing drawing = scenes::draw_scene(scene, engine.engine());
    if (!drawing.status.ok() || drawing.strayed) {
      std::fprintf(stderr, "%s: not approved: %s\n", scene.name, drawing.status.ok() ? "engine wrote outside its target" : drawing.status.message);
      return 1;
    }
    if (up_to_date(store, scene, drawing.picture)) {
      ++same;
      continue;
    }
    const std::uint32_t crc = scenes::picture_crc32(drawing.picture);
    tell_change(store, scene, drawing.picture, crc);
    store.put({scene.name, drawing.picture.width, drawing.picture.height, crc, scene.note}, drawing.picture);
  }
  if (argc > 1 && asked != argc - 1) {
    std::fprintf(stderr, "a name given is no scene; scenes are named as their PNGs in tests/golden, without .png\n");
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace usuzumi::golden
