// Scenes from a seed: draws of random triangles under random state, for what nobody thought of drawing.
#pragma once

#include <cstdint>

#include "tests/support/scene_builder.h"

namespace usuzumi::scenes {

/// Target for a seed: up to 220 x 160 pixels, any formats, any padding.
TargetSpec random_target(std::uint64_t seed);

/// One to five draws of triangle topologies: with and without indices, in pixels and in perspective, with corners near,
/// far and behind the eye, under any raster state, light, scissor and whole-pixel viewport. Now and then a new list.
void build_random(SceneBuilder& b, std::uint64_t seed);

/// The same, every draw with a texture of any format, size, filter, wrap mode and number of levels (smooth where there
/// are several), now and then with alpha test or blending, over a colour of its own: two backgrounds do not tell which
/// pixels a blended draw covers, so that coverage shows as colour.
void build_random_textured(SceneBuilder& b, std::uint64_t seed);

}  // namespace usuzumi::scenes
