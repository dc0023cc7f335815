// Triangle set-up: cull, bounding box, edge functions and planes, and the record put into the bins. See conventions.h
// for the signs and the fill rule.
//
// Planes are worked out in double precision. Their numerators (differences of 24-bit values times differences of 23-bit
// positions) come out exact to a part in 2^52, so that even at the far end of a sliver the error stays below a quarter
// unit while a step is below 2^42; steeper ones (slivers of less than 1/16 square pixel across a large depth range) are
// taken as constant. Rounded steps and base are then used modulo their width, as conventions.h explains.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "gfx_subsystem/engine_soft/round.h"
#include "gfx_subsystem/engine_soft/simd.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

inline constexpr double kMaxStep = 4398046511104.0;            // 2^42
inline constexpr double kDoubleRoundingBias = 6755399441055744.0;  // 1.5 * 2^52: low mantissa bits hold the integer

[[gnu::always_inline]] inline U64x4 round_to_words(F64x4 v) { return bits_as<U64x4>(v + kDoubleRoundingBias); }

/// Largest and smallest of u tell whether colour interpolated linearly in the window is near enough to the perspective
/// one. With r = max / min the weights of the corners differ by at most (sqrt r - 1) / (sqrt r + 1) <= (r - 1) / 4 in
/// total, so colours differ by at most their range times that; half an 8-bit step is 128 lane units.
[[gnu::always_inline]] inline bool affine_is_exact_enough(float u_min, float u_max, float colour_range) {
  return colour_range * (u_max - u_min) <= (4.0f * 128.0f) * u_min;
}

/// The second half of a Vertex: x, y, then u and outcode, which are ignored.
[[gnu::always_inline]] inline I32x4 position_of(const Vertex& v) { return load<I32x4>(&v.x); }

/// A triangle that has area, is not culled and has a pixel centre in its clipped bounding box.
struct Candidate {
  const Vertex* v[3];        // positive area
  std::int64_t area;
  PixelRect box;             // clipped bounding box in pixels, x1 and y1 exclusive
  std::uint32_t primitive;   // of the draw
  std::uint32_t drawn_before;  // faces drawn before it, for a job that stops here
  bool swapped;              // v[1] and v[2] have changed places
  bool box_cuts;             // clipping made the box smaller
  bool small;

  const Vertex& provoking() const { return *v[swapped ? 1 : 2]; }
};

class TriangleSetup {
 public:
  TriangleSetup(const DrawSetup& draw, std::uint32_t draw_index, Binner& binner, const VertexStore& store)
      : d_(draw), draw_index_(static_cast<std::uint16_t>(draw_index)), binner_(binner), store_(store),
        clip_first_{draw.clip.x0, draw.clip.y0, 0, 0}, clip_end_{draw.clip.x1, draw.clip.y1, 0, 0} {}

  /// Fills in `out` and tells whether it is a candidate; without branches, since which triangles are is a matter of
  /// luck. `drawn` counts those with area that are not culled.
  [[gnu::always_inline]] bool examine(const Vertex& a, const Vertex& b, const Vertex& c, bool may_cull, Candidate& out,
                                      std::uint32_t& drawn) const {
    const std::int64_t x1 = b.x - a.x, y1 = b.y - a.y, x2 = c.x - a.x, y2 = c.y - a.y;
    const std::int64_t area = x1 * y2 - x2 * y1;
    const bool negative = area < 0;
    out.v[0] = &a;
    out.v[1] = negative ? &c : &b;
    out.v[2] = negative ? &b : &c;
    out.swapped = negative;
    out.area = negative ? -area : area;
    const I32x4 p = position_of(a), q = position_of(b), r = position_of(c);
    const I32x4 low = least(least(p, q), r), high = most(most(p, q), r);
    // First pixel centre inside and first beyond. A centre exactly on the right or bottom extreme is never covered.
    const I32x4 first = (low + (kSubpixelHalf - 1)) >> kSubpixelBits,
                end = (high + (kSubpixelHalf - 1)) >> kSubpixelBits;
    const I32x4 first_in = most(first, clip_first_), end_in = least(end, clip_end_);
    store(&out.box, __builtin_shufflevector(first_in, end_in, 0, 1, 4, 5));
    const I32x4 cut = (first_in - first) | (end - end_in), extent = high - low;
    out.box_cuts = (cut[0] | cut[1]) != 0;
    out.small = (extent[0] <= kMaxSmallExtent) & (extent[1] <= kMaxSmallExtent);
    const bool culled = may_cull & (negative ? d_.cull_negative : d_.cull_positive);
    const bool is_drawn = (area != 0) & !culled;
    drawn += is_drawn;
    const I32x4 size = end_in - first_in;
    return is_drawn & (size[0] > 0) & (size[1] > 0);
  }

