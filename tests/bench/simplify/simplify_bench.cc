// usuzumi_bench_simplify: level-3 thinning against libmeshoptimizer's meshopt_simplify, to the same number of faces.
//
// Each benchmark runs both in turn in the same process; its time is ours, its counters are the ratios (ours / theirs)
// of the least times, of root-mean-square and Hausdorff distances, and what else the result is held to. After the last
// one their geometric means are printed, and how the time per face grows with the size of the mesh.
#include <benchmark/benchmark.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "firmware/simplify/qem/qem.h"
#include "tests/bench/simplify/error_meter.h"
#include "tests/bench/simplify/models.h"

namespace usuzumi::bench {
namespace {

using testing::Mesh;

constexpr int kRounds = 9;           // of each side, in turn; the least time counts
constexpr double kPercents[] = {50, 20, 5, 1};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Run {
  Mesh mesh;
  double ms = std::numeric_limits<double>::infinity();
  std::size_t scratch_bytes = 0;
  firmware::SimplifyOutcome outcome;
};

void run_ours(const Mesh& input, std::size_t target_faces, std::vector<std::byte>& memory, Run& run) {
  const auto vertices = static_cast<std::uint32_t>(input.positions.size());
  const auto faces = static_cast<std::uint32_t>(input.face_count());
  run.mesh = input;
  memory.resize(firmware::qem_scratch_bytes(vertices, faces, false));
  Arena scratch(memory);
  firmware::WorkingMesh working{.positions = run.mesh.positions,
                                .colours = run.mesh.colours,
                                .indices = run.mesh.indices,
                                .vertex_count = vertices,
                                .face_count = faces};
  const auto start = std::chrono::steady_clock::now();
  const auto outcome =
      firmware::simplify_qem(working, {.target_faces = static_cast<std::uint32_t>(target_faces)}, scratch);
  run.ms = std::min(run.ms, milliseconds_since(start));
  run.outcome = outcome.value();
  run.scratch_bytes = scratch.high_water();
  run.mesh.positions.resize(working.vertex_count);
  if (!run.mesh.colours.empty()) run.mesh.colours.resize(working.vertex_count);
  run.mesh.indices.resize(std::size_t{working.face_count} * 3);
}

void run_theirs(const Mesh& input, std::size_t target_faces, Run& run) {
  run.mesh = input;
  std::vector<unsigned> indices(input.indices.size());
  const auto start = std::chrono::steady_clock::now();
  const std::size_t count = meshopt_simplify(indices.data(), input.indices.data(), input.indices.size(),
                                             &input.positions[0].x, input.positions.size(), sizeof(Vec3),
                                             target_faces * 3, std::numeric_limits<float>::max(), 0, nullptr);
  run.ms = std::min(run.ms, milliseconds_since(start));
  run.mesh.indices.assign(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(count));
}

struct Row {
  std::string name;
  double time = 0, rms = 0, hausdorff = 0, scratch = 0;
  // Flipped: nothing of their part of the model that is as near as the Hausdorff distance looks their way (nothing was
  // moved further than that). Near ones: nothing as near as the root-mean-square distance, as in walls that are thinner
  // than it.
  std::size_t flipped = 0, flipped_theirs = 0, flipped_near = 0, flipped_near_theirs = 0;
  std::size_t new_non_manifold = 0, faces = 0, faces_theirs = 0, target = 0;
  double ours_ms = 0, theirs_ms = 0;
};
std::vector<Row> rows;

// Both results once more with every part in a colour of its own (not timed: meshopt_simplify carries no attributes).
void count_flipped(Row& row, const Mesh& input, const Mesh& ours, const Mesh& theirs, const SurfaceError& e,
                   const SurfaceError& e0) {
  Mesh painted = input;
  paint_parts(painted);
  std::vector<std::byte> memory;
  Run again;
  run_ours(painted, ours.face_count(), memory, again);
  if (again.mesh.positions != ours.positions)
    std::fprintf(stderr, "%s: colours changed the result\n", row.name.c_str());
  Mesh theirs_painted = theirs;  // its vertices are the input's
  theirs_painted.colours = painted.colours;
  row.flipped = count_flipped_faces(painted, again.mesh, e.hausdorff);
  row.flipped_theirs = count_flipped_faces(painted, theirs_painted, e0.hausdorff);
  row.flipped_near = count_flipped_faces(painted, again.mesh, e.rms);
  row.flipped_near_theirs = count_flipped_faces(painted, theirs_painted, e0.rms);
}

Row compare(const Model& model, double percent) {
  const Mesh& input = model.mesh;
  const auto target = static_cast<std::size_t>(static_cast<double>(input.face_count()) * percent / 100);
  std::vector<std::byte> memory;
  Run ours, theirs;
  // To the same count: either may stop short of the target, theirs for want of slack in its passes, ours because the
  // surface's topology allows no less (a closed part keeps four faces). Both are then measured at the higher of the
  // two.
  run_theirs(input, target, theirs);
  run_ours(input, theirs.mesh.face_count(), memory, ours);
  const std::size_t reached = std::max(theirs.mesh.face_count(), ours.mesh.face_count());
  for (int round = 0; round < kRounds; ++round) {
    run_ours(input, reached, memory, ours);
    run_theirs(input, reached, theirs);
  }
  const SurfaceError e = measure_error(input, ours.mesh), e0 = measure_error(input, theirs.mesh);
  Row row;
  row.name = model.name + "/" + std::to_string(static_cast<int>(percent)) + "%";
  row.time = ours.ms / theirs.ms;
  row.rms = e.rms / e0.rms;
  row.hausdorff = e.hausdorff / e0.hausdorff;
  row.scratch = static_cast<double>(ours.scratch_bytes) / static_cast<double>(input.positions.size());
  const std::size_t before = testing::topology_of(input).non_manifold_edges;
  const std::size_t after = testing::topology_of(ours.mesh).non_manifold_edges;
  row.new_non_manifold = after > before ? after - before : 0;
  count_flipped(row, input, ours.mesh, theirs.mesh, e, e0);
  row.faces = ours.mesh.face_count();
  row.faces_theirs = theirs.mesh.face_count();
  row.target = target;
  row.ours_ms = ours.ms;
  row.theirs_ms = theirs.ms;
  return row;
}

void register_comparison(const Model& model, double percent) {
  const std::string name = "thin/" + model.name + "/" + std::to_string(static_cast<int>(percent)) + "%";
  benchmark::RegisterBenchmark(name.c_str(), [&model, percent](benchmark::State& state) {
    for (auto _ : state) {
      const Row row = compare(model, percent);
      state.SetIterationTime(row.ours_ms / 1000);
      state.counters["time_ratio"] = row.time;
      state.counters["rms_ratio"] = row.rms;
      state.counters["hausdorff_ratio"] = row.hausdorff;
      state.counters["scratch_per_vertex"] = row.scratch;
      state.counters["faces"] = static_cast<double>(row.faces);
      state.counters["faces_meshopt"] = static_cast<double>(row.faces_theirs);
      rows.push_back(row);
    }
  })->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
}

struct ScalePoint {
  std::size_t faces = 0;
  double ns_per_face = 0, ns_per_face_theirs = 0;
};
std::vector<ScalePoint> scale_points;

// A noisy ball: every size has detail of its own, as scans have.
Mesh bumpy_sphere(int levels) {
  Mesh mesh = testing::icosphere(levels);
  std::uint32_t state = 12345;
  for (Vec3& p : mesh.positions) {
    state = state * 1664525u + 1013904223u;
    p = p * (1.0f + 1e-3f * static_cast<float>(state >> 8) * 0x1p-24f / static_cast<float>(1 << levels) * 64.0f);
  }
  return mesh;
}

void register_scaling(int levels) {
  const std::string name = "scaling/levels:" + std::to_string(levels);
  benchmark::RegisterBenchmark(name.c_str(), [levels](benchmark::State& state) {
    const Mesh mesh = bumpy_sphere(levels);
    for (auto _ : state) {
      std::vector<std::byte> memory;
      Run ours, theirs;
      for (int round = 0; round < 3; ++round) {
        run_ours(mesh, mesh.face_count() / 10, memory, ours);
        run_theirs(mesh, mesh.face_count() / 10, theirs);
      }
      state.SetIterationTime(ours.ms / 1000);
      const double faces = static_cast<double>(mesh.face_count());
      scale_points.push_back({mesh.face_count(), ours.ms * 1e6 / faces, theirs.ms * 1e6 / faces});
      state.counters["ns_per_face"] = scale_points.back().ns_per_face;
      state.counters["ns_per_face_meshopt"] = scale_points.back().ns_per_face_theirs;
    }
  })->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
}

double geometric_mean(double Row::*value) {
  double sum = 0;
  for (const Row& row : rows) sum += std::log(row.*value);
  return std::exp(sum / static_cast<double>(rows.size()));
}

void print_report() {
  if (!rows.empty()) {
    std::printf("\n%-15s %7s %8s %9s | %8s %8s %8s | %8s %6s %10s %12s\n", "ours / meshopt", "faces", "ours ms",
                "theirs ms", "time", "rms", "hausdorf", "B/vertex", "nonman", "flipped", "within rms");
    Row sum;
    for (const Row& r : rows) {
      std::printf("%-15s %7zu %8.2f %9.2f | %7.3fx %7.3fx %7.3fx | %8.1f %6zu %4zu (%zu) %6zu (%zu)%s\n",
                  r.name.c_str(), r.faces, r.ours_ms, r.theirs_ms, r.time, r.rms, r.hausdorff, r.scratch,
                  r.new_non_manifold, r.flipped, r.flipped_theirs, r.flipped_near, r.flipped_near_theirs,
                  r.faces > r.target + 2 ? ("  stopped above the " + std::to_string(r.target) + " asked").c_str() : "");
      sum.new_non_manifold += r.new_non_manifold;
      sum.flipped += r.flipped;
      sum.flipped_theirs += r.flipped_theirs;
      sum.flipped_near += r.flipped_near;
      sum.flipped_near_theirs += r.flipped_near_theirs;
      sum.scratch = std::max(sum.scratch, r.scratch);
    }
    std::printf(
        "%-15s %7s %8s %9s | %7.3fx %7.3fx %7.3fx | %8.1f %6zu %4zu (%zu) %6zu (%zu)   geometric means; largest; "
        "sums\n",
        "all", "", "", "", geometric_mean(&Row::time), geometric_mean(&Row::rms), geometric_mean(&Row::hausdorff),
        sum.scratch, sum.new_non_manifold, sum.flipped, sum.flipped_theirs, sum.flipped_near, sum.flipped_near_theirs);
    std::printf("%-15s %7s %8s %9s | %8s %8s %8s | %8s %6s %4s   flipped: ours (theirs)\n", "asked", "", "", "", "<=2x",
                "<=0.65x", "<=1.0x", "<=128", "0", "0");
  }
  if (!scale_points.empty()) {
    std::printf("\nns per input face, thinned to 10 %%:");
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const ScalePoint& p : scale_points) {
      std::printf("  %zu: %.0f (meshopt %.0f)", p.faces, p.ns_per_face, p.ns_per_face_theirs);
      least = std::min(least, p.ns_per_face);
      most = std::max(most, p.ns_per_face);
    }
    std::printf("\ngrowth %.2fx (asked: < 1.5x)\n", most / least);
  }
}

}  // namespace
}  // namespace usuzumi::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const std::vector<usuzumi::bench::Model> models = usuzumi::bench::load_models();
  for (const auto& model : models)
    for (const double percent : usuzumi::bench::kPercents) usuzumi::bench::register_comparison(model, percent);
  for (const int levels : {4, 5, 6, 7, 8}) usuzumi::bench::register_scaling(levels);
  benchmark::RunSpecifiedBenchmarks();
  usuzumi::bench::print_report();
  return 0;
}
