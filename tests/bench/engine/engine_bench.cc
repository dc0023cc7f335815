// Our engine against OSMesa's llvmpipe on identical triangles, interleaved frame by frame in one process. Prints
// milliseconds of both, the ratio and what a second thread gains, scene by scene, then the geometric means.
//
// Both draw XRGB8888 with 24 bits of depth, clear included, lighting off, into memory of ours; llvmpipe without threads
// (LP_NUM_THREADS=0). Times are medians. USUZUMI_BENCH_ONLY_OURS=1 leaves llvmpipe out, for a profiler.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "sim/parallel/thread_runner.h"
#include "tests/bench/engine/llvmpipe_peer.h"
#include "tests/bench/engine/soft_subject.h"

namespace usuzumi::bench {
namespace {

/// Of our drawing in a row, on one thread. Arbitrary.
constexpr double kBatchMs = 5;

/// Logarithms summed over the scenes.
struct GeometricMean {
  double log_sum = 0;
  int count = 0;
  void add(double v) {
    log_sum += std::log(v);
    ++count;
  }
  double value() const { return count == 0 ? 0 : std::exp(log_sum / count); }
};

struct Means {
  GeometricMean ratio, second_thread, ratio_small_size, ratio_large_size, textured;
};

double milliseconds(auto&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> v) {
  if (v.empty()) return 0;
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  return *middle;
}

/// Pixels that differ by more than 3 of 255 in a channel: a guard against comparing different pictures.
double share_different(const BenchScene& s, const std::uint32_t* ours, const std::uint32_t* theirs) {
  std::size_t different = 0;
  for (std::uint32_t y = 0; y < s.height; ++y)
    for (std::uint32_t x = 0; x < s.width; ++x) {
      const std::uint32_t a = ours[std::size_t{y} * s.width + x],
                          b = theirs[std::size_t{s.height - 1 - y} * s.width + x];
      for (int shift = 0; shift < 24; shift += 8)
        if (std::abs(static_cast<int>(a >> shift & 255) - static_cast<int>(b >> shift & 255)) > 3) {
          ++different;
          break;
        }
    }
  return static_cast<double>(different) / (double{1} * s.width * s.height);
}

const gfx::soft::Kernels* forced_kernels() {
  const char* name = std::getenv("USUZUMI_BENCH_KERNEL");
  for (const gfx::soft::Kernels* k : gfx::soft::all_kernels())
    if (name != nullptr && std::string(name) == k->name) return k;
  return nullptr;
}

void run_scene(benchmark::State& state, const BenchScene& scene, Means& means) {
  sim::ThreadRunner two_threads(2);
  SoftSubject one(scene, nullptr, forced_kernels()), two(scene, &two_threads, forced_kernels());
  std::unique_ptr<LlvmpipePeer> peer;
  if (std::getenv("USUZUMI_BENCH_ONLY_OURS") == nullptr) peer = std::make_unique<LlvmpipePeer>(scene);
  if (peer && peer->renderer().find("llvmpipe") == std::string::npos)
    return state.SkipWithError("the peer is not llvmpipe");
  one.draw();
  two.draw();
  if (peer) {
    peer->draw();
    const double different = share_different(scene, one.pixels(), peer->pixels().data());
    state.counters["differ_%"] = different * 100;
    // A level of detail is each engine's own, so a textured picture differs by more along the lines where it changes.
    if (different > (scene.texture.width == 0 ? 0.01 : 0.05))
      return state.SkipWithError("the two pictures differ in more than 1 % (with textures 5 %) of the pixels");
  }
  // A device draws frame upon frame: each side draws a few in a row, so that no side's first frame after the other's,
  // with cold caches and threads asleep, stands for all.
  const int frames = static_cast<int>(kBatchMs / milliseconds([&] { one.draw(); })) + 1;
  const auto frame_ms = [frames](auto& subject) {
    return milliseconds([&] {
             for (int i = 0; i < frames; ++i) subject.draw();
           }) / frames;
  };
  std::vector<double> ours, ours_two, theirs;
  for (auto _ : state) {
    ours.push_back(frame_ms(one));
    if (peer) theirs.push_back(frame_ms(*peer));
    ours_two.push_back(frame_ms(two));
    state.SetIterationTime(ours.back() / 1000);
  }
  const double t1 = median(ours), t2 = median(ours_two), peer_ms = median(theirs);
  state.counters["ours_ms"] = t1;
  state.counters["two_threads_ms"] = t2;
  state.counters["second_thread"] = t1 / t2;
  if (scene.texture.width == 0) means.second_thread.add(t1 / t2);
  if (!peer) return;
  state.counters["llvmpipe_ms"] = peer_ms;
  state.counters["ratio"] = peer_ms / t1;
  if (scene.texture.width != 0) return means.textured.add(peer_ms / t1);
  means.ratio.add(peer_ms / t1);
  (scene.width == 800 ? means.ratio_small_size : means.ratio_large_size).add(peer_ms / t1);
}

}  // namespace
}  // namespace usuzumi::bench

int main(int argc, char** argv) {
  using namespace usuzumi::bench;
  LlvmpipePeer::choose_driver();
  benchmark::Initialize(&argc, argv);
  const std::vector<BenchScene> scenes = all_bench_scenes();
  Means means;
  for (const BenchScene& scene : scenes) {
    const int frames = scene.indices.size() > 2000000 ? 7 : scene.indices.size() > 200000 ? 11 : 31;
    benchmark::RegisterBenchmark(scene.name.c_str(), [&](benchmark::State& state) { run_scene(state, scene, means); })
        ->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(frames);
  }
  benchmark::RunSpecifiedBenchmarks();
  std::printf(
      "geometric mean over %d scenes: llvmpipe / ours, one thread: %.2f (800x480 %.2f, 1920x720 %.2f); second thread: "
      "%.2f\n",
      means.second_thread.count, means.ratio.value(), means.ratio_small_size.value(), means.ratio_large_size.value(),
      means.second_thread.value());
  std::printf("geometric mean over %d textured scenes: llvmpipe / ours, one thread: %.2f\n", means.textured.count,
              means.textured.value());
  benchmark::Shutdown();
  return 0;
}
