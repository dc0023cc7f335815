// The pictures that both engines draw: vertices with colours, indices, one transform.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/vec.h"

namespace usuzumi::bench {

struct BenchScene {
  std::string name;
  std::uint32_t width = 0, height = 0;
  bool flat = false;
  bool clear_only = false;
  Mat4 transform;
  std::vector<Vec3> positions;
  std::vector<Rgba8> colours;
  std::vector<std::uint32_t> indices;  // triangles
};

/// Clear, full-screen quad, grids and spheres of 2 k, 20 k and 200 k triangles, 1 M tiny triangles, 8 layers back to
/// front; flat and Gouraud, at 800x480 and 1920x720. Every scene clears colour and depth first and draws with the depth
/// test.
std::vector<BenchScene> all_bench_scenes();

}  // namespace usuzumi::bench
