// gfx::ParallelRunner on host threads that live as long as the runner.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "gfx_subsystem/engine/engine.h"

namespace usuzumi::sim {

/// `threads` in all, the caller of run() among them; 0 stands for as many as the host has. run() is for one caller at a
/// time, and a job must not call it.
class ThreadRunner final : public gfx::ParallelRunner {
 public:
  explicit ThreadRunner(std::uint32_t threads);
  ~ThreadRunner();
  ThreadRunner(const ThreadRunner&) = delete;
  ThreadRunner& operator=(const ThreadRunner&) = delete;

 private:
  void do_run(std::uint32_t parts, Job job, void* context) override;
  std::uint32_t do_thread_count() const override { return static_cast<std::uint32_t>(threads_.size()) + 1; }

  void serve();
  void take_parts();

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable work_posted_;

  Job job_ = nullptr;
  void* context_ = nullptr;
  std::uint32_t parts_ = 0;
  std::atomic<std::uint32_t> next_part_{0};
  std::atomic<std::uint32_t> threads_busy_{0};
  std::atomic<std::uint64_t> generation_{0};  // rises with every run()
  std::atomic<bool> stopping_{false};
};

}  // namespace usuzumi::sim
