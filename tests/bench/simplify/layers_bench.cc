// usuzumi_bench_layers: reaching a number of faces by replaying a chain of layers, against thinning to it anew, on the
// models of usuzumi_bench_simplify. Times are the least of several rounds in turn.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include "firmware/drawing_data/mesh_layers.h"
#include "firmware/simplify/simplify.h"
#include "tests/bench/simplify/models.h"
#include "tests/support/indexed_view.h"

namespace usuzumi::bench {
namespace {

using firmware::LayerChainView;
using firmware::MeshView;
using firmware::Method;
using testing::Mesh;

constexpr int kRounds = 5;
constexpr std::uint32_t kQuotas[] = {1'000'000, 600'000, 360'000, 216'000, 129'600, 77'760, 50'000};

struct Named {
  Method method;
  const char* name;
};
constexpr Named kMethods[] = {{Method::kQem, "qem"},
                              {Method::kEdgeRemoval, "edge-removal"},
                              {Method::kHalfEdge, "half-edge"},
                              {Method::kVertexDeletion, "vertex-deletion"}};

/// The least time of several rounds, in milliseconds.
class Least {
 public:
  void measure(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    ms_ = std::min(ms_, took.count());
  }
  double ms() const { return ms_; }

 private:
  double ms_ = std::numeric_limits<double>::infinity();
};

/// Whether it can be thinned to `faces`.
bool thin(const Mesh& mesh, Method method, std::uint32_t faces, std::span<std::byte> memory) {
  Mesh work = mesh;
  firmware::WorkingMesh working{.positions = work.positions,
                                .normals = work.normals,
                                .indices = work.indices,
                                .vertex_count = static_cast<std::uint32_t>(work.positions.size()),
                                .face_count = static_cast<std::uint32_t>(work.face_count())};
  Arena scratch(memory);
  return firmware::simplify(working, {.target_faces = faces, .method = method, .for_layers = true}, scratch).ok();
}

void compare(const Model& model, const Named& method) {
  Mesh mesh = model.mesh;
  mesh.normals.assign(mesh.positions.size(), pack_normal({0, 0, 1}));
  const MeshView view = testing::indexed_view(mesh, method.method);
  const std::uint32_t faces = view.proper_face_count();
  std::vector<std::byte> memory(firmware::mesh_layers_bytes(view, faces));
  Arena arena(memory);
  Least making;
  std::span<const std::byte> bytes;
  making.measure([&] {
    const auto made = firmware::make_mesh_layers(view, faces, kQuotas, firmware::Placement::kOptimal, arena);
    if (made.ok()) bytes = *made;
  });
  if (bytes.empty()) return;
  const std::vector<std::byte> kept(bytes.begin(), bytes.end());
  const LayerChainView chain = LayerChainView::of_checked(kept);
  std::vector<std::uint32_t> indices(std::size_t{3} * faces), live(chain.group_count());
  firmware::LayerReplay replay(chain, std::as_writable_bytes(std::span(indices)), 4, live);
  firmware::begin_replay(view, replay);

  const std::uint32_t coarse = chain.faces_at(chain.step_count());
  Least searched, replayed, stepped;
  for (int round = 0; round < kRounds; ++round) {
    searched.measure([&] { thin(mesh, method.method, coarse, memory); });
    replay.go_to(0);
    replayed.measure([&] { replay.go_to_faces(coarse); });
    replay.go_to_faces(faces / 2);
    stepped.measure([&] { replay.go_to_faces(faces / 2 - faces / 100); });
  }
  std::printf("%-15s %-20s %8u %8u %9.2f %9.3f %7.0fx %9.4f %9.1f %7.1f\n", method.name, model.name.c_str(), faces,
              coarse, searched.ms(), replayed.ms(), searched.ms() / replayed.ms(), stepped.ms(),
              making.ms() / searched.ms(), static_cast<double>(kept.size()) / faces);
  std::fflush(stdout);
}

}  // namespace
}  // namespace usuzumi::bench

int main() {
  using namespace usuzumi::bench;
  std::printf("%-15s %-20s %8s %8s %9s %9s %8s %9s %9s %7s\n", "method", "model", "faces", "to", "anew ms", "replay ms",
              "ratio", "1 % ms", "making", "B/face");
  for (const Model& model : load_models())
    for (const Named& method : kMethods) compare(model, method);
  return 0;
}
