// Triangle set-up: cull, bounding box, edge functions and planes, and the record put into the bins. See conventions.h for
// the signs and the fill rule.
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

/// A triangle on its way through set-up: positive area, corners in order.
struct SetupInput {
  const Vertex* v[3];
  const Vertex* provoking;
  std::int64_t area;
  PixelRect box;                        // clipped, x1 and y1 exclusive
  bool box_cuts;                        // clipping made the box smaller
  bool small;
  Shading shading;
};

class TriangleSetup {
 public:
  TriangleSetup(const DrawSetup& draw, std::uint32_t draw_index, Binner& binner)
      : d_(draw), draw_index_(static_cast<std::uint16_t>(draw_index)), binner_(binner) {}

  /// One triangle. `drawn` becomes true when it has area and is not culled. False: the pool is exhausted, nothing binned.
  [[gnu::always_inline]] bool add(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& provoking, bool may_cull, bool bin, bool& drawn) {
    const std::int64_t x1 = b.x - a.x, y1 = b.y - a.y, x2 = c.x - a.x, y2 = c.y - a.y;
    std::int64_t area = x1 * y2 - x2 * y1;
    if (area == 0) return true;
    if (may_cull && (area > 0 ? d_.cull_positive : d_.cull_negative)) return true;
    drawn = true;
    SetupInput in;
    const std::int32_t min_x = std::min({a.x, b.x, c.x}), max_x = std::max({a.x, b.x, c.x});
    const std::int32_t min_y = std::min({a.y, b.y, c.y}), max_y = std::max({a.y, b.y, c.y});
    // First and last pixel centres inside. A centre exactly on the right or bottom extreme is never covered.
    const PixelRect box{(min_x + kSubpixelHalf - 1) >> kSubpixelBits, (min_y + kSubpixelHalf - 1) >> kSubpixelBits,
                        (max_x + kSubpixelHalf - 1) >> kSubpixelBits, (max_y + kSubpixelHalf - 1) >> kSubpixelBits};
    in.box = {std::max(box.x0, d_.clip.x0), std::max(box.y0, d_.clip.y0), std::min(box.x1, d_.clip.x1), std::min(box.y1, d_.clip.y1)};
    if (in.box.empty() || !bin) return true;
    in.box_cuts = in.box.x0 != box.x0 || in.box.y0 != box.y0 || in.box.x1 != box.x1 || in.box.y1 != box.y1;
    in.small = max_x - min_x <= kMaxSpan * kSubpixelOne - kSubpixelOne && max_y - min_y <= kMaxSpan * kSubpixelOne - kSubpixelOne;
    const bool swap = area < 0;
    in.v[0] = &a;
    in.v[1] = swap ? &c : &b;
    in.v[2] = swap ? &b : &c;
    in.area = swap ? -area : area;
    in.provoking = &provoking;
    in.shading = choose_shading(a, b, c);
    return in.small ? put_small(in) : put_big(in);
  }

 private:
  [[gnu::always_inline]] Shading choose_shading(const Vertex& a, const Vertex& b, const Vertex& c) const {
    if (d_.flat) return Shading::kConstant;
    const auto range = [](float p, float q, float r) { return std::max({p, q, r}) - std::min({p, q, r}); };
    const float colour_range = std::max({range(a.red, b.red, c.red), range(a.green, b.green, c.green), range(a.blue, b.blue, c.blue)});
    if (colour_range == 0) return Shading::kConstant;
    const float u_min = std::min({a.u, b.u, c.u}), u_max = std::max({a.u, b.u, c.u});
    return affine_is_exact_enough(u_min, u_max, colour_range) ? Shading::kAffine : Shading::kPerspective;
  }

