// The pictures that both engines draw: vertices with colours, indices, one transform.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/vec.h"

namespace usuzumi::bench {

/// Levels one after the other down to one texel, each alpha, red, green, blue; repeated in both axes.
struct BenchTexture {
  std::uint32_t width = 0, height = 0, levels = 0;
  std::vector<std::uint32_t> texels;
  bool bilinear = true;
};

struct BenchScene {
  std::string name;
  std::uint32_t width = 0, height = 0;
  bool flat = false;
  bool clear_only = false;
  Mat4 transform;
  std::vector<Vec3> positions;
  std::vector<Rgba8> colours;
  std::vector<TexCoord> coordinates;   // of a texture, or empty
  std::vector<std::uint32_t> indices;  // triangles
  BenchTexture texture;                // width 0: none
  bool blended = false;                // by alpha
};

/// Clear, full-screen quad, grids and spheres of 2 k, 20 k and 200 k triangles, 1 M tiny triangles, 8 layers back to
/// front; flat and Gouraud, at 800x480 and 1920x720. Then textures: a quad texel by pixel, a floor with levels to the
/// horizon, spheres under vertex colours, 8 blended layers. Every scene clears colour and depth first and draws with
/// the depth test.
std::vector<BenchScene> all_bench_scenes();

}  // namespace usuzumi::bench
