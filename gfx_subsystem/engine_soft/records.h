// What the stages hand to each other: transformed vertices, set-up triangles, and the memory they are put in.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gfx_subsystem/engine_soft/conventions.h"

namespace usuzumi::gfx::soft {

/// Where a vertex lies. The first six are the sides of the view volume; a triangle with one of them set at all corners
/// is rejected. kOutsideNear and later make clipping necessary when set at any corner.
enum Outcode : std::uint32_t {
  kOutsideLeft = 1, kOutsideRight = 2, kOutsideBottom = 4, kOutsideTop = 8,
  kOutsideNear = 16, kOutsideFar = 32,
  kOutsideGuard = 64,   // beyond the guard band, or w too small to divide by: x, y, z, u are not set
  kNotANumber = 128,    // NaN, infinite or absurdly large: the primitive is dropped
};
inline constexpr std::uint32_t kViewSides = 63;
inline constexpr std::uint32_t kNeedsClip = kOutsideNear | kOutsideFar | kOutsideGuard | kNotANumber;

/// A vertex after the vertex stage.
struct alignas(32) Vertex {
  float red, green, blue;  // lane units without the half
  float depth;             // depth units: 0 .. 65535 or 16777215
  std::int32_t x, y;       // snapped window position
  float u;                 // 1 / clip.w
  std::uint32_t outcode;
};
static_assert(sizeof(Vertex) == 32);

/// What a vertex has besides where its draw makes fragments (DrawSetup::fragments).
struct alignas(16) VertexExtra {
  float s, t;   // within kMaxTextureCoordinate
  float alpha;  // lane units of 8 bits, as the colours
};

/// A vertex that lies on its own, not among a worker's.
struct PlacedVertex {
  Vertex vertex;
  VertexExtra extra;
};

/// How a triangle's colour is found; also the kind of an entry in a tile's list, but for kFragment.
enum class Shading : std::uint32_t { kConstant = 0, kAffine = 1, kPerspective = 2, kFragment = 3 };

/// Depth and colour as linear functions of the pixel, counted from an origin pixel. Depth is 24.8, modulo 2^32. A
/// colour is two words of two 16-bit lanes: "high" holds green and, above it, alpha (unused where there are no
/// fragments), "low" blue and, above it, red, because then packing to XRGB8888 is 0xFF000000 | (high & 0xFF00) |
/// (low >> 8 & 0xFF00FF).
struct Planes {
  std::uint32_t depth, depth_dx, depth_dy;
  std::uint32_t high, low;            // kConstant: high is the packed pixel, the rest unused; of fragments both words
                                      // hold channels, 0..255 in each lane
  std::uint32_t high_dx, low_dx;      // per pixel to the right, lane by lane modulo 2^16
  std::uint32_t high_dy, low_dy;      // per pixel down
};

/// A triangle of at most kMaxSpan x kMaxSpan pixels, ready to rasterize: one cache line. Pixel offsets count from the
/// origin pixel (x, y), the top left corner of its clipped bounding box.
struct alignas(64) SmallTriangle {
  std::int32_t edge[3];               // e at the origin pixel, fill rule included
  std::int16_t step[2][2];            // e's steps: per pixel right, per pixel down; the third edge's make the sum zero
  Planes planes;
  std::uint16_t x, y;
  std::uint8_t last_x, last_y;        // last pixel of the clipped bounding box, as an offset
  std::uint16_t draw;                 // low 15 bits: draw state; top bit: the bounding box cuts the triangle
};
static_assert(sizeof(SmallTriangle) == 64);
inline constexpr std::uint16_t kClippedBox = 0x8000;

/// Follows a SmallTriangle of Shading::kPerspective, or its TexturePlanes. Planes of u = 1/w and of colour * u at the
/// origin pixel, scaled so that the largest u is 1.
struct alignas(64) PerspectivePlanes {
  float value[4], dx[4], dy[4];       // u, red, green, blue
  float unused[4];
};
static_assert(sizeof(PerspectivePlanes) == 64);

/// Follows a SmallTriangle of fragments. Planes of u = 1/w and of s, t and alpha times u at the origin pixel, u scaled
/// as in PerspectivePlanes.
struct alignas(64) TexturePlanes {
  float value[4], dx[4], dy[4];       // u, s, t, alpha; alpha is used by kPerspective alone
  Shading shading;                    // of colours and alpha
};
static_assert(sizeof(TexturePlanes) == 64);

/// A triangle larger than that. Set-up is done once; each tile derives a tile-local form from it by additions.
struct alignas(64) BigTriangle {
  std::int64_t edge[3];               // E at the centre of pixel (0, 0), fill rule included
  std::int32_t a[3], b[3];
  std::uint16_t x, y, last_x, last_y; // clipped bounding box, pixels, inclusive
  std::int32_t from_x, from_y;        // snapped position that the planes start from
  std::uint64_t plane[4];             // red, green, blue, depth there: units * 2^16, half included
  std::uint64_t plane_dx[4], plane_dy[4];  // per pixel
  double perspective[4], perspective_dx[4], perspective_dy[4];
  std::uint32_t constant_pixel;
  std::uint16_t draw;
  std::uint16_t shading;
};
static_assert(sizeof(BigTriangle) == 320);

/// Follows a BigTriangle of Shading::kFragment.
struct alignas(64) BigTexture {
  double value[4], dx[4], dy[4];      // u, s, t, alpha, as in TexturePlanes, at (from_x, from_y)
  std::uint64_t alpha, alpha_dx, alpha_dy;  // as BigTriangle::plane
  Shading shading;                    // of colours and alpha
  std::uint32_t constant_low;         // kConstant: Planes::low; high is in constant_pixel
};
static_assert(sizeof(BigTexture) == 128);

inline constexpr std::uint32_t kSlotBytes = 64;
inline constexpr std::uint32_t kBigSlots = sizeof(BigTriangle) / kSlotBytes,
                               kBigTextureSlots = sizeof(BigTexture) / kSlotBytes;
struct alignas(kSlotBytes) Slot {
  std::byte bytes[kSlotBytes];
};

/// An entry of a tile's list: kind in the top 3 bits, slot of the record (or number of the clear) below.
enum class EntryKind : std::uint32_t { kSmall = 0, kBig = 3, kClear = 4, kFragment = 5 };  // kSmall + Shading
inline constexpr std::uint32_t kEntryKindShift = 29;
inline constexpr std::uint32_t kEntrySlotMask = (1u << kEntryKindShift) - 1;

/// A tile's list is a chain of cache lines.
struct alignas(64) EntryBlock {
  static constexpr std::uint32_t kEntries = 15;
  std::uint32_t entry[kEntries];
  std::uint32_t next;                 // slot of the next block when all entries are used
};
static_assert(sizeof(EntryBlock) == kSlotBytes);

/// Head of one tile's list within one bin set. A block in use is never slot 0 with count 0.
struct TileList {
  std::uint32_t first = 0;            // slot
  std::uint32_t last = 0;             // slot
  std::uint32_t count = 0;            // entries in all
};

}  // namespace usuzumi::gfx::soft