  /// Steps per pixel of four values given at the corners.
  struct Steps {
    F64x4 dx, dy;
  };
  [[gnu::always_inline]] static Steps steps(const SetupInput& in, F64x4 at0, F64x4 at1, F64x4 at2) {
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
    return F64x4{static_cast<double>(d_.lane_half[0]), static_cast<double>(d_.lane_half[1]), static_cast<double>(d_.lane_half[2]), 128};
  }
  [[gnu::always_inline]] static Steps attribute_steps(const SetupInput& in) {
    Steps s = steps(in, attributes(*in.v[0]), attributes(*in.v[1]), attributes(*in.v[2]));
    if (in.area < kSteepArea) flatten_steep(s);
    return s;
  }
  /// Larger areas cannot have a step of kMaxStep: 2^32 of depth times 2^23 of position, twice, times 256 per pixel.
  static constexpr std::int64_t kSteepArea = std::int64_t{1} << 24;
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
  static PerspectiveSetup perspective(const SetupInput& in) {
    const double u_scale = 1.0 / static_cast<double>(std::max({in.v[0]->u, in.v[1]->u, in.v[2]->u}));
    const F64x4 at0 = over_w(*in.v[0], u_scale);
    return {at0, steps(in, at0, over_w(*in.v[1], u_scale), over_w(*in.v[2], u_scale))};
  }

  std::uint32_t constant_pixel(const Vertex& v) const {
    const auto lane = [&](float value, int k) { return static_cast<std::uint32_t>(round_to_int(value)) + d_.lane_half[k]; };
    const std::uint32_t r = lane(v.red, 0), g = lane(v.green, 1), b = lane(v.blue, 2);
    if (d_.rgb565) return (r & 0xF800) | (g & 0xFC00) >> 5 | (b & 0xF800) >> 11;
    return 0xFF000000u | (r & 0xFF00) << 8 | (g & 0xFF00) | (b & 0xFF00) >> 8;
  }

  [[gnu::always_inline]] static TileRange tiles(const PixelRect& box) {
    return {box.x0 / kTileSize, box.y0 / kTileSize, (box.x1 - 1) / kTileSize, (box.y1 - 1) / kTileSize};
  }

  [[gnu::always_inline]] static std::uint32_t entry(EntryKind kind, Shading shading, std::uint32_t slot) {
    return (static_cast<std::uint32_t>(kind) + static_cast<std::uint32_t>(shading)) << kEntryKindShift | slot;
  }

  [[gnu::always_inline]] static std::int32_t fill_rule(std::int32_t a, std::int32_t b) { return a > 0 || (a == 0 && b > 0) ? 0 : 1; }

  [[gnu::always_inline]] bool put_small(const SetupInput& in) {
    const TileRange range = tiles(in.box);
    const std::uint32_t slots = in.shading == Shading::kPerspective ? 2 : 1;
    if (!binner_.reserve(slots, range)) return false;
    const std::uint32_t slot = binner_.take_record(slots);
    SmallTriangle& t = binner_.record<SmallTriangle>(slot);
    const std::int32_t origin_x = in.box.x0 * kSubpixelOne + kSubpixelHalf, origin_y = in.box.y0 * kSubpixelOne + kSubpixelHalf;
    for (int i = 0; i < 3; ++i) {
      const Vertex &p = *in.v[i], &q = *in.v[i < 2 ? i + 1 : 0];
      const std::int32_t a = p.y - q.y, b = q.x - p.x;  // |a|, |b| < 2^14; the products below 2^28 + 2^28
      t.edge[i] = (a * (origin_x - p.x) + b * (origin_y - p.y) - fill_rule(a, b)) >> kSubpixelBits;
      if (i == 2) continue;
      t.step[i][0] = static_cast<std::int16_t>(a);
      t.step[i][1] = static_cast<std::int16_t>(b);
    }
    const Vertex& v0 = *in.v[0];
    const double from_x = static_cast<double>(origin_x - v0.x) / kSubpixelOne, from_y = static_cast<double>(origin_y - v0.y) / kSubpixelOne;
    const Steps s = attribute_steps(in);
    const U64x4 base = round_to_words(attributes(v0) + halves() + s.dx * from_x + s.dy * from_y);
    const U64x4 dx = round_to_words(s.dx), dy = round_to_words(s.dy);
    t.planes.depth = static_cast<std::uint32_t>(base[3]);
    t.planes.depth_dx = static_cast<std::uint32_t>(dx[3]);
    t.planes.depth_dy = static_cast<std::uint32_t>(dy[3]);
    if (in.shading == Shading::kAffine) {
      t.planes.high = high(base);
      t.planes.low = low(base);
      t.planes.high_dx = high(dx);
      t.planes.low_dx = low(dx);
      t.planes.high_dy = high(dy);
      t.planes.low_dy = low(dy);
    }
    if (in.shading == Shading::kConstant) t.planes.high = constant_pixel(*in.provoking);
    if (in.shading == Shading::kPerspective) put_perspective(in, from_x, from_y, slot + 1);
    t.x = static_cast<std::uint16_t>(in.box.x0);
    t.y = static_cast<std::uint16_t>(in.box.y0);
    t.last_x = static_cast<std::uint8_t>(in.box.x1 - 1 - in.box.x0);
    t.last_y = static_cast<std::uint8_t>(in.box.y1 - 1 - in.box.y0);
    t.draw = static_cast<std::uint16_t>(draw_index_ | (in.box_cuts ? kClippedBox : 0));
    binner_.append(range, entry(EntryKind::kSmall, in.shading, slot));
    return true;
  }

