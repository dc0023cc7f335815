// What draws each scene, by chapter; scene_list.cc numbers them.
#pragma once

#include "tests/support/scene_builder.h"

namespace usuzumi::scenes {

// scene_raster.cc: clears, triangles, topologies, shading, culling, scissor, targets
void build_clear(SceneBuilder& b);
void build_scissored_clear(SceneBuilder& b);
void build_single_triangle(SceneBuilder& b);
void build_shared_edges(SceneBuilder& b);
void build_triangle_strip(SceneBuilder& b);
void build_triangle_fan(SceneBuilder& b);
void build_indexed_u16(SceneBuilder& b);
void build_indexed_u32(SceneBuilder& b);
void build_flat_and_gouraud(SceneBuilder& b);
void build_culling(SceneBuilder& b);
void build_scissored_drawing(SceneBuilder& b);
void build_slivers(SceneBuilder& b);
void build_colour_ramp(SceneBuilder& b);
void build_one_pixel(SceneBuilder& b);
void build_two_lists(SceneBuilder& b);

// scene_points_lines.cc
void build_points(SceneBuilder& b);
void build_lines(SceneBuilder& b);
void build_wide_lines(SceneBuilder& b);

// scene_depth.cc
void build_depth_functions(SceneBuilder& b);
void build_depth_write(SceneBuilder& b);
void build_interpenetrating(SceneBuilder& b);
void build_depth_steps(SceneBuilder& b);

// scene_clipping.cc: near and far planes, guard band, viewports
void build_near_plane(SceneBuilder& b);
void build_far_plane(SceneBuilder& b);
void build_giant_triangles(SceneBuilder& b);
void build_viewports(SceneBuilder& b);
void build_floor(SceneBuilder& b);

// scene_solids.cc: light, and pictures like those of use
void build_lit_sphere(SceneBuilder& b);
void build_lit_torus(SceneBuilder& b);
void build_cluster(SceneBuilder& b);

// scene_textures.cc: textures, alpha test, blending
void build_textured_cards(SceneBuilder& b);
void build_texture_wraps(SceneBuilder& b);
void build_texture_levels(SceneBuilder& b);
void build_alpha_mask(SceneBuilder& b);
void build_blending(SceneBuilder& b);
void build_texture_formats(SceneBuilder& b);
void build_globe(SceneBuilder& b);
void build_textured_room(SceneBuilder& b);

}  // namespace usuzumi::scenes
