// The software 3D engine: executes command lists into VRAM, the same bytes on every processor, with any number of
// threads, any SIMD width and any amount of working memory. How: conventions.h (numbers and rules), round.h (the flow).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gfx_subsystem/engine/engine.h"
#include "gfx_subsystem/engine/state.h"
#include "gfx_subsystem/engine_soft/round.h"
#include "hal/arena.h"

namespace usuzumi::gfx {

class SoftEngine final : public Engine, private CommandSink {
 public:
  struct Config {
    /// Vertices, set-up triangles and tile buffers live here. More memory means fewer rounds over the tiles; about
    /// 64 bytes for every triangle drawn in a list are worth having. Must outlive the engine.
    std::span<std::byte> work_memory;
    /// nullptr: everything on the caller's thread. Must outlive the engine.
    ParallelRunner* runner = nullptr;
    /// nullptr: the best variant that the processor supports. For tests: one of soft::all_kernels().
    const soft::Kernels* kernels = nullptr;
    /// Targets of so many bytes and more are stored past the caches. No byte depends on it.
    std::size_t streaming_bytes = soft::kStreamingBytes;
  };

  explicit SoftEngine(const Config& config);

  /// Working memory below which lists on a target of that size end with kResourceExhausted.
  static std::size_t minimum_work_bytes(std::uint32_t width, std::uint32_t height);

  /// Name of the kernel variant in use: "pixelwise", "baseline", "avx2", "avx512".
  const char* kernel_name() const { return kernels_->name; }

 private:
  static constexpr std::uint32_t kMaxWorkers = 16;

  ExecutionReport do_execute(std::span<const std::uint32_t> list, BusMemory& memory) override;
  Status clear(const EngineState& state, const command::Clear& clear) override;
  Status draw(const EngineState& state, const DrawCall& call) override;

  Status bind_target(const EngineState& state);
  bool lay_out_memory();
  void append_item(const soft::WorkItem& item);
  void add_draw_items(std::uint32_t draw, std::uint32_t primitives);

  void finish_round();
  std::uint32_t run_geometry();
  void run_geometry_worker(std::uint32_t worker);
  void run_tiles(std::uint32_t jobs);
  void run_tile_worker(std::uint32_t worker);
  void run_clears();
  void share_out(std::uint32_t parts);
  /// Lets every worker of the phase run `work`.
  template <void (SoftEngine::*work)(std::uint32_t)>
  void run_workers(bool alone);

  const soft::Kernels* kernels_;
  std::span<std::byte> work_memory_;
  ParallelRunner* runner_;
  std::size_t streaming_bytes_;

  // Tables in the working memory, and how much of them the current round uses.
  std::span<soft::DrawSetup> draws_;
  std::span<soft::ClearOperation> clears_;
  std::span<soft::WorkItem> items_;
  std::span<soft::Job> jobs_;
  std::span<soft::TileList> lists_;
  std::uint32_t draw_count_ = 0, clear_count_ = 0, item_count_ = 0, job_count_ = 0;
  std::uint32_t open_job_room_ = 0;  // primitives that the last job still takes

  soft::SlotPool pool_;
  soft::Round round_;
  soft::Worker workers_[kMaxWorkers];
  std::uint32_t worker_count_ = 0;

  // Shared by the workers of a phase.
  std::atomic<std::uint32_t> next_job_{0};
  std::atomic<bool> exhausted_{false};
  std::uint32_t phase_jobs_ = 0;
  struct alignas(64) Share {  // of the tiles: from next to end, a cache line for each worker
    std::atomic<std::uint32_t> next{0};
    std::uint32_t end = 0;
  };
  Share shares_[kMaxWorkers];

  EngineCounters counters_;
};

}  // namespace usuzumi::gfx
