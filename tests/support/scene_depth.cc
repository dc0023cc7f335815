// Scenes of the depth test.
#include "tests/support/scene_functions.h"
#include "tests/support/scene_math.h"

namespace usuzumi::scenes {
namespace {

using namespace command;

constexpr Rgba8 kRed = rgba8(230, 60, 50), kGreen = rgba8(70, 200, 90), kBlue = rgba8(60, 110, 230);

void use_depth(SceneBuilder& b, DepthFunction function, bool write = true) {
  SetRasterState raster;
  raster.depth_test = 1;
  raster.depth_function = function;
  raster.depth_write = write ? 1 : 0;
  b.put(raster);
}

void rectangle(SceneBuilder& b, float x, float y, float width, float height, float depth, Rgba8 colour) {
  b.draw_mesh(
      convex({{x, y, depth}, {x, y + height, depth}, {x + width, y + height, depth}, {x + width, y, depth}}, colour));
}

}  // namespace

// For less, less-or-equal and always: a rectangle at 0.5, then one in front, one at the same depth and one behind.
void build_depth_functions(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  const DepthFunction functions[] = {DepthFunction::kLess, DepthFunction::kLessEqual, DepthFunction::kAlways};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const float x = 6 + 60 * static_cast<float>(i);
    use_depth(b, functions[i]);
    rectangle(b, x, 6, 36, 100, 0.5f, rgba8(200, 200, 200));
    rectangle(b, x + 12, 14, 36, 20, 0.25f, kRed);
    rectangle(b, x + 12, 44, 36, 20, 0.5f, kGreen);
    rectangle(b, x + 12, 74, 36, 20, 0.75f, kBlue);
  }
}

// Depth compared but not written, then neither compared nor written; a later rectangle tells what was.
void build_depth_write(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  use_depth(b, DepthFunction::kLess, false);
  rectangle(b, 6, 6, 50, 50, 0.25f, kRed);
  SetRasterState no_test;  // writes no depth either
  b.put(no_test);
  rectangle(b, 40, 40, 50, 50, 0.25f, kGreen);
  use_depth(b, DepthFunction::kLess);
  rectangle(b, 24, 24, 50, 50, 0.5f, kBlue);
  rectangle(b, 62, 10, 30, 80, 0.75f, rgba8(255, 176, 0));
  // A clear of depth alone, within a scissor, lets the last one through there.
  b.put(SetScissor{30, 30, 20, 20});
  b.put(Clear{kClearDepth, {}, 1});
  b.put(SetScissor{0, 0, b.width(), b.height()});
  rectangle(b, 10, 34, 80, 10, 0.9f, rgba8(250, 250, 250));
}

// Three blades that pierce each other: the lines where they meet come from depths alone.
void build_interpenetrating(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  use_depth(b, DepthFunction::kLess);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const double angle = 2 * kPi * i / 3 + 0.2;
    const Vec3 along{static_cast<float>(cosine(angle)), static_cast<float>(sine(angle)), 0},
        across{-along.y, along.x, 0};
    const Vec3 centre{80, 80, 0.5f}, tilt{0, 0, 0.4f};
    const Rgba8 colour = i == 0 ? kRed : (i == 1 ? kGreen : kBlue);
    b.draw_mesh(convex({centre + along * 74 + tilt, centre + across * 30 - along * 50 - tilt,
                        centre - across * 30 - along * 50 - tilt},
                       colour));
  }
}

// Steps of depth that 16 or 24 bits tell apart: every rectangle is 2 / 65535 before the one below it.
void build_depth_steps(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  use_depth(b, DepthFunction::kLess);
  for (std::uint32_t i = 0; i < 12; ++i) {
    const std::uint32_t place = i * 5 % 12;  // not in the order of depth
    const float at = static_cast<float>(place);
    rectangle(b, 6 + 7 * at, 6 + 6 * at, 40, 40, 0.5f - at * (2.0f / 65535.0f), colour_wheel(place / 12.0));
  }
  // Tilted, so that it cuts through others; the cut is not where the rectangles lie.
  b.draw_mesh(convex({{4, 120, 0.9f}, {60, 124, 0.1f}, {124, 92, 0.9f}}, rgba8(250, 250, 250)));
}

}  // namespace usuzumi::scenes
