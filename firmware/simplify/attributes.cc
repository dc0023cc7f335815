#include "firmware/simplify/attributes.h"

namespace usuzumi::firmware {
namespace {

std::uint32_t mix_channel(std::uint32_t a, std::uint32_t b, float t) {
  const float fa = static_cast<float>(a), fb = static_cast<float>(b);
  const float mean = fa + (fb - fa) * t + 0.5f;
  return mean > 0 ? (mean < 255 ? static_cast<std::uint32_t>(mean) : 255u) : 0u;
}

bool is_finite(float x) { return x - x == 0; }

float mix_coordinate(float a, float b, float t) {
  float mean = a + (b - a) * t;
  // The difference of two finite singles may be infinite; beyond an end the mean itself.
  if (!is_finite(mean)) mean = a * (1.0f - t) + b * t;
  return is_finite(mean) ? mean : (t < 0.5f ? a : b);
}

}  // namespace

Rgba8 mixed(Rgba8 a, Rgba8 b, float t) {
  return rgba8(mix_channel(a.r(), b.r(), t), mix_channel(a.g(), b.g(), t), mix_channel(a.b(), b.b(), t),
               mix_channel(a.a(), b.a(), t));
}

TexCoord mixed(TexCoord a, TexCoord b, float t) { return {mix_coordinate(a.s, b.s, t), mix_coordinate(a.t, b.t, t)}; }

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
  if (colours != nullptr && colours[to] != colours[from])
    colours[to] = mixed(colours[to], colours[from], shares.colour);
  if (texture_coordinates != nullptr)
    texture_coordinates[to] = mixed(texture_coordinates[to], texture_coordinates[from], shares.colour);
}

float position_along(Vec3 edge, Vec3 offset) {
  const float squared = dot(edge, edge);
  if (!(squared > 0)) return 0.5f;
  const float t = dot(edge, offset) / squared;
  return t > 0 ? (t < 1 ? t : 1.0f) : 0.0f;
}

}  // namespace usuzumi::firmware
