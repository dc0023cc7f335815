// usuzumi_bench_methods: every level-3 method beside QEM, to the same number of faces, on the models of
// usuzumi_bench_simplify. Each row is one model, share and method; times are the least of several rounds in turn.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "firmware/simplify/simplify.h"
#include "tests/bench/simplify/error_meter.h"
#include "tests/bench/simplify/models.h"

namespace usuzumi::bench {
namespace {

using firmware::Method;
using testing::Mesh;

constexpr int kRounds = 5;
constexpr double kPercents[] = {50, 20, 5};

struct Named {
  Method method;
  const char* name;
};
constexpr Named kMethods[] = {{Method::kEdgeRemoval, "edge-removal"},
                              {Method::kHalfEdge, "half-edge"},
                              {Method::kVertexDeletion, "vertex-deletion"}};

struct Run {
  Mesh mesh;
  double seconds = std::numeric_limits<double>::infinity();
  double bytes_per_vertex = 0;
  bool ok = false;
};

void run(const Mesh& input, Method method, std::size_t target_faces, Run& result) {
  const auto vertices = static_cast<std::uint32_t>(input.positions.size());
  const auto faces = static_cast<std::uint32_t>(input.face_count());
  result.mesh = input;
  std::vector<std::byte> memory(firmware::simplify_scratch_bytes(method, vertices, faces, false));
  Arena scratch(memory);
  firmware::WorkingMesh working{.positions = result.mesh.positions,
                                .indices = result.mesh.indices,
                                .vertex_count = vertices,
                                .face_count = faces};
  const auto start = std::chrono::steady_clock::now();
  const auto outcome = firmware::simplify(
      working, {.target_faces = static_cast<std::uint32_t>(target_faces), .method = method}, scratch);
  const auto end = std::chrono::steady_clock::now();
  result.ok = outcome.ok();
  result.seconds = std::min(result.seconds, std::chrono::duration<double>(end - start).count());
  result.bytes_per_vertex = static_cast<double>(scratch.high_water()) / static_cast<double>(vertices);
  result.mesh.positions.resize(working.vertex_count);
  result.mesh.indices.resize(std::size_t{working.face_count} * 3);
}

void compare(const Model& model, double percent, const Named& method) {
  const Mesh& input = model.mesh;
  const auto target = static_cast<std::size_t>(static_cast<double>(input.face_count()) * percent / 100);
  Run ours, qem;
  run(input, method.method, target, ours);
  if (!ours.ok) {
    std::printf("%-15s %-20s %3.0f%%: cannot be thinned\n", method.name, model.name.c_str(), percent);
    return;
  }
  // QEM to what the method reached, which may be more than was asked for.
  const std::size_t reached = ours.mesh.face_count();
  for (int round = 0; round < kRounds; ++round) {
    run(input, Method::kQem, reached, qem);
    run(input, method.method, reached, ours);
  }
  const SurfaceError error = measure_error(input, ours.mesh), qem_error = measure_error(input, qem.mesh);
  const std::size_t flipped = count_flipped_faces(input, ours.mesh, error.hausdorff);
  std::printf("%-15s %-20s %3.0f%% %8zu%c %9.0f %9.0f %6.2fx | %6.3fx %6.3fx | %5.0f %4zu\n", method.name,
              model.name.c_str(), percent, reached, reached > target + 2 ? '+' : ' ',
              static_cast<double>(input.face_count()) / ours.seconds / 1000,
              static_cast<double>(input.face_count()) / qem.seconds / 1000, ours.seconds / qem.seconds,
              error.rms / qem_error.rms, error.hausdorff / qem_error.hausdorff, ours.bytes_per_vertex, flipped);
  std::fflush(stdout);
}

}  // namespace
}  // namespace usuzumi::bench

int main() {
  using namespace usuzumi::bench;
  std::printf("%-15s %-20s %4s %9s %9s %9s %7s | %7s %7s | %5s %4s\n", "method / QEM", "model", "to", "faces",
              "kfaces/s", "QEM's", "time", "rms", "hausd.", "B/vtx", "flip");
  const std::vector<Model> models = load_models();
  for (const Named& method : kMethods)
    for (const Model& model : models)
      for (const double percent : kPercents) compare(model, percent, method);
  return 0;
}
