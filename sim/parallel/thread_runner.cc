#include "sim/parallel/thread_runner.h"

#include <algorithm>
#include <chrono>

namespace usuzumi::sim {
namespace {

/// Phases follow each other within microseconds; a thread looks that long for the next one before it sleeps.
constexpr std::chrono::microseconds kSpin{50};

template <class Condition>
bool spin_until(Condition met) {
  const auto end = std::chrono::steady_clock::now() + kSpin;
  while (std::chrono::steady_clock::now() < end)
    for (int i = 0; i < 64; ++i)
      if (met()) return true;
  return met();
}

}  // namespace

ThreadRunner::ThreadRunner(std::uint32_t threads) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  for (std::uint32_t i = 1; i < threads; ++i) threads_.emplace_back([this] { serve(); });
}

ThreadRunner::~ThreadRunner() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    generation_.fetch_add(1, std::memory_order_release);
  }
  work_posted_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void ThreadRunner::do_run(std::uint32_t parts, Job job, void* context) {
  if (parts > 1 && !threads_.empty()) {
    {
      const std::lock_guard lock(mutex_);
      job_ = job;
      context_ = context;
      parts_ = parts;
      next_part_.store(0, std::memory_order_relaxed);
      threads_busy_.store(static_cast<std::uint32_t>(threads_.size()), std::memory_order_relaxed);
      generation_.fetch_add(1, std::memory_order_release);
    }
    work_posted_.notify_all();
    take_parts();
    const auto all_done = [this] { return threads_busy_.load(std::memory_order_acquire) == 0; };
    while (!spin_until(all_done)) std::this_thread::yield();
    return;
  }
  for (std::uint32_t part = 0; part < parts; ++part) job(context, part);
}

void ThreadRunner::take_parts() {
  for (;;) {
    const std::uint32_t part = next_part_.fetch_add(1, std::memory_order_relaxed);
    if (part >= parts_) return;
    job_(context_, part);
  }
}

void ThreadRunner::serve() {
  for (std::uint64_t seen = 0;;) {
    const auto posted = [&] { return generation_.load(std::memory_order_acquire) != seen; };
    if (!spin_until(posted)) {
      std::unique_lock lock(mutex_);
      work_posted_.wait(lock, posted);
    }
    seen = generation_.load(std::memory_order_acquire);
    if (stopping_) return;
    take_parts();
    threads_busy_.fetch_sub(1, std::memory_order_release);
  }
}

}  // namespace usuzumi::sim
