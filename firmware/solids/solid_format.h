// Solids, word by word: what lies in section SOLD of drawing data. The page firmware/drawing_data/README.md has the
// byte tables.
//
//     SolidsHeader | a Vec3 per view candidate | Solid per solid
//
// The ten basic solids, their four members and their sizes are those of Shindo, Katayama, Sakamoto & Matsuda (1995),
// chapters 2 to 5.
#pragma once

#include <cstdint>

namespace usuzumi::firmware::format {

enum class SolidKind : std::uint32_t {
  kSphere = 0,
  kHemisphere = 1,
  kCone = 2,
  kCylinder = 3,
  kFrustumCone = 4,
  kCube = 5,
  kCuboid = 6,
  kSquarePyramid = 7,
  kTriangularPyramid = 8,
  kTrapezoid = 9,
};
inline constexpr std::uint32_t kSolidKindCount = 10;

/// The y axis is the solid's, upwards; the origin is half-way between its bottom and its top, on the axis.
///
/// | kind | size, in the solid's own units, each 1e-6 to 1e8 |
/// |---|---|
/// | sphere, hemisphere (its dome upwards) | diameter |
/// | cone | diameter of the base, height |
/// | cylinder | diameter, height |
/// | frustum cone | diameter of the bottom, of the top, height |
/// | cube | edge |
/// | cuboid | x, y, z |
/// | square pyramid | edge of the base, height |
/// | triangular pyramid | base of the bottom triangle (along x), its height (along z), height |
/// | trapezoid | bottom x, bottom z, top x, top z, height |
inline constexpr std::uint32_t kMaxSolidSizes = 5;
/// Sizes and stretches below this leave single precision no normals; above 1e8 are no coordinates.
inline constexpr float kLeastSolidSize = 1e-6f;
inline constexpr std::uint32_t kSolidSizeCount[kSolidKindCount] = {1, 1, 2, 2, 3, 1, 3, 2, 3, 5};

struct Solid {                        // 84 bytes
  SolidKind kind{};
  float size[kMaxSolidSizes] = {};    // what the kind has not must be 0
  /// To the model's coordinates: row-major 3 x 4, the last column the origin's place. May turn, stretch (1e-6 to 1e8)
  /// and mirror, not flatten: its axes of unit length span at least 1e-4 of a cube.
  float to_model[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  std::uint32_t colour = 0xFFFFFFFF;  // Rgba8, display-referred; solids are opaque
  std::uint32_t name_offset = 0xFFFFFFFF;  // into section NAME, from the file's start; kAbsent: none
  std::uint32_t name_bytes = 0;
};
static_assert(sizeof(Solid) == 84);

/// Members with faces all around: high, medium, low. Faces of a sphere: around * rows; of a hemisphere: around *
/// (rows + 1), its base counted as `around` triangles.
inline constexpr std::uint32_t kFacedMembers = 3;
struct SolidDetail {                  // 60 bytes; defaults: table 2
  std::uint32_t sphere_around[kFacedMembers] = {16, 10, 8};       // 3 .. 64
  std::uint32_t sphere_rows[kFacedMembers] = {8, 5, 4};           // 2 .. 32
  std::uint32_t hemisphere_around[kFacedMembers] = {16, 7, 8};    // 3 .. 64
  std::uint32_t hemisphere_rows[kFacedMembers] = {4, 4, 2};       // 1 .. 32
  std::uint32_t round_sides[kFacedMembers] = {16, 12, 8};         // 3 .. 64: of cone, cylinder and frustum cone
};
static_assert(sizeof(SolidDetail) == 60);
inline constexpr std::uint32_t kMaxAround = 64, kMaxRows = 32;

inline constexpr std::uint32_t kMaxSolids = 65535;
inline constexpr std::uint32_t kMaxViewCandidates = 32;

struct SolidsHeader {                 // 72 bytes
  std::uint32_t solid_count = 0;      // 1 .. kMaxSolids
  std::uint32_t candidate_count = 0;  // 1 .. kMaxViewCandidates
  SolidDetail detail;
  std::uint32_t reserved = 0;         // must be 0
};
static_assert(sizeof(SolidsHeader) == 72);

}  // namespace usuzumi::firmware::format
