// The peer: OSMesa's llvmpipe, driven directly in the fastest sane way. Vertices and indices lie in static buffer
// objects, the state is set once, a frame is glClear, glDrawElements, glFinish; lighting is off as it is in ours. The
// frame ends when the picture is in the buffer given to OSMesa.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/engine/bench_scenes.h"

namespace usuzumi::bench {

class LlvmpipePeer {
 public:
  /// Sets LP_NUM_THREADS=0 and asks for llvmpipe; call before anything else touches OpenGL.
  static void choose_driver();

  explicit LlvmpipePeer(const BenchScene& scene);
  ~LlvmpipePeer();
  LlvmpipePeer(const LlvmpipePeer&) = delete;
  LlvmpipePeer& operator=(const LlvmpipePeer&) = delete;

  void draw();
  /// "llvmpipe (LLVM ...)"; the benchmark refuses to compare with anything else.
  const std::string& renderer() const { return renderer_; }
  /// XRGB8888, bottom row first.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  const BenchScene& scene_;
  void* context_;
  std::vector<std::uint32_t> pixels_;
  std::string renderer_;
  void set_texture();

  std::uint32_t buffers_[4] = {}, texture_ = 0;
};

}  // namespace usuzumi::bench