  /// Flat triangles take the colour of `provoking`. False: the pool is exhausted, nothing binned.
  [[gnu::always_inline]] bool put(const Candidate& c, const Vertex& provoking) {
    if (d_.fragments) return put_fragments(c, provoking);
    const Shading shading = choose_shading(*c.v[0], *c.v[1], *c.v[2], 0);
    return c.small ? put_small<false>(c, shading, provoking) : put_big<false>(c, shading, provoking);
  }

 private:
  [[gnu::noinline]] bool put_fragments(const Candidate& c, const Vertex& provoking) {
    const Shading shading = choose_shading(
        *c.v[0], *c.v[1], *c.v[2], range(alpha_of(*c.v[0]), alpha_of(*c.v[1]), alpha_of(*c.v[2])));
    return c.small ? put_small<true>(c, shading, provoking) : put_big<true>(c, shading, provoking);
  }

  static float range(float p, float q, float r) { return std::max({p, q, r}) - std::min({p, q, r}); }
  float alpha_of(const Vertex& v) const { return store_.extra_of(v).alpha; }

  [[gnu::always_inline]] Shading choose_shading(const Vertex& a, const Vertex& b, const Vertex& c,
                                                float alpha_range) const {
    if (d_.flat) return Shading::kConstant;
    const float colour_range = std::max({range(a.red, b.red, c.red), range(a.green, b.green, c.green),
                                         range(a.blue, b.blue, c.blue), alpha_range});
    if (colour_range == 0) return Shading::kConstant;
    const float u_min = std::min({a.u, b.u, c.u}), u_max = std::max({a.u, b.u, c.u});
    return affine_is_exact_enough(u_min, u_max, colour_range) ? Shading::kAffine : Shading::kPerspective;
  }

  /// Steps per pixel of four values given at the corners.
  struct Steps {
    F64x4 dx, dy;
  };
  [[gnu::always_inline]] static Steps steps(const Candidate& in, F64x4 at0, F64x4 at1, F64x4 at2) {
    const Vertex &v0 = *in.v[0], &v1 = *in.v[1], &v2 = *in.v[2];
    const double per_pixel = static_cast<double>(kSubpixelOne) / static_cast<double>(in.area);
    const F64x4 d1 = at1 - at0, d2 = at2 - at0;
    const double x1 = v1.x - v0.x, y1 = v1.y - v0.y, x2 = v2.x - v0.x, y2 = v2.y - v0.y;
    return {(d1 * y2 - d2 * y1) * per_pixel, (d2 * x1 - d1 * x2) * per_pixel};
  }

