#include "firmware/simplify/attributes.h"

namespace usuzumi::firmware {
namespace {

std::uint32_t mix_channel(std::uint32_t a, std::uint32_t b, float t) {
  const float fa = static_cast<float>(a), fb = static_cast<float>(b);
  return static_cast<std::uint32_t>(fa + (fb - fa) * t + 0.5f);  // t in [0, 1] keeps it within 0..255
}

float mix_coordinate(float a, float b, float t) {
  const float mixed = a + (b - a) * t;
  // The difference of two finite singles may be infinite.
  return mixed - mixed == 0 ? mixed : a * (1.0f - t) + b * t;
}

}  // namespace

AttributeShares shares_at(float t, float weight_of_first, float weight_of_second) {
  const float first = (1.0f - t) * weight_of_first, second = t * weight_of_second;
  const float both = first + second;
  return {t, both > 0 ? second / both : t};
}

void WedgeAttributes::mix(std::uint32_t to, std::uint32_t from, AttributeShares shares) const {
  if (normals != nullptr && normals[to] != normals[from]) {
    const Vec3 a = unpack(normals[to]), b = unpack(normals[from]);
    const Vec3 mixed = a * (1.0f - shares.normal) + b * shares.normal;
    // Opposite normals have no mean; that of the larger share then stays.
    normals[to] = pack_normal(normalized(mixed, shares.normal < 0.5f ? a : b));
  }
  if (colours != nullptr && colours[to] != colours[from]) {
    const Rgba8 a = colours[to], b = colours[from];
    colours[to] = rgba8(mix_channel(a.r(), b.r(), shares.colour), mix_channel(a.g(), b.g(), shares.colour),
                        mix_channel(a.b(), b.b(), shares.colour), mix_channel(a.a(), b.a(), shares.colour));
  }
  if (texture_coordinates != nullptr) {
    TexCoord& a = texture_coordinates[to];
    const TexCoord b = texture_coordinates[from];
    a = {mix_coordinate(a.s, b.s, shares.colour), mix_coordinate(a.t, b.t, shares.colour)};
  }
}

float position_along(Vec3 edge, Vec3 offset) {
  const float squared = dot(edge, edge);
  if (!(squared > 0)) return 0.5f;
  const float t = dot(edge, offset) / squared;
  return t > 0 ? (t < 1 ? t : 1.0f) : 0.0f;
}

}  // namespace usuzumi::firmware
