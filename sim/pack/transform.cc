#include "sim/pack/transform.h"

#include <cstddef>
#include <utility>

namespace usuzumi::sim {

Transform operator*(const Transform& a, const Transform& b) {
  Transform r;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] + (j == 3 ? a.m[i][3] : 0.0);
  return r;
}

Transform from_parts(const double translation[3], const double rotation[4], const double scale[3]) {
  double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (length > 0) {
    x /= length;
    y /= length;
    z /= length;
    w /= length;
  } else {
    w = 1;
  }
  Transform t;
  const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                          {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                          {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) t.m[i][j] = r[i][j] * scale[j];
    t.m[i][3] = translation[i];
  }
  return t;
}

void apply(const Transform& t, Mesh& mesh) {
  const auto& m = t.m;
  for (Vec3& p : mesh.positions) {
    const double x = double{p.x}, y = double{p.y}, z = double{p.z};
    p = {static_cast<float>(m[0][0] * x + m[0][1] * y + m[0][2] * z + m[0][3]),
         static_cast<float>(m[1][0] * x + m[1][1] * y + m[1][2] * z + m[1][3]),
         static_cast<float>(m[2][0] * x + m[2][1] * y + m[2][2] * z + m[2][3])};
  }
  const bool mirrors = t.determinant() < 0;
  // The cofactor matrix is the inverse transpose times the determinant: right up to length, and to sign when mirrored.
  double c[3][3];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c[i][j] = (m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1]) * (mirrors ? -1 : 1);
    }
  for (Vec3& n : mesh.normals) {
    const double x = double{n.x}, y = double{n.y}, z = double{n.z};
    const double r[3] = {c[0][0] * x + c[0][1] * y + c[0][2] * z, c[1][0] * x + c[1][1] * y + c[1][2] * z,
                         c[2][0] * x + c[2][1] * y + c[2][2] * z};
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    n = length > 0 && std::isfinite(length) ? Vec3{static_cast<float>(r[0] / length), static_cast<float>(r[1] / length),
                                                   static_cast<float>(r[2] / length)}
                                            : Vec3{};
  }
  if (mirrors)
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

}  // namespace usuzumi::sim
