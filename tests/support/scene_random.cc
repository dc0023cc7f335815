#include "tests/support/scene_random.h"

#include <bit>
#include <cmath>

#include "tests/support/scene_images.h"
#include "tests/support/scene_math.h"

namespace usuzumi::scenes {
namespace {

using namespace command;

class RandomScene {
 public:
  RandomScene(SceneBuilder& b, std::uint64_t seed, bool textured)
      : b_(b), random_(seed), texture_random_(seed ^ 0x7E5), textured_(textured),
        with_depth_(random_target(seed).depth != DepthFormat::kNone) {}

  void build() {
    if (textured_) b_.put(Clear{kClearColour | (with_depth_ ? kClearDepth : 0), rgba8(96, 64, 128), 1});
    else b_.clear_to_background();
    const std::uint32_t draws = 1 + below(5);
    for (std::uint32_t i = 0; i < draws; ++i) {
      set_windows();
      set_state();
      if (textured_) set_random_texture();
      draw(make_mesh());
      if (one_in(6)) b_.next_list();
    }
  }

 private:
  std::uint32_t below(std::uint32_t n) { return random_.next() % n; }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  float between(float low, float high) { return random_.between(low, high); }
  float width() const { return static_cast<float>(b_.width()); }
  float height() const { return static_cast<float>(b_.height()); }
  float whole(float low, float high) { return std::floor(between(low, high)); }

  void set_windows() {
    if (one_in(4))
      b_.put(SetScissor{below(b_.width()), below(b_.height()), 1 + below(b_.width()), 1 + below(b_.height())});
    if (one_in(4))
      b_.put(SetViewport{whole(-20, width() / 2), whole(-20, height() / 2), whole(1, width() * 1.5f + 1),
                         whole(1, height() * 1.5f + 1), between(0, 1), between(0, 1)});
  }

  void set_state() {
    SetRasterState raster;
    raster.shade_model = static_cast<ShadeModel>(below(2));
    raster.cull = one_in(2) ? CullMode::kNone : static_cast<CullMode>(below(3));
    raster.front_face = static_cast<FrontFace>(below(2));
    raster.depth_test = with_depth_ && !one_in(4) ? 1 : 0;
    raster.depth_function = one_in(8) ? DepthFunction::kAlways : static_cast<DepthFunction>(1 + below(2));
    raster.depth_write = one_in(5) ? 0 : 1;
    b_.put(raster);
    if (one_in(2)) {
      const Vec3 to_light = normalized({between(-1, 1), between(-1, 1), between(-1, 1)});
      b_.put(SetLight{one_in(4) ? 0u : 1u, to_light, {between(0, 1), between(0, 0.5f), between(0, 0.5f)},
                      {between(0, 1), between(0, 1), between(0, 1.5f)}});
    }
    in_perspective_ = one_in(2);
    if (in_perspective_) {
      b_.set_transform(perspective(0.5 + 0.15 * below(10), b_.aspect(), 0.5, 20) *
                       translation(between(-1, 1), between(-1, 1), between(-6, -1)) *
                       rotation_x(static_cast<double>(between(-3, 3))) *
                       rotation_y(static_cast<double>(between(-3, 3))));
    } else {
      b_.set_pixel_transform();
    }
  }

  // Of a sequence of its own, so that the rest of the scene is as without textures.
  void set_random_texture() {
    const auto below = [this](std::uint32_t n) { return texture_random_.next() % n; };
    const std::uint32_t width = 1 + below(60), height = 1 + below(40);
    const bool levels = below(2) == 0;
    const TexelImage image = levels ? hills(width, height) : noise(width, height, texture_random_);
    const auto format = static_cast<TextureFormat>(1 + below(3));
    const auto filter = static_cast<TextureFilter>(below(2));
    const auto wrap_s = static_cast<TextureWrap>(below(3)), wrap_t = static_cast<TextureWrap>(below(3));
    set_texture(b_, level_chain(image, levels ? 1 + below(static_cast<std::uint32_t>(std::bit_width(width))) : 1),
                format, filter, wrap_s, wrap_t);
    SetFragmentState state;
    state.alpha_test = below(4) == 0 ? 1 : 0;
    state.alpha_reference = below(256);
    state.blend = below(4) == 0 ? BlendMode::kAlpha : BlendMode::kNone;
    b_.put(state);
    coordinate_reach_ = below(3) == 0 ? 4.0f : 1.0f;
  }

