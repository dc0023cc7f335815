// Which layer of a chain a mesh is drawn in: by its size on the screen, its place there, its speed across it and the
// viewer's point of attention (US 6,396,952, p. 31 and 35, names the four and leaves the rule open; the rule is ours).
//
// Layers are real numbers: 1.25 is the middle layer a quarter of the way from layer 1 to layer 2. The rule asks how
// many faces the mesh is worth,
//     worth = diameter_px^2 / pixels_per_face * position * speed * attention,
// each factor in (0, 1], and takes the layer that has as many. Then hysteresis and the largest change a frame make the
// layer follow without trembling or jumping. No layer is coarser than the floor, which is the author's quota.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/layers/layer_chain.h"
#include "firmware/scene/view.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// A box around a mesh, model units.
struct Box {
  Vec3 low, high;
};

/// The smallest box; of no positions the origin.
Box box_of(std::span<const Vec3> positions);

/// Where a mesh is on the screen, pixels from the top left corner; measured on its box's eight corners, so that every
/// frame can afford it for every mesh.
struct ScreenExtent {
  float centre_x = 0, centre_y = 0;
  float diameter = 0;      // diagonal of the rectangle around the projected corners
  bool beyond_eye = false; // a corner is at or behind the viewer: as large as can be, and the rest is 0
};

ScreenExtent screen_extent(const Box& box, const View& view);

/// Defaults are for a cluster seen from 0.7 m, 0.15 mm a pixel; each is a matter of taste within a factor of two.
struct LayerChoiceSettings {
  /// Diameter^2 over faces. About twice the pixels of each face turned to the viewer, as the square around a round body
  /// holds 1.3 times its pixels and half of its faces are turned away. At 16 a face is about 4 pixels wide: below that,
  /// faces less are seen only in the outline.
  float pixels_per_face = 16;
  /// How much of its faces a mesh loses at the picture's corner against its middle, where a driver looks first.
  float position_weight = 0.25f;
  /// The speed, pixels a frame, that halves the faces: at 60 frames a second a mesh at this speed crosses a panel 1920
  /// pixels wide in a second, and the eye resolves half at best of what moves so fast.
  float speed_px = 32;
  /// How much of its faces a mesh loses half a picture's diagonal away from the point of attention, or farther.
  float attention_weight = 0.5f;
  /// Layers. What is asked for may tremble by this much either way, and the layer stands; larger than a camera's
  /// vibration moves it (a tenth of a layer is a change of size by a fortieth where layers fall to 60 %).
  float hysteresis = 0.1f;
  /// Layers a frame. A whole layer takes 32 frames, half a second at 60 frames a second. In a quarter of that, textures
  /// run across the screen so fast that a frame changes up to half as much as a switch of layers would.
  float largest_change = 1.0f / 32;
};

/// A point on the screen that the viewer attends to, set by the application; pixels from the top left corner.
struct Attention {
  bool set = false;
  float x = 0, y = 0;
};

/// What is remembered of a mesh from frame to frame.
struct LayerMemory {
  bool known = false;   // there was a frame before
  float layer = 0;
  bool placed = false;  // it was before the viewer's eye, so that its speed can be told
  float centre_x = 0, centre_y = 0;
};

/// The layer, possibly between two, that has `faces` faces: 0 for all of them or more, layer_count() - 1 for those of
/// the last layer or fewer. Falls as `faces` rises: between two layers in a straight line with their square root, which
/// is how many faces lie side by side, so that what shrinks on the screen does so evenly.
float layer_of_faces(const LayerChainView& chain, float faces);

/// The layer for this frame, in [0, floor]; `memory` is the mesh's. `floor` is the coarsest layer its author allows,
/// in [0, layer_count() - 1]. The first frame takes the layer at once.
float choose_layer(const LayerChainView& chain, const ScreenExtent& extent, const View& view,
                   const Attention& attention, const LayerChoiceSettings& settings, float floor, LayerMemory& memory);

}  // namespace usuzumi::firmware
