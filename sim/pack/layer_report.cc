#include "sim/pack/layer_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "firmware/layers/layer_chain.h"

namespace usuzumi::sim {
namespace {

using firmware::DrawingData;
using firmware::LayerChainView;
using firmware::MeshView;
using json = nlohmann::ordered_json;

std::string per_cent(std::uint32_t millionths) { return fmt::format("{:g}%", millionths / 10'000.0); }

}  // namespace

LayerTotals layer_totals(const DrawingData& data) {
  LayerTotals totals;
  data.for_each_mesh([&](const MeshView& mesh) {
    if (mesh.layers.empty()) return;
    ++totals.meshes;
    totals.bytes += LayerChainView::of_checked(mesh.layers).header().bytes;
  });
  return totals;
}

json layers_json(const MeshView& mesh) {
  if (mesh.layers.empty()) return nullptr;
  const LayerChainView chain = LayerChainView::of_checked(mesh.layers);
  json layers = json::array();
  for (const auto& layer : chain.layers())
    layers.push_back({{"quota", per_cent(layer.quota_millionths)}, {"faces", layer.faces}});
  return {{"bytes", chain.header().bytes},
          {"steps", chain.step_count()},
          {"added_vertices", chain.header().added_count},
          {"layers", layers}};
}

std::string layers_text(const DrawingData& data) {
  std::string out;
  data.for_each_mesh([&](const MeshView& mesh) {
    if (mesh.layers.empty()) return;
    const LayerChainView chain = LayerChainView::of_checked(mesh.layers);
    std::vector<std::string> layers;
    for (const auto& layer : chain.layers())
      layers.push_back(fmt::format("{} ({})", layer.faces, per_cent(layer.quota_millionths)));
    out += fmt::format("mesh {}: layers of {} faces; {} bytes\n", mesh.number + 1, fmt::join(layers, ", "),
                       chain.header().bytes);
  });
  const LayerTotals totals = layer_totals(data);
  if (totals.meshes > 1) out += fmt::format("layers of {} meshes: {} bytes\n", totals.meshes, totals.bytes);
  return out;
}

}  // namespace usuzumi::sim