  Vec3 place() {
    if (in_perspective_) {
      const float reach = one_in(10) ? 8.0f : 1.5f;
      return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
    }
    const float reach = one_in(8) ? 6.0f : 0.2f;  // beyond the target, in its sizes
    Vec3 p{between(-width() * reach, width() * (1 + reach)), between(-height() * reach, height() * (1 + reach)),
           between(-0.1f, 1.1f)};
    if (one_in(3)) {  // edges through pixel centres and corners
      p.x = std::floor(p.x * 2) / 2;
      p.y = std::floor(p.y * 2) / 2;
    }
    return p;
  }

  Mesh make_mesh() {
    Mesh mesh;
    const std::uint32_t vertices = 3 + below(one_in(3) ? 400 : 30);
    const bool small = !in_perspective_ && one_in(3);
    for (std::uint32_t i = 0; i < vertices; ++i) {
      const bool near_last = small && i > 0;
      mesh.positions.push_back(
          near_last ? mesh.positions.back() + Vec3{between(-15, 15), between(-15, 15), between(-0.1f, 0.1f)} : place());
      mesh.colours.push_back(Rgba8{random_.next()});
      mesh.normals.push_back(pack_normal(normalized({between(-1, 1), between(-1, 1), between(-1, 1)})));
      if (textured_) {
        const float s = texture_random_.between(-coordinate_reach_, coordinate_reach_);
        mesh.texture_coordinates.push_back({s, texture_random_.between(-coordinate_reach_, coordinate_reach_)});
      }
    }
    if (one_in(4)) mesh.colours.clear();
    if (one_in(3)) mesh.normals.clear();
    return mesh;
  }

  template <class Index>
  void draw_indexed(Topology topology, IndexFormat format, std::uint32_t vertices) {
    const std::uint32_t first = below(4), count = 1 + below(3 * vertices);
    std::vector<Index> indices(first + count);
    for (Index& index : indices) index = static_cast<Index>(below(vertices));
    b_.put(Draw{topology, format, b_.store(indices), first, count});
  }

  void draw(const Mesh& mesh) {
    const auto topology = static_cast<Topology>(static_cast<std::uint32_t>(Topology::kTriangles) + below(3));
    const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
    b_.set_streams(mesh, Rgba8{random_.next()});
    switch (below(4)) {
      case 0: draw_indexed<std::uint16_t>(topology, IndexFormat::kU16, vertices); break;
      case 1: draw_indexed<std::uint32_t>(topology, IndexFormat::kU32, vertices); break;
      default: b_.put(Draw{topology, IndexFormat::kNone, 0, 0, vertices}); break;
    }
  }

  SceneBuilder& b_;
  RandomSequence random_, texture_random_;
  bool textured_;
  float coordinate_reach_ = 1;
  bool with_depth_, in_perspective_ = false;
};

}  // namespace

TargetSpec random_target(std::uint64_t seed) {
  RandomSequence random(seed ^ 0x5EED);
  random.next();
  TargetSpec target;
  target.width = 1 + random.next() % 220;
  target.height = 1 + random.next() % 160;
  target.format = random.next() % 4 == 0 ? PixelFormat::kRgb565 : PixelFormat::kXrgb8888;
  target.depth = static_cast<DepthFormat>(random.next() % 3);
  target.row_padding_bytes = random.next() % 4 * 4;
  return target;
}

void build_random(SceneBuilder& b, std::uint64_t seed) { RandomScene(b, seed, false).build(); }

void build_random_textured(SceneBuilder& b, std::uint64_t seed) { RandomScene(b, seed, true).build(); }

}  // namespace usuzumi::scenes
