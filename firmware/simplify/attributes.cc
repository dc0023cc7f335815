#include "firmware/simplify/attributes.h"

namespace usuzumi::firmware {
namespace {

std::uint32_t mix_channel(std::uint32_t a, std::uint32_t b, float t) {
  const float fa = static_cast<float>(a), fb = static_cast<float>(b);
  return static_cast<std::uint32_t>(fa + (fb - fa) * t + 0.5f);  // t in [0, 1] keeps it within 0..255
}

}  // namespace

void WedgeAttributes::mix(std::uint32_t to, std::uint32_t from, float t) const {
  if (normals != nullptr && normals[to] != normals[from]) {
    const Vec3 a = unpack(normals[to]), b = unpack(normals[from]);
    const Vec3 mixed = a * (1.0f - t) + b * t;
    // Opposite normals have no mean; the nearer end's then stays.
    normals[to] = pack_normal(normalized(mixed, t < 0.5f ? a : b));
  }
  if (colours != nullptr && colours[to] != colours[from]) {
    const Rgba8 a = colours[to], b = colours[from];
    colours[to] = rgba8(mix_channel(a.r(), b.r(), t), mix_channel(a.g(), b.g(), t), mix_channel(a.b(), b.b(), t),
                        mix_channel(a.a(), b.a(), t));
  }
}

float position_along(Vec3 edge, Vec3 offset) {
  const float squared = dot(edge, edge);
  if (!(squared > 0)) return 0.5f;
  const float t = dot(edge, offset) / squared;
  return t > 0 ? (t < 1 ? t : 1.0f) : 0.0f;
}

}  // namespace usuzumi::firmware
