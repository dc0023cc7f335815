#include "firmware/layers/layer_choice.h"

#include <cmath>

namespace usuzumi::firmware {
namespace {

/// Pixels. So near the eye that corners are thrown about, and later squares would not stay finite.
constexpr float kLargestDiameter = 1e9f;

float clamped(float v, float low, float high) { return v > low ? (v < high ? v : high) : low; }  // NaN becomes low

float distance(float x, float y) { return std::sqrt(x * x + y * y); }

/// Falls in a straight line from 1 where `away` is 0 to 1 - weight where it is 1 or more.
float falling(float weight, float away) { return 1 - clamped(weight, 0, 1) * clamped(away, 0, 1); }

float worth_in_faces(const ScreenExtent& extent, const View& view, const Attention& attention,
                     const LayerChoiceSettings& settings, const LayerMemory& memory) {
  const auto width = static_cast<float>(view.width), height = static_cast<float>(view.height);
  const float half_diagonal = distance(width, height) * 0.5f;
  if (!(settings.pixels_per_face > 0) || !(half_diagonal > 0)) return 0;
  float worth = extent.diameter * extent.diameter / settings.pixels_per_face;
  const float off_middle = distance(extent.centre_x - width * 0.5f, extent.centre_y - height * 0.5f);
  worth *= falling(settings.position_weight, off_middle / half_diagonal);
  if (attention.set) {
    const float off = distance(extent.centre_x - attention.x, extent.centre_y - attention.y);
    worth *= falling(settings.attention_weight, off / half_diagonal);
  }
  if (memory.placed && settings.speed_px > 0) {
    const float speed = distance(extent.centre_x - memory.centre_x, extent.centre_y - memory.centre_y);
    worth *= settings.speed_px / (settings.speed_px + speed);
  }
  return worth;
}

/// Play, as between two gear wheels: the layer follows what is asked for at a distance of at most `play`. The ends are
/// taken exactly, so that a mesh that asks for all of its faces gets them.
float with_hysteresis(float asked, float held, float play, float floor) {
  if (asked <= 0) return 0;
  if (asked >= floor) return floor;
  if (asked > held + play) return asked - play;
  if (asked < held - play) return asked + play;
  return held;
}

}  // namespace

Box box_of(std::span<const Vec3> positions) {
  if (positions.empty()) return {};
  Box box{positions[0], positions[0]};
  for (const Vec3 p : positions) {
    box.low = {p.x < box.low.x ? p.x : box.low.x, p.y < box.low.y ? p.y : box.low.y, p.z < box.low.z ? p.z : box.low.z};
    box.high = {p.x > box.high.x ? p.x : box.high.x, p.y > box.high.y ? p.y : box.high.y,
                p.z > box.high.z ? p.z : box.high.z};
  }
  return box;
}

ScreenExtent screen_extent(const Box& box, const View& view) {
  ScreenExtent extent;
  float low_x = 0, low_y = 0, high_x = 0, high_y = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3 corner{(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
                      (i & 4) != 0 ? box.high.z : box.low.z};
    const Vec4 clip = transform_point(view.model_to_clip, corner);
    if (!(clip.w > 0)) {
      extent.beyond_eye = true;
      return extent;
    }
    const float x = (1 + clip.x / clip.w) * 0.5f * static_cast<float>(view.width);
    const float y = (1 - clip.y / clip.w) * 0.5f * static_cast<float>(view.height);
    low_x = i == 0 || x < low_x ? x : low_x;
    high_x = i == 0 || x > high_x ? x : high_x;
    low_y = i == 0 || y < low_y ? y : low_y;
    high_y = i == 0 || y > high_y ? y : high_y;
  }
  const float diameter = distance(high_x - low_x, high_y - low_y);
  if (!(diameter <= kLargestDiameter)) return {.beyond_eye = true};
  extent.centre_x = (low_x + high_x) * 0.5f;
  extent.centre_y = (low_y + high_y) * 0.5f;
  extent.diameter = diameter;
  return extent;
}

float layer_of_faces(const LayerChainView& chain, float faces) {
  const auto layers = chain.layers();
  if (faces >= static_cast<float>(layers[0].faces)) return 0;
  for (std::size_t n = 1; n < layers.size(); ++n) {
    const auto above = static_cast<float>(layers[n - 1].faces), below = static_cast<float>(layers[n].faces);
    if (!(faces >= below)) continue;
    const float most = std::sqrt(above), least = std::sqrt(below);
    if (!(most > least)) return static_cast<float>(n);  // of millions of faces, neighbours have one root
    return static_cast<float>(n - 1) + (most - std::sqrt(faces)) / (most - least);
  }
  return static_cast<float>(layers.size() - 1);
}

float choose_layer(const LayerChainView& chain, const ScreenExtent& extent, const View& view,
                   const Attention& attention, const LayerChoiceSettings& settings, float floor, LayerMemory& memory) {
  const float coarsest = clamped(floor, 0, static_cast<float>(chain.layer_count() - 1));
  float asked = 0;
  if (!extent.beyond_eye)
    asked = clamped(layer_of_faces(chain, worth_in_faces(extent, view, attention, settings, memory)), 0, coarsest);
  float layer = asked;
  if (memory.known) {
    const float held = clamped(memory.layer, 0, coarsest);  // a floor that has risen binds at once
    layer = with_hysteresis(asked, held, settings.hysteresis, coarsest);
    layer = clamped(layer, held - settings.largest_change, held + settings.largest_change);
  }
  memory = {true, clamped(layer, 0, coarsest), !extent.beyond_eye, extent.centre_x, extent.centre_y};
  return memory.layer;
}

}  // namespace usuzumi::firmware
