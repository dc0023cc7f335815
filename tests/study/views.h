// A model as the device shows it from all around, and how much two such pictures differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/scene/camera.h"
#include "hal/vec.h"
#include "sim/image/image.h"
#include "sim/pack/model.h"

namespace usuzumi::study {

/// The directions from which a model is looked at: through the middles of a cube's 6 sides and 12 edges and through
/// its 8 corners. Unit length, in a fixed order.
std::vector<Vec3> view_directions();

/// What no model shows where it is: a pixel of this colour is not covered.
inline constexpr Rgba8 kNothing = rgba8(128, 124, 132);

/// Pixels each way.
struct PictureSize {
  std::uint32_t width = 0, height = 0;
};

/// The model's box, which holds every picture of it and of what is thinned from it.
firmware::Bounds bounds_of(const sim::Model& model);

/// `model` packed, booted on the desk machine and drawn whole, once for each camera. Throws sim::Error.
std::vector<sim::Image> draw(const sim::Model& model, std::span<const firmware::Camera> cameras, PictureSize size,
                             Rgba8 background = kNothing);

/// Cameras that look at the middle of `bounds` from `directions`, from where the box fits whichever way it is turned
/// around the y axis; from straight above and below as near to it as firmware::orbit() goes.
std::vector<firmware::Camera> cameras_around(const firmware::Bounds& bounds, std::span<const Vec3> directions,
                                             float aspect);

/// How much the colours of two pictures of one size differ, 0 .. 255, over the pixels that either covers.
struct ColourDifference {
  double sum = 0;  // over pixels, of the mean over the channels
  std::size_t pixels = 0;
  double mean() const { return pixels > 0 ? sum / static_cast<double>(pixels) : 0.0; }
};
ColourDifference colour_difference(const sim::Image& a, const sim::Image& b, Rgba8 background = kNothing);
/// The same over all pictures, each pixel counting alike.
ColourDifference colour_difference(std::span<const sim::Image> a, std::span<const sim::Image> b);

}  // namespace usuzumi::study
