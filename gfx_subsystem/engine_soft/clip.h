// Clipping of the primitives that need it: near and far plane, and the guard band's four sides.
//
// Everything else is left to the raster: it never visits a pixel outside the clip rectangle. A new vertex on a plane is
// always computed from the end inside towards the end outside, so that two triangles sharing an edge get the same
// vertex.
#pragma once

#include "gfx_subsystem/engine_soft/draw_setup.h"

namespace usuzumi::gfx::soft {

struct ClipVertex {
  Vec4 position;     // clip space
  float colour[3];   // lane units
  VertexExtra extra;
};

/// A triangle cut by six planes has at most nine corners.
inline constexpr int kMaxClippedCorners = 9;

struct ClippedPolygon {
  PlacedVertex corner[kMaxClippedCorners];
  int corners = 0;   // 0: nothing is left
};

/// Cuts a triangle whose corners are finite.
ClippedPolygon clip_triangle(const DrawSetup& draw, const ClipVertex (&corner)[3]);

/// Cuts a segment; false when nothing is left.
bool clip_segment(const DrawSetup& draw, const ClipVertex (&end)[2], PlacedVertex (&out)[2]);

}  // namespace usuzumi::gfx::soft
