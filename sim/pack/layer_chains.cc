#include "sim/pack/layer_chains.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/drawing_data/mesh_layers.h"
#include "firmware/layers/layer_chain_builder.h"
#include "sim/common/progress.h"
#include "sim/pack/host_arena.h"
#include "sim/pack/rom_writer.h"

namespace usuzumi::sim {
namespace {

using firmware::LayerChainView;

/// The mesh as it will lie in ROM. No method looks at materials, so it goes without.
std::vector<std::byte> rom_of(const Mesh& mesh) {
  Model alone;
  alone.meshes.push_back(mesh);
  alone.meshes[0].material.reset();
  for (MeshPart& part : alone.meshes[0].parts) part.material.reset();
  return write_container(alone);
}

/// mesh_layers_bytes() is what is needed in practice, so a mesh out of the common gets more, this often doubled.
constexpr unsigned kDoublings = 4;

Status make_chain(const firmware::MeshView& mesh, std::span<const std::uint32_t> quotas, std::vector<std::byte>& out) {
  const std::uint32_t faces = mesh.proper_face_count();
  Status status;
  for (unsigned i = 0; i <= kDoublings; ++i) {
    HostArena host(static_cast<std::size_t>(firmware::mesh_layers_bytes(mesh, faces) << i));
    const auto made = firmware::make_mesh_layers(mesh, faces, quotas, firmware::Placement::kOptimal, host.arena);
    if (made.ok()) out.assign(made->begin(), made->end());
    status = made.status();
    if (status.code != StatusCode::kResourceExhausted) break;
  }
  return status;
}

/// Meshes whose chain ends before the author's last layer.
struct EndEarly {
  std::size_t count = 0;
  std::string first;  // in words

  void add(const Mesh& mesh) {
    const LayerChainView chain = LayerChainView::of_checked(mesh.layer_chain);
    const std::uint32_t left = chain.layers().back().faces,
                        asked = firmware::layer_faces(chain.face_count(), mesh.tags.layers->back());
    if (left <= asked || count++ > 0) return;
    first =
        fmt::format("mesh '{}' at {} of {} faces, where {} were asked for", mesh.name, left, chain.face_count(), asked);
  }
};

}  // namespace

void make_layer_chains(Model& model) {
  if (std::none_of(model.meshes.begin(), model.meshes.end(), [](const Mesh& m) { return m.tags.layers.has_value(); }))
    return;
  const Progress progress("making layers");
  EndEarly early;
  for (Mesh& mesh : model.meshes) {
    mesh.layer_chain.clear();
    if (!mesh.tags.layers) continue;
    const std::vector<std::byte> rom = rom_of(mesh);
    const auto data = firmware::DrawingData::open(rom);
    if (!data.ok())
      throw std::logic_error(
          fmt::format("mesh '{}' alone is unsound: {} {}", mesh.name, data.status().message, data.status().where));
    const Status status = make_chain(data->mesh(0), *mesh.tags.layers, mesh.layer_chain);
    if (status.ok()) {
      early.add(mesh);
      continue;
    }
    model.notes.push_back(fmt::format("mesh '{}': packed without layers, the device thins it anew each time: {} {}",
                                      mesh.name, status.message, status.where));
  }
  if (early.count > 0)
    model.notes.push_back(
        fmt::format("layers of {} meshes end before the last that was asked for, the first {}: their method may take "
                    "no more away",
                    early.count, early.first));
}

}  // namespace usuzumi::sim
