// Vertex stage: model space to snapped window positions, light, outcodes; kLanes vertices at a time.
#pragma once

#include "gfx_subsystem/engine_soft/draw_setup.h"
#include "gfx_subsystem/engine_soft/simd.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// Meaningless, but defined, beyond the guard band: such vertices carry an outcode and are clipped.
[[gnu::always_inline]] inline I32 round_lanes(F32 v) {
  return bits_as<I32>(bits_as<U32>(v + kRoundingBias) - static_cast<std::uint32_t>(kRoundingBits));
}

/// v, or the limit; the limit as well where v is not a number.
[[gnu::always_inline]] inline F32 at_most(F32 v, float limit) { return v < limit ? v : splat_f(limit); }
[[gnu::always_inline]] inline F32 at_least(F32 v, float limit) { return v > limit ? v : splat_f(limit); }

struct LaneColour {
  F32 red, green, blue;  // 0..255
};

template <class T>
[[gnu::always_inline]] inline T fetch(const std::byte* stream, std::uint32_t stride, std::uint32_t vertex,
                                      std::uint32_t offset) {
  T v;
  std::memcpy(&v, stream + std::size_t{stride} * vertex + offset, sizeof v);
  return v;
}

[[gnu::always_inline]] inline LaneColour base_colour(const DrawSetup& d, const std::uint32_t* vertex) {
  U32 c = splat_u(d.streams.constant_colour.bits);
  if (d.colours != nullptr)
    for (int l = 0; l < kLanes; ++l) c[l] = fetch<std::uint32_t>(d.colours, d.streams.colour_stride, vertex[l], 0);
  return {__builtin_convertvector(bits_as<I32>(c & 0xFF), F32),
          __builtin_convertvector(bits_as<I32>(c >> 8 & 0xFF), F32),
          __builtin_convertvector(bits_as<I32>(c >> 16 & 0xFF), F32)};
}

[[gnu::always_inline]] inline F32 normal_component(U32 packed, unsigned shift) {
  const I32 c = bits_as<I32>(packed << (22 - shift)) >> 22;
  return __builtin_convertvector(c < -511 ? splat(-511) : c, F32) * (1.0f / 511.0f);
}

[[gnu::always_inline]] inline void light(const DrawSetup& d, const std::uint32_t* vertex, LaneColour& colour) {
  U32 n{};
  for (int l = 0; l < kLanes; ++l) n[l] = fetch<std::uint32_t>(d.normals, d.streams.normal_stride, vertex[l], 0);
  const F32 toward = at_least(normal_component(n, 0) * d.to_light.x + normal_component(n, 10) * d.to_light.y +
                              normal_component(n, 20) * d.to_light.z, 0);
  colour.red *= at_most(d.ambient.x + d.diffuse.x * toward, 1);
  colour.green *= at_most(d.ambient.y + d.diffuse.y * toward, 1);
  colour.blue *= at_most(d.ambient.z + d.diffuse.z * toward, 1);
}

struct LanePosition {
  F32 x, y, z, w;
};

/// The same operations in the same order as transform_point().
[[gnu::always_inline]] inline LanePosition to_clip(const DrawSetup& d, const std::uint32_t* vertex) {
  F32 x{}, y{}, z{};
  for (int l = 0; l < kLanes; ++l) {
    x[l] = fetch<float>(d.positions, d.streams.position_stride, vertex[l], 0);
    y[l] = fetch<float>(d.positions, d.streams.position_stride, vertex[l], 4);
    z[l] = fetch<float>(d.positions, d.streams.position_stride, vertex[l], 8);
  }
  const float* m = d.transform.m;
  return {m[0] * x + m[1] * y + m[2] * z + m[3], m[4] * x + m[5] * y + m[6] * z + m[7],
          m[8] * x + m[9] * y + m[10] * z + m[11], m[12] * x + m[13] * y + m[14] * z + m[15]};
}

/// Every comparison is written so that NaN counts as outside.
[[gnu::always_inline]] inline I32 outcodes(const DrawSetup& d, const LanePosition& p) {
  const auto outside = [](I32 inside, std::uint32_t code) { return ~inside & static_cast<std::int32_t>(code); };
  const auto magnitude = [](F32 v) { return bits_as<F32>(bits_as<I32>(v) & 0x7FFFFFFF); };
  const F32 ax = magnitude(p.x), ay = magnitude(p.y), az = magnitude(p.z);
  return outside(p.x >= -p.w, kOutsideLeft) | outside(p.x <= p.w, kOutsideRight) |
         outside(p.y >= -p.w, kOutsideBottom) | outside(p.y <= p.w, kOutsideTop) | outside(p.z >= -p.w, kOutsideNear) |
         outside(p.z <= p.w, kOutsideFar) |
         outside((ax <= p.w * d.guard[0]) & (ay <= p.w * d.guard[1]) & (p.w >= kMinClipW), kOutsideGuard) |
         outside(
             (ax <= kMaxClipValue) & (ay <= kMaxClipValue) & (az <= kMaxClipValue) & (magnitude(p.w) <= kMaxClipValue),
             kNotANumber);
}

