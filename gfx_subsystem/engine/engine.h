// The 3D engine behind its registers: executes one command list. Two implementations stand behind this interface:
// `engine_soft` (ours, the reference for every golden picture) and `engine_osmesa` (an independent check on the host).
#pragma once

#include <cstdint>
#include <span>

#include "hal/bus.h"
#include "hal/status.h"

namespace usuzumi::gfx {

/// What one list made the engine do; the cost model turns it into cycles (cost_model.h). Counts do not depend on
/// threads or SIMD width.
struct EngineCounters {
  std::uint64_t command_words = 0;
  std::uint64_t vertices_transformed = 0;  // vertices of every draw's range, each once
  std::uint64_t primitives_in = 0;         // triangles, lines and points submitted
  std::uint64_t faces_in = 0;              // triangles submitted
  std::uint64_t faces_drawn = 0;           // triangles left after clipping away, culling and zero area
  std::uint64_t pixels_tested = 0;         // pixels covered, before the depth test
  std::uint64_t pixels_cleared = 0;        // pixels filled by clears
  std::uint64_t texels_fetched = 0;        // of the pixels tested in draws with a texture: nearest 1, bilinear 4 each
  std::uint64_t pixels_blended = 0;        // pixels tested in draws that blend
};

/// `status.where` is the word in the list at which execution stopped.
struct ExecutionReport {
  Status status;
  EngineCounters counters;
};

class Engine {
 public:
  /// Executes `list` to its kEnd, reading vertices and indices from and writing pixels to `memory`. Complete on return.
  ExecutionReport execute(std::span<const std::uint32_t> list, BusMemory& memory) { return do_execute(list, memory); }

 protected:
  ~Engine() = default;

 private:
  virtual ExecutionReport do_execute(std::span<const std::uint32_t> list, BusMemory& memory) = 0;
};

/// Runs `job(context, part)` for every part in [0, parts), on several threads where the host has them, and returns when
/// all are done. The engine's results never depend on how many threads there are.
class ParallelRunner {
 public:
  using Job = void (*)(void* context, std::uint32_t part);
  void run(std::uint32_t parts, Job job, void* context) { do_run(parts, job, context); }
  std::uint32_t thread_count() const { return do_thread_count(); }

 protected:
  ~ParallelRunner() = default;

 private:
  virtual void do_run(std::uint32_t parts, Job job, void* context) = 0;
  virtual std::uint32_t do_thread_count() const = 0;
};

}  // namespace usuzumi::gfx
