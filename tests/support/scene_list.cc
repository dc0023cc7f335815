// The scenes by number. A number, once given, stays: it names the golden.
#include "tests/support/scene_functions.h"

namespace usuzumi::scenes {
namespace {

constexpr auto kRgb565 = command::PixelFormat::kRgb565;
constexpr auto kXrgb8888 = command::PixelFormat::kXrgb8888;
constexpr auto kNone = command::DepthFormat::kNone;
constexpr auto kDepth16 = command::DepthFormat::kUnorm16;
constexpr auto kDepth24 = command::DepthFormat::kUnorm24;

// Engines take derivatives as they like (OSMesa's llvmpipe: one for each 2 x 2 pixels), so along the line where the
// level changes a row of pixels may have the level beside it.
constexpr PeerTolerance kLevels{2, 30};
// A channel of 8 bits that is 1 off may round to the next step of 5 bits, which is 8 or 9 of 255.
constexpr PeerTolerance kStepOf5Bits{9, 5};

const Scene kScenes[] = {
    {"01-clear", "a clear of the whole target", {64, 48}, build_clear},
    {"02-scissored-clear", "clears fill the scissor rectangle, clipped to the target", {96, 64}, build_scissored_clear},
    {"03-single-triangle", "one Gouraud triangle", {160, 112}, build_single_triangle},
    {"04-shared-edges", "top-left rule on edges through pixel corners and centres", {128, 128}, build_shared_edges},
    {"05-triangle-strip", "every second triangle of a strip turns round", {160, 120}, build_triangle_strip},
    {"06-triangle-fan", "a fan closed into a disc", {128, 128}, build_triangle_fan},
    {"07-indexed-u16", "16-bit indices, from the middle, in three topologies", {144, 104}, build_indexed_u16},
    {"08-indexed-u32", "indices above 65535", {176, 104}, build_indexed_u32},
    {"09-flat-and-gouraud", "flat takes the last vertex", {200, 108}, build_flat_and_gouraud},
    {"10-culling", "cull mode x front face x winding", {136, 60}, build_culling},
    {"11-scissored-drawing", "drawing stays within the scissor", {128, 112}, build_scissored_drawing},
    {"12-slivers", "triangles thinner and smaller than a pixel, and empty ones", {160, 120}, build_slivers},
    {"13-points", "squares of many sizes at fractions of a pixel", {170, 170}, build_points},
    {"14-lines", "one pixel wide, in all octants, both ways", {256, 128}, build_lines},
    {"15-wide-lines", "widened along the minor axis", {256, 256}, build_wide_lines},
    {"16-depth-functions", "less, less or equal, always", {186, 112, kXrgb8888, kDepth24}, build_depth_functions},
    {"17-depth-write",
     "depth write off, depth test off, depth cleared within the scissor",
     {100, 96, kXrgb8888, kDepth24},
     build_depth_write},
    {"18-interpenetrating", "surfaces that pierce each other", {160, 160, kXrgb8888, kDepth24}, build_interpenetrating},
    {"19-depth-steps-24", "depths 2 / 65535 apart, 24 bits", {128, 128, kXrgb8888, kDepth24}, build_depth_steps},
    {"20-depth-steps-16", "depths 2 / 65535 apart, 16 bits", {128, 128, kXrgb8888, kDepth16}, build_depth_steps},
    {"21-near-plane", "corners behind the eye", {200, 140, kXrgb8888, kDepth24}, build_near_plane},
    {"22-far-plane", "surfaces beyond the far plane", {200, 140, kXrgb8888, kDepth24}, build_far_plane},
    {"23-giant-triangles", "corners far beyond the guard band", {128, 128}, build_giant_triangles},
    {"24-viewports",
     "viewports at fractions of a pixel, depth ranges, clipping to the view volume",
     {160, 144, kXrgb8888, kDepth24},
     build_viewports},
    {"25-floor", "colours in perspective", {240, 136, kXrgb8888, kDepth24}, build_floor},
    {"26-lit-sphere",
     "ambient and directional light on a constant colour",
     {160, 160, kXrgb8888, kDepth24},
     build_lit_sphere},
    {"27-lit-torus", "light over vertex colours, cut at 1", {200, 160, kXrgb8888, kDepth16}, build_lit_torus},
    {"28-rgb565", "every step of 16-bit colour", {200, 124, kRgb565, kNone}, build_colour_ramp},
    {"29-rgb565-odd-width",
     "16-bit colour and depth, odd width, rows apart",
     {133, 131, kRgb565, kDepth16, 20},
     build_interpenetrating},
    {"30-odd-stride",
     "32-bit colour, rows apart by an odd number of pixels",
     {131, 113, kXrgb8888, kDepth24, 28},
     build_scissored_drawing},
    {"31-one-pixel", "a target of one pixel", {1, 1}, build_one_pixel},
    {"32-two-lists",
     "a second list goes on with the first one's picture and depths",
     {132, 124, kXrgb8888, kDepth24},
     build_two_lists},
    {"33-cluster", "gauges, needles, telltales, a lit solid, a graph", {480, 272, kXrgb8888, kDepth24}, build_cluster},
    {"34-cluster-rgb565", "the same in 16 bits", {480, 272, kRgb565, kDepth16}, build_cluster},
    {"35-textured-cards", "nearest and bilinear in perspective", {200, 140, kXrgb8888, kDepth24}, build_textured_cards},
    {"36-texture-wraps", "repeat, clamp, mirror in both axes, an odd size", {196, 160}, build_texture_wraps},
    {"37-texture-levels",
     "levels from near to the horizon",
     {240, 136, kXrgb8888, kDepth24},
     build_texture_levels,
     kLevels},
    {"38-alpha-mask", "holes show what lies behind", {200, 140, kXrgb8888, kDepth24}, build_alpha_mask},
    {"39-blending", "panes and soft spots before and behind", {200, 140, kXrgb8888, kDepth24}, build_blending},
    {"40-texture-formats", "every format in odd sizes; points and lines", {200, 144}, build_texture_formats},
    {"41-globe", "a map under light", {160, 160, kXrgb8888, kDepth24}, build_globe},
    {"42-textures-rgb565", "textures on 16 bits", {200, 140, kRgb565, kDepth16}, build_textured_room, kStepOf5Bits},
};

}  // namespace

std::span<const Scene> all_scenes() { return kScenes; }

}  // namespace usuzumi::scenes