/// Writes four fields of `count` <= kLanes vertices, `offset` bytes into each.
[[gnu::always_inline]] inline void store_fields(Vertex* out, int count, int offset, F32 a, F32 b, F32 c, F32 d) {
  const auto four = [](F32 v, auto part) {
    constexpr int k = decltype(part)::value * 4;
    if constexpr (kLanes == 4) return v; else return __builtin_shufflevector(v, v, k, k + 1, k + 2, k + 3);
  };
  const auto store_four = [&](auto part) {
    constexpr int k = decltype(part)::value * 4;
    const F32x4 p = four(a, part), q = four(b, part), r = four(c, part), s = four(d, part);
    const F32x4 pq_low = __builtin_shufflevector(p, q, 0, 4, 1, 5), pq_high = __builtin_shufflevector(p, q, 2, 6, 3, 7);
    const F32x4 rs_low = __builtin_shufflevector(r, s, 0, 4, 1, 5), rs_high = __builtin_shufflevector(r, s, 2, 6, 3, 7);
    const F32x4 row[4] = {
        __builtin_shufflevector(pq_low, rs_low, 0, 1, 4, 5), __builtin_shufflevector(pq_low, rs_low, 2, 3, 6, 7),
        __builtin_shufflevector(pq_high, rs_high, 0, 1, 4, 5), __builtin_shufflevector(pq_high, rs_high, 2, 3, 6, 7)};
    for (int l = 0; l < 4; ++l)
      if (k + l < count) store(reinterpret_cast<std::byte*>(out + k + l) + offset, row[l]);
  };
  store_four(std::integral_constant<int, 0>{});
  if constexpr (kLanes >= 8) store_four(std::integral_constant<int, 1>{});
  if constexpr (kLanes >= 16) {
    store_four(std::integral_constant<int, 2>{});
    store_four(std::integral_constant<int, 3>{});
  }
}

/// Vertices vertex[0 .. kLanes - 1] of the streams; the first `count` are written.
[[gnu::always_inline]] inline void transform_lanes(const DrawSetup& d, const std::uint32_t* vertex, int count,
                                                   Vertex* out) {
  LaneColour colour = base_colour(d, vertex);
  if (d.normals != nullptr) light(d, vertex, colour);
  const LanePosition p = to_clip(d, vertex);
  const F32 u = 1.0f / p.w;
  const F32 depth = at_most(at_least((p.z * u) * d.scale[2] + d.offset[2], 0), 1) * d.depth_limit;
  store_fields(out, count, 0, colour.red * d.lane_scale[0], colour.green * d.lane_scale[1],
               colour.blue * d.lane_scale[2], depth);
  store_fields(out, count, 16, bits_as<F32>(round_lanes((p.x * u) * d.scale[0] + d.offset[0])),
               bits_as<F32>(round_lanes((p.y * u) * d.scale[1] + d.offset[1])), u, bits_as<F32>(outcodes(d, p)));
}

/// `source(i)` is the stream's number of the i-th vertex wanted.
template <class Source>
void transform_vertices(const DrawSetup& d, std::uint32_t count, Source source, Vertex* out) {
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    std::uint32_t vertex[kLanes];
    const std::uint32_t left = count - i;
    for (std::uint32_t l = 0; l < kLanes; ++l) vertex[l] = source(i + (l < left ? l : left - 1));
    transform_lanes(d, vertex, static_cast<int>(left < kLanes ? left : kLanes), out + i);
  }
}

/// Within the limit; 0 where not a number.
inline float held_coordinate(float v) {
  return v != v ? 0.0f : std::clamp(v, -kMaxTextureCoordinate, kMaxTextureCoordinate);
}

/// As transform_vertices(): what the fragments of the same vertices need.
template <class Source>
void fetch_extras(const DrawSetup& d, std::uint32_t count, Source source, VertexExtra* out) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t vertex = source(i);
    TexCoord c;
    if (d.texture_coordinates != nullptr)
      c = fetch<TexCoord>(d.texture_coordinates, d.streams.texture_coordinate_stride, vertex, 0);
    const std::uint32_t colour = d.colours == nullptr
                                     ? d.streams.constant_colour.bits
                                     : fetch<std::uint32_t>(d.colours, d.streams.colour_stride, vertex, 0);
    out[i] = {held_coordinate(c.s), held_coordinate(c.t), static_cast<float>((colour >> 24) << 8)};
  }
}

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