  /// Red, green, blue in lane units and depth in 1/256, halves not included.
  [[gnu::always_inline]] static F64x4 attributes(const Vertex& v) {
    const F32x4 a = load<F32x4>(&v);
    return __builtin_convertvector(a, F64x4) * F64x4{1, 1, 1, 256};
  }
  [[gnu::always_inline]] F64x4 halves() const {
    return F64x4{static_cast<double>(d_.lane_half[0]), static_cast<double>(d_.lane_half[1]),
                 static_cast<double>(d_.lane_half[2]), 128};
  }
  [[gnu::always_inline]] static Steps attribute_steps(const Candidate& in) {
    Steps s = steps(in, attributes(*in.v[0]), attributes(*in.v[1]), attributes(*in.v[2]));
    if (in.area < (in.small ? kSteepAreaSmall : kSteepAreaBig)) flatten_steep(s);
    return s;
  }
  /// Larger areas cannot have a step of kMaxStep: 2^32 of depth times 2^14 (or 2^23) of position, twice, times 256 per
  /// pixel.
  static constexpr std::int64_t kSteepAreaSmall = std::int64_t{1} << 13, kSteepAreaBig = std::int64_t{1} << 22;
  [[gnu::always_inline]] static void flatten_steep(Steps& s) {
    const F64x4 x = s.dx < 0.0 ? -s.dx : s.dx, y = s.dy < 0.0 ? -s.dy : s.dy;
    const auto keep = (x <= kMaxStep) & (y <= kMaxStep);
    s.dx = keep ? s.dx : F64x4{};
    s.dy = keep ? s.dy : F64x4{};
  }

  static F64x4 over_w(const Vertex& v, double u_scale) {
    const double u = static_cast<double>(v.u) * u_scale;
    return F64x4{u, v.red * u, v.green * u, v.blue * u};
  }
  struct PerspectiveSetup {
    F64x4 at0;
    Steps step;
  };
  static double scale_of_u(const Candidate& in) {
    return 1.0 / static_cast<double>(std::max({in.v[0]->u, in.v[1]->u, in.v[2]->u}));
  }
  static PerspectiveSetup perspective(const Candidate& in) {
    const double u_scale = scale_of_u(in);
    const F64x4 at0 = over_w(*in.v[0], u_scale);
    return {at0, steps(in, at0, over_w(*in.v[1], u_scale), over_w(*in.v[2], u_scale))};
  }

  /// The repeats of the image before the one in which v lies; an even number of a mirrored one.
  static double whole_repeats(float v, command::TextureWrap wrap) {
    switch (wrap) {
      case command::TextureWrap::kRepeat: return std::floor(static_cast<double>(v));
      case command::TextureWrap::kMirror: return 2 * std::floor(static_cast<double>(v) / 2);
      case command::TextureWrap::kClamp: break;
    }
    return 0;
  }

  /// u, s, t and alpha, each times u. s and t begin in the first repeat at the first corner, where singles are finest.
  PerspectiveSetup texture(const Candidate& in) const {
    const double u_scale = scale_of_u(in);
    const VertexExtra& first = store_.extra_of(*in.v[0]);
    const double s0 = whole_repeats(first.s, d_.texture.wrap_s), t0 = whole_repeats(first.t, d_.texture.wrap_t);
    const auto at = [&](const Vertex& v) {
      const VertexExtra& e = store_.extra_of(v);
      const double u = static_cast<double>(v.u) * u_scale;
      return F64x4{u, (e.s - s0) * u, (e.t - t0) * u, e.alpha * u};
    };
    const F64x4 at0 = at(*in.v[0]);
    return {at0, steps(in, at0, at(*in.v[1]), at(*in.v[2]))};
  }

  /// Alpha in lane units, half included.
  PerspectiveSetup affine_alpha(const Candidate& in) const {
    const auto at = [&](const Vertex& v) { return F64x4{alpha_of(v), 0, 0, 0}; };
    const F64x4 at0 = at(*in.v[0]);
    Steps s = steps(in, at0, at(*in.v[1]), at(*in.v[2]));
    flatten_steep(s);
    return {at0 + F64x4{128, 0, 0, 0}, s};
  }

