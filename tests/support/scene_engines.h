// The software engine as scenes use it: with working memory and threads of its own.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "gfx_subsystem/engine_soft/soft_engine.h"

namespace usuzumi::scenes {

/// Threads started anew for every run(): slow, simple, and in another order each time.
class FreshThreads final : public gfx::ParallelRunner {
 public:
  explicit FreshThreads(std::uint32_t threads) : threads_(threads) {}

 private:
  void do_run(std::uint32_t parts, Job job, void* context) override {
    std::atomic<std::uint32_t> next{0};
    const auto work = [&] {
      for (std::uint32_t part = next++; part < parts; part = next++) job(context, part);
    };
    std::vector<std::thread> others;
    for (std::uint32_t i = 1; i < threads_; ++i) others.emplace_back(work);
    work();
    for (std::thread& t : others) t.join();
  }
  std::uint32_t do_thread_count() const override { return threads_; }

  std::uint32_t threads_;
};

/// `kernels` nullptr: the best the processor supports.
class SoftEngineKit {
 public:
  explicit SoftEngineKit(std::uint32_t threads = 1, const gfx::soft::Kernels* kernels = nullptr,
                         std::size_t work_bytes = std::size_t{8} << 20)
      : work_memory_(work_bytes),
        runner_(threads),
        engine_({work_memory_, threads > 1 ? &runner_ : nullptr, kernels}) {}

  gfx::SoftEngine& engine() { return engine_; }

 private:
  std::vector<std::byte> work_memory_;
  FreshThreads runner_;
  gfx::SoftEngine engine_;
};

}  // namespace usuzumi::scenes