  /// Lanes of ColourPlanes: high holds green, low holds red and blue.
  [[gnu::always_inline]] static std::uint32_t high(U64x4 v) { return static_cast<std::uint32_t>(v[1]) & 0xFFFF; }
  [[gnu::always_inline]] static std::uint32_t low(U64x4 v) { return pair(static_cast<std::int32_t>(v[2]), static_cast<std::int32_t>(v[0])); }

  [[gnu::noinline]] void put_perspective(const SetupInput& in, double from_x, double from_y, std::uint32_t slot) {
    PerspectivePlanes& planes = binner_.record<PerspectivePlanes>(slot);
    const PerspectiveSetup p = perspective(in);
    const F64x4 base = p.at0 + p.step.dx * from_x + p.step.dy * from_y;
    store(planes.value, __builtin_convertvector(base, F32x4));
    store(planes.dx, __builtin_convertvector(p.step.dx, F32x4));
    store(planes.dy, __builtin_convertvector(p.step.dy, F32x4));
  }

  [[gnu::noinline]] bool put_big(const SetupInput& in) {
    constexpr std::uint32_t kSlots = sizeof(BigTriangle) / kSlotBytes;
    const TileRange range = tiles(in.box);
    if (!binner_.reserve(kSlots, range)) return false;
    const std::uint32_t slot = binner_.take_record(kSlots);
    BigTriangle& t = binner_.record<BigTriangle>(slot);
    for (int i = 0; i < 3; ++i) {
      const Vertex &p = *in.v[i], &q = *in.v[i < 2 ? i + 1 : 0];
      t.a[i] = p.y - q.y;
      t.b[i] = q.x - p.x;
      t.edge[i] = std::int64_t{t.a[i]} * (kSubpixelHalf - p.x) + std::int64_t{t.b[i]} * (kSubpixelHalf - p.y) - fill_rule(t.a[i], t.b[i]);
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
      constexpr double kOne = 65536;  // |step| < 2^42, so 2^58: no overflow
      t.plane[k] = static_cast<std::uint64_t>(static_cast<std::int64_t>(base[k] * kOne));
      t.plane_dx[k] = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(s.dx[k] * kOne + 0.5)));
      t.plane_dy[k] = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(s.dy[k] * kOne + 0.5)));
    }
    if (in.shading == Shading::kPerspective) {
      const PerspectiveSetup p = perspective(in);
      store(t.perspective, p.at0);
      store(t.perspective_dx, p.step.dx);
      store(t.perspective_dy, p.step.dy);
    }
    t.constant_pixel = constant_pixel(*in.provoking);
    t.draw = draw_index_;
    t.shading = static_cast<std::uint16_t>(in.shading);
    binner_.append(range, entry(EntryKind::kBig, Shading::kConstant, slot));
    return true;
  }

  const DrawSetup& d_;
  std::uint16_t draw_index_;
  Binner& binner_;
};

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