  std::uint32_t constant_pixel(const Vertex& v) const {
    const auto lane = [&](float value, int k) {
      return static_cast<std::uint32_t>(round_to_int(value)) + d_.lane_half[k];
    };
    const std::uint32_t r = lane(v.red, 0), g = lane(v.green, 1), b = lane(v.blue, 2);
    if (d_.rgb565) return (r & 0xF800) | (g & 0xFC00) >> 5 | (b & 0xF800) >> 11;
    return 0xFF000000u | (r & 0xFF00) << 8 | (g & 0xFF00) | (b & 0xFF00) >> 8;
  }

  /// The channels of a constant colour of fragments: green and alpha, or blue and red.
  std::uint32_t constant_high(const Vertex& v) const { return pair(channel(v.green), channel(alpha_of(v))); }
  static std::uint32_t constant_low(const Vertex& v) { return pair(channel(v.blue), channel(v.red)); }
  static std::int32_t channel(float lane_units) { return (round_to_int(lane_units) + 128) >> 8; }

  [[gnu::always_inline]] static TileRange tiles(const PixelRect& box) {
    return {box.x0 / kTileSize, box.y0 / kTileSize, (box.x1 - 1) / kTileSize, (box.y1 - 1) / kTileSize};
  }

  [[gnu::always_inline]] static std::uint32_t entry(EntryKind kind, Shading shading, std::uint32_t slot) {
    return (static_cast<std::uint32_t>(kind) + static_cast<std::uint32_t>(shading)) << kEntryKindShift | slot;
  }

  [[gnu::always_inline]] static std::int32_t fill_rule(std::int32_t a, std::int32_t b) {
    return a > 0 || (a == 0 && b > 0) ? 0 : 1;
  }

  /// Four words of a SmallTriangle at a time.
  template <bool kFragments>
  [[gnu::always_inline]] bool put_small(const Candidate& in, Shading shading, const Vertex& provoking) {
    const std::int32_t origin_x = in.box.x0 * kSubpixelOne + kSubpixelHalf,
                       origin_y = in.box.y0 * kSubpixelOne + kSubpixelHalf;

    // Corners' x and y, and those of the next corner: edges 0-1, 1-2, 2-0.
    const I32x4 p = position_of(*in.v[0]), q = position_of(*in.v[1]), r = position_of(*in.v[2]);
    const I32x4 pq = __builtin_shufflevector(p, q, 0, 4, 1, 5);
    const I32x4 x = __builtin_shufflevector(pq, r, 0, 1, 4, 4), y = __builtin_shufflevector(pq, r, 2, 3, 5, 5);
    const I32x4 a = y - __builtin_shufflevector(y, y, 1, 2, 0, 3), b = __builtin_shufflevector(x, x, 1, 2, 0, 3) - x;
    const I32x4 top_left = (a > 0) | ((a == 0) & (b > 0));
    // |a|, |b| < 2^14 and the origin is no further away; the products are below 2^28.
    const I32x4 edge = (a * (origin_x - x) + b * (origin_y - y) + ~top_left) >> kSubpixelBits;
    if (misses_small_box(in.box, edge, a, b)) return true;

    const TileRange range = tiles(in.box);
    const std::uint32_t slots = (kFragments ? 2 : 1) + (shading == Shading::kPerspective ? 1 : 0);
    if (!binner_.reserve(slots, range)) return false;
    const std::uint32_t slot = binner_.take_record(slots);
    std::byte* record = reinterpret_cast<std::byte*>(&binner_.record<SmallTriangle>(slot));
    const I32x4 step = (a & 0xFFFF) | b << 16;
    store(record, __builtin_shufflevector(edge, step, 0, 1, 2, 4));

    const Vertex& v0 = *in.v[0];
    const double from_x = static_cast<double>(origin_x - v0.x) / kSubpixelOne,
                 from_y = static_cast<double>(origin_y - v0.y) / kSubpixelOne;
    const Steps s = attribute_steps(in);
    const I32x4 base = low_words(round_to_words(attributes(v0) + halves() + s.dx * from_x + s.dy * from_y));
    const I32x4 dx = low_words(round_to_words(s.dx)), dy = low_words(round_to_words(s.dy));
    const I32x4 depth_steps = __builtin_shufflevector(dx, dy, 3, 3, 7, 7);
    const I32x4 step1_depth = __builtin_shufflevector(step, base, 1, 7, 1, 7);
    store(record + 16, __builtin_shufflevector(step1_depth, depth_steps, 0, 1, 4, 6));
    const I32x4 place{static_cast<std::int32_t>(pair(in.box.x0, in.box.y0)),
                      static_cast<std::int32_t>(
                          static_cast<std::uint32_t>((in.box.x1 - 1 - in.box.x0) | (in.box.y1 - 1 - in.box.y0) << 8) |
                          static_cast<std::uint32_t>(draw_index_ | (in.box_cuts ? kClippedBox : 0)) << 16),
                      0, 0};
    if (shading == Shading::kConstant) {
      if constexpr (kFragments)
        store(record + 32, I32x4{static_cast<std::int32_t>(constant_high(provoking)),
                                 static_cast<std::int32_t>(constant_low(provoking)), 0, 0});
      else store(record + 32, I32x4{static_cast<std::int32_t>(constant_pixel(provoking)), 0, 0, 0});
      store(record + 48, __builtin_shufflevector(place, place, 0, 0, 0, 1));
    } else {
      store(record + 32, __builtin_shufflevector(lanes_of(base), lanes_of(dx), 0, 1, 4, 5));
      store(record + 48, __builtin_shufflevector(lanes_of(dy), place, 0, 1, 4, 5));
    }
    if constexpr (kFragments) {
      Planes& planes = binner_.record<SmallTriangle>(slot).planes;
      if (shading == Shading::kAffine) put_alpha(in, from_x, from_y, planes);
      TexturePlanes& t = binner_.record<TexturePlanes>(slot + 1);
      put_planes(texture(in), from_x, from_y, t);
      t.shading = shading;
    }
    if (shading == Shading::kPerspective)
      put_planes(perspective(in), from_x, from_y, binner_.record<PerspectivePlanes>(slot + (kFragments ? 2 : 1)));
    binner_.append(range, kFragments ? entry(EntryKind::kFragment, Shading::kConstant, slot)
                                     : entry(EntryKind::kSmall, shading, slot));
    return true;
  }

