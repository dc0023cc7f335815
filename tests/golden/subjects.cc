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

sim::Image draw(const scenes::Scene& scene, gfx::Engine& engine) {
  scenes::SceneDrawing drawing = scenes::draw_scene(scene, engine);
  if (!drawing.status.ok()) throw std::runtime_error(std::string(scene.name) + ": " + drawing.status.message);
  if (drawing.strayed) throw std::runtime_error(std::string(scene.name) + ": the engine wrote outside its target");
  return std::move(drawing.picture);
}

}  // namespace

std::vector<Subject> all_subjects() {
  std::vector<Subject> subjects;
  const auto kit = std::make_shared<scenes::SoftEngineKit>();
  for (const scenes::Scene& scene : scenes::all_scenes())
    subjects.push_back({scene.name, scene.note, [&scene, kit] { return draw(scene, kit->engine()); }});
  for (const DeviceRun& run : all_runs())
    subjects.push_back({run.name, run.note, [&run] { return draw_run(run).picture; }});
  return subjects;
}

}  // namespace usuzumi::golden
