// Makes today's pictures of the software engine the goldens, and says what that changes. Run by approve.sh.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "sim/image/compare.h"
#include "sim/image/png.h"
#include "tests/golden/golden_store.h"
#include "tests/support/scene.h"
#include "tests/support/scene_engines.h"

namespace usuzumi::golden {
namespace {

void tell_change(const Store& store, const scenes::Scene& scene, const sim::Image& picture, std::uint32_t crc) {
  const Entry* old = store.find(scene.name);
  if (old == nullptr) {
    std::printf("new      %-24s %08x\n", scene.name, crc);
    return;
  }
  std::printf("changed  %-24s %08x -> %08x\n", scene.name, old->crc32, crc);
  if (std::filesystem::exists(store.picture_path(scene.name)))
    std::printf("%s", sim::report_text(sim::compare_images(sim::read_png(store.picture_path(scene.name)), picture)).c_str());
}

bool up_to_date(const Store& store, const scenes::Scene& scene, const sim::Image& picture) {
  const Entry* entry = store.find(scene.name);
  return entry != nullptr && entry->note == scene.note && entry->crc32 == sim::picture_crc32(picture) &&
         std::filesystem::exists(store.picture_path(scene.name)) && sim::read_png(store.picture_path(scene.name)) == picture;
}

void approve_scene(Store& store, const scenes::Scene& scene, gfx::Engine& engine) {
  const scenes::SceneDrawing drawing = scenes::draw_scene(scene, engine);
  if (!drawing.status.ok()) throw std::runtime_error(std::string(scene.name) + ": not approved: " + drawing.status.message);
  if (drawing.strayed) throw std::runtime_error(std::string(scene.name) + ": not approved: the engine wrote outside its target");
  if (up_to_date(store, scene, drawing.picture)) return;
  const std::uint32_t crc = sim::picture_crc32(drawing.picture);
  tell_change(store, scene, drawing.picture, crc);
  store.put({scene.name, drawing.picture.width, drawing.picture.height, crc, scene.note}, drawing.picture);
}

// Goldens of scenes that are no more.
void remove_stale(Store& store) {
  std::set<std::string> stale;
  for (const Entry& entry : store.entries()) stale.insert(entry.scene);
  for (const std::string& picture : store.pictures_on_disk()) stale.insert(picture);
  for (const scenes::Scene& scene : scenes::all_scenes()) stale.erase(scene.name);
  for (const std::string& name : stale) {
    std::printf("removed  %s\n", name.c_str());
    store.remove(name);
  }
}

void approve(std::span<char*> names) {
  for (const std::string_view name : names) {
    const auto all = scenes::all_scenes();
    if (std::none_of(all.begin(), all.end(), [&](const scenes::Scene& s) { return s.name == name; }))
      throw std::runtime_error(std::string(name) + ": is no scene; scenes are named as their PNGs in tests/golden, without .png");
  }
  Store store(Store::source_folder());
  scenes::SoftEngineKit kit;
  for (const scenes::Scene& scene : scenes::all_scenes())
    if (names.empty() || std::find(names.begin(), names.end(), std::string_view(scene.name)) != names.end()) approve_scene(store, scene, kit.engine());
  if (names.empty()) remove_stale(store);
  std::printf("%zu goldens in %s; what is not listed above is as it was\n", store.entries().size(), Store::source_folder().c_str());
}

}  // namespace
}  // namespace usuzumi::golden

int main(int argc, char** argv) {
  try {
    usuzumi::golden::approve(std::span<char*>(argv, static_cast<std::size_t>(argc)).subspan(1));
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