  void put_alpha(const Candidate& in, double from_x, double from_y, Planes& planes) const {
    const PerspectiveSetup a = affine_alpha(in);
    const auto lane = [](F64x4 v) { return static_cast<std::uint32_t>(low_words(round_to_words(v))[0]) << 16; };
    planes.high |= lane(a.at0 + a.step.dx * from_x + a.step.dy * from_y);
    planes.high_dx |= lane(a.step.dx);
    planes.high_dy |= lane(a.step.dy);
  }

  /// True when the triangle covers none of the pixels of a box of up to 2 x 2: about every third of the tiniest ones.
  [[gnu::always_inline]] static bool misses_small_box(const PixelRect& box, I32x4 edge, I32x4 a, I32x4 b) {
    if (box.x1 - box.x0 > 2 || box.y1 - box.y0 > 2) return false;
    const auto outside = [](I32x4 e) { return e[0] | e[1] | e[2]; };  // negative when the pixel is
    return (outside(edge) & outside(edge + a) & outside(edge + b) & outside(edge + a + b)) < 0;
  }

  [[gnu::always_inline]] static I32x4 low_words(U64x4 v) { return __builtin_convertvector(v, I32x4); }

  /// From red, green, blue, depth: the words "high" and "low" of Planes, first and second.
  [[gnu::always_inline]] static I32x4 lanes_of(I32x4 v) {
    const I16x8 halves = bits_as<I16x8>(v);
    return bits_as<I32x4>(__builtin_shufflevector(halves, I16x8{}, 2, 8, 4, 0, 8, 8, 8, 8));
  }

