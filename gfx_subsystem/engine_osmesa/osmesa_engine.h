// The 3D engine by OSMesa: the same command lists, drawn by Mesa's llvmpipe, the picture left in VRAM.
//
// An independent check of engine_soft and a fallback on the host. Everything geometric is OpenGL's own: transform,
// clipping, culling, rasterization, interpolation, depth. Lighting is command_list.h's formula in a vertex shader.
// The picture and the depths already in VRAM are taken over first, so a list may continue an earlier picture.
#pragma once

#include <cstdint>
#include <memory>

#include "gfx_subsystem/engine/engine.h"

namespace usuzumi::gfx {

/// Not for two threads at once; any one thread at a time may call execute().
class OsmesaEngine final : public Engine {
 public:
  /// `threads` that llvmpipe rasterizes with, 0: one per processor. Mesa reads it once per process, so the first engine
  /// decides; LP_NUM_THREADS and GALLIUM_DRIVER in the environment win over both.
  explicit OsmesaEngine(std::uint32_t threads = 1);
  ~OsmesaEngine();
  OsmesaEngine(const OsmesaEngine&) = delete;
  OsmesaEngine& operator=(const OsmesaEngine&) = delete;

  /// kUnavailable where OSMesa cannot start, with the reason; execute() then answers the same and draws nothing.
  const Status& status() const;

  /// OpenGL's name for what draws, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"; empty when status() is not ok.
  const char* renderer() const;

 private:
  /// Counters: pixels_tested is counted by OpenGL (occlusion queries, with depth compared to nothing), faces_drawn on
  /// the CPU (face_counter.h), the rest follows from the list alone.
  ExecutionReport do_execute(std::span<const std::uint32_t> list, BusMemory& memory) override;

  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace usuzumi::gfx
