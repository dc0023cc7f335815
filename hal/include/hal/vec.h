// The few vector and matrix types that drawing data, firmware and engine share. Single precision, evaluation order as
// written: with -ffp-contract=off every processor computes the same bits.
#pragma once

#include <cmath>
#include <cstdint>

namespace usuzumi {

/// Three singles, 12 bytes, no padding: the layout of positions in drawing data.
struct Vec3 {
  float x = 0, y = 0, z = 0;
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};
static_assert(sizeof(Vec3) == 12);

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline bool is_finite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
/// The unit vector, or `fallback` where `a` is too short to have a direction.
inline Vec3 normalized(Vec3 a, Vec3 fallback = {0, 0, 1}) {
  const float l = length(a);
  return l > 0 ? Vec3{a.x / l, a.y / l, a.z / l} : fallback;
}

struct Vec4 {
  float x = 0, y = 0, z = 0, w = 0;
};

/// A place on a texture, 8 bytes: (0, 0) is the image's top left corner, (1, 1) its bottom right one; s runs right, t
/// down. The layout of texture coordinates in drawing data.
struct TexCoord {
  float s = 0, t = 0;
  friend constexpr bool operator==(const TexCoord&, const TexCoord&) = default;
};
static_assert(sizeof(TexCoord) == 8);

/// Row-major 4x4: clip = m * (x, y, z, 1), row r of the product is m[4r]x + m[4r+1]y + m[4r+2]z + m[4r+3].
struct Mat4 {
  float m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

constexpr Vec4 transform_point(const Mat4& a, Vec3 p) {
  return {a.m[0] * p.x + a.m[1] * p.y + a.m[2] * p.z + a.m[3], a.m[4] * p.x + a.m[5] * p.y + a.m[6] * p.z + a.m[7],
          a.m[8] * p.x + a.m[9] * p.y + a.m[10] * p.z + a.m[11],
          a.m[12] * p.x + a.m[13] * p.y + a.m[14] * p.z + a.m[15]};
}

constexpr Mat4 operator*(const Mat4& a, const Mat4& b) {
  Mat4 r;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      r.m[4 * i + j] = a.m[4 * i] * b.m[j] + a.m[4 * i + 1] * b.m[4 + j] + a.m[4 * i + 2] * b.m[8 + j] +
                       a.m[4 * i + 3] * b.m[12 + j];
  return r;
}

/// A colour as stored in drawing data: bytes R, G, B, A in rising address order (bits 0-7 are red).
struct Rgba8 {
  std::uint32_t bits = 0xFFFFFFFFu;
  constexpr std::uint32_t r() const { return bits & 0xFF; }
  constexpr std::uint32_t g() const { return (bits >> 8) & 0xFF; }
  constexpr std::uint32_t b() const { return (bits >> 16) & 0xFF; }
  constexpr std::uint32_t a() const { return bits >> 24; }
  friend constexpr bool operator==(Rgba8, Rgba8) = default;
};
constexpr Rgba8 rgba8(std::uint32_t r, std::uint32_t g, std::uint32_t b, std::uint32_t a = 255) {
  return {r | g << 8 | b << 16 | a << 24};
}

/// A unit normal in 32 bits: x, y, z as two's complement 10-bit fields at bits 0, 10, 20, each c / 511; bits 30-31
/// zero. Worst angular error about 0.1 degrees.
struct PackedNormal {
  std::uint32_t bits = 511u << 20;
  friend constexpr bool operator==(PackedNormal, PackedNormal) = default;
};
constexpr float unpack_normal_component(std::uint32_t bits, unsigned shift) {
  const auto c = static_cast<std::int32_t>(bits << (22 - shift)) >> 22;  // sign-extends ten bits
  return static_cast<float>(c < -511 ? -511 : c) * (1.0f / 511.0f);
}
constexpr Vec3 unpack(PackedNormal n) {
  return {unpack_normal_component(n.bits, 0), unpack_normal_component(n.bits, 10), unpack_normal_component(n.bits, 20)};
}
/// Components beyond [-1, 1] are clamped; rounds half away from zero.
constexpr PackedNormal pack_normal(Vec3 n) {
  auto field = [](float c) {
    const float clamped = c < -1 ? -1.0f : (c > 1 ? 1.0f : (c == c ? c : 0.0f));
    const auto q = static_cast<std::int32_t>(clamped * 511.0f + (clamped < 0 ? -0.5f : 0.5f));
    return static_cast<std::uint32_t>(q) & 0x3FFu;
  };
  return {field(n.x) | field(n.y) << 10 | field(n.z) << 20};
}

}  // namespace usuzumi
