#include "tests/study/layer_sweep.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "firmware/device/turntable.h"
#include "sim/desk/desk.h"
#include "sim/pack/layer_chains.h"
#include "sim/pack/rom_writer.h"

namespace usuzumi::study {

testing::SweepChange sweep_layers(sim::Model model, firmware::Method method, const testing::QuotaSweep& sweep,
                                  PictureSize size, int views) {
  constexpr double kAzimuth = 0.3, kElevation = 0.4;
  for (sim::Mesh& mesh : model.meshes) {
    mesh.tags.level = 3;
    mesh.tags.method = method;
    mesh.tags.layers.emplace(sweep.layers_millionths.begin(), sweep.layers_millionths.end());
  }
  sim::make_layer_chains(model);
  const std::vector<std::byte> rom = sim::write_container(model);
  sim::DeskConfig config;
  config.width = size.width;
  config.height = size.height;
  const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  const firmware::Bounds bounds = bounds_of(model);
  testing::SweepChange largest;
  for (int i = 0; i < views; ++i) {
    sim::Desk middle(config, rom, "sweep"), switched(config, rom, "sweep");
    const double azimuth = kAzimuth + 2 * std::numbers::pi * i / views;
    const auto request =
        firmware::lit_request(firmware::view_of(bounds, azimuth, kElevation, aspect), aspect, rgba8(10, 20, 30));
    const testing::SweepChange change = testing::sweep_quota(middle, switched, request, sweep);
    largest.middle = std::max(largest.middle, change.middle);
    largest.switched = std::max(largest.switched, change.switched);
  }
  return largest;
}

}  // namespace usuzumi::study
