#include "tests/golden/subjects.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "tests/golden/runs.h"
#include "tests/support/scene.h"
#include "tests/support/scene_engines.h"

namespace usuzumi::golden {
namespace {

Drawn draw(const scenes::Scene& scene, gfx::Engine& engine) {
  scenes::SceneDrawing drawing = scenes::draw_scene(scene, engine);
  if (!drawing.status.ok()) throw std::runtime_error(std::string(scene.name) + ": " + drawing.status.message);
  if (drawing.strayed) throw std::runtime_error(std::string(scene.name) + ": the engine wrote outside its target");
  const sim::Image& picture = drawing.picture;
  return {picture, {{scene.name, picture.width, picture.height, sim::picture_crc32(picture), scene.note}}};
}

Drawn draw(const DeviceRun& run) {
  RunPicture drawn = draw_run(run);
  return {std::move(drawn.picture), std::move(drawn.entries)};
}

std::vector<Exclusion> exclusions_of(const DeviceRun& run) {
  std::vector<Exclusion> exclusions;
  for (const NotOn& limit : run.not_on) exclusions.push_back({run.name, limit.board, limit.reason});
  return exclusions;
}

}  // namespace

std::vector<Subject> all_subjects() {
  std::vector<Subject> subjects;
  const auto kit = std::make_shared<scenes::SoftEngineKit>();
  for (const scenes::Scene& scene : scenes::all_scenes())
    subjects.push_back({scene.name, scene.note, {}, [&scene, kit] { return draw(scene, kit->engine()); }});
  for (const DeviceRun& run : all_runs())
    subjects.push_back({run.name, run.note, exclusions_of(run), [&run] { return draw(run); }});
  return subjects;
}

}  // namespace usuzumi::golden