  template <class Record>
  [[gnu::noinline]] static void put_planes(const PerspectiveSetup& p, double from_x, double from_y, Record& planes) {
    const F64x4 base = p.at0 + p.step.dx * from_x + p.step.dy * from_y;
    store(planes.value, __builtin_convertvector(base, F32x4));
    store(planes.dx, __builtin_convertvector(p.step.dx, F32x4));
    store(planes.dy, __builtin_convertvector(p.step.dy, F32x4));
  }

  template <bool kFragments>
  [[gnu::noinline]] bool put_big(const Candidate& in, Shading shading, const Vertex& provoking) {
    constexpr std::uint32_t kSlots = kBigSlots + (kFragments ? kBigTextureSlots : 0);
    const TileRange range = tiles(in.box);
    if (!binner_.reserve(kSlots, range)) return false;
    const std::uint32_t slot = binner_.take_record(kSlots);
    BigTriangle& t = binner_.record<BigTriangle>(slot);
    for (int i = 0; i < 3; ++i) {
      const Vertex &p = *in.v[i], &q = *in.v[i < 2 ? i + 1 : 0];
      t.a[i] = p.y - q.y;
      t.b[i] = q.x - p.x;
      t.edge[i] = std::int64_t{t.a[i]} * (kSubpixelHalf - p.x) + std::int64_t{t.b[i]} * (kSubpixelHalf - p.y) -
                  fill_rule(t.a[i], t.b[i]);
    }
    t.x = static_cast<std::uint16_t>(in.box.x0);
    t.y = static_cast<std::uint16_t>(in.box.y0);
    t.last_x = static_cast<std::uint16_t>(in.box.x1 - 1);
    t.last_y = static_cast<std::uint16_t>(in.box.y1 - 1);
    const Vertex& v0 = *in.v[0];
    t.from_x = v0.x;
    t.from_y = v0.y;
    const Steps s = attribute_steps(in);
    const F64x4 base = attributes(v0) + halves();
    for (int k = 0; k < 4; ++k) {
      t.plane[k] = plane_value(base[k]);
      t.plane_dx[k] = plane_step(s.dx[k]);
      t.plane_dy[k] = plane_step(s.dy[k]);
    }
    if (shading == Shading::kPerspective) {
      const PerspectiveSetup p = perspective(in);
      store(t.perspective, p.at0);
      store(t.perspective_dx, p.step.dx);
      store(t.perspective_dy, p.step.dy);
    }
    t.draw = draw_index_;
    t.shading = static_cast<std::uint16_t>(kFragments ? Shading::kFragment : shading);
    if constexpr (kFragments) {
      t.constant_pixel = constant_high(provoking);
      put_big_texture(in, shading, provoking, binner_.record<BigTexture>(slot + kBigSlots));
    } else {
      t.constant_pixel = constant_pixel(provoking);
    }
    binner_.append(range, entry(EntryKind::kBig, Shading::kConstant, slot));
    return true;
  }

  void put_big_texture(const Candidate& in, Shading shading, const Vertex& provoking, BigTexture& out) const {
    const PerspectiveSetup p = texture(in);
    store(out.value, p.at0);
    store(out.dx, p.step.dx);
    store(out.dy, p.step.dy);
    const PerspectiveSetup a = affine_alpha(in);
    out.alpha = plane_value(a.at0[0]);
    out.alpha_dx = plane_step(a.step.dx[0]);
    out.alpha_dy = plane_step(a.step.dy[0]);
    out.shading = shading;
    out.constant_low = constant_low(provoking);
  }

  /// A big triangle's plane, in 1/65536 unit. |step| < 2^42, so 2^58: no overflow.
  static std::uint64_t plane_value(double v) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(v * 65536));
  }
  static std::uint64_t plane_step(double v) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v * 65536 + 0.5)));
  }

  static constexpr std::int32_t kMaxSmallExtent = (kMaxSpan - 1) * kSubpixelOne;

  const DrawSetup& d_;
  std::uint16_t draw_index_;
  Binner& binner_;
  const VertexStore& store_;
  I32x4 clip_first_, clip_end_;
};

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
