#include "firmware/simplify/vertex_deletion/fill_patterns.h"

namespace usuzumi::firmware {
namespace {

constexpr std::uint32_t kCounts[kMostCornersOfAllFills + 1] = {0, 0, 1, 1, 2, 5, 14};

// Triples ordered by their last corner, then the middle one: those of a smaller polygon come first.
constexpr std::uint8_t number_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return static_cast<std::uint8_t>(c * (c - 1) * (c - 2) / 6 + b * (b - 1) / 2 + a);
}

struct Triples {
  FillTriangle of[kMostTriples];
};
constexpr Triples all_triples() {
  Triples triples;
  for (std::uint32_t c = 2; c < kMostCornersOfAllFills; ++c)
    for (std::uint32_t b = 1; b < c; ++b)
      for (std::uint32_t a = 0; a < b; ++a)
        triples.of[number_of(a, b, c)] = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b),
                                          static_cast<std::uint8_t>(c)};
  return triples;
}

// All triangulations of the corners first .. last as lists of triples. The triangle on the side first-last has one of
// the corners between as its third, and the two polygons left are filled independently.
struct Fills {
  std::uint32_t count = 0;
  std::uint8_t triples[14][kTriplesOfFill] = {};
};
constexpr Fills fills_between(std::uint32_t first, std::uint32_t last) {
  Fills fills;
  if (last == first + 1) {
    fills.count = 1;
    return fills;
  }
  for (std::uint32_t third = first + 1; third < last; ++third) {
    const Fills left = fills_between(first, third), right = fills_between(third, last);
    for (std::uint32_t i = 0; i < left.count; ++i) {
      for (std::uint32_t j = 0; j < right.count; ++j) {
        std::uint8_t* fill = fills.triples[fills.count++];
        *fill++ = number_of(first, third, last);
        for (std::uint32_t t = 0; t + 1 < third - first; ++t) *fill++ = left.triples[i][t];
        for (std::uint32_t t = 0; t + 1 < last - third; ++t) *fill++ = right.triples[j][t];
      }
    }
  }
  return fills;
}

constexpr Triples kTriples = all_triples();
constexpr Fills kFills[] = {fills_between(0, 2), fills_between(0, 3), fills_between(0, 4), fills_between(0, 5)};
static_assert(kFills[0].count == 1 && kFills[1].count == 2 && kFills[2].count == 5 && kFills[3].count == 14);

FillTriangle sorted(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  if (x > y) x ^= y, y ^= x, x ^= y;
  if (y > z) y ^= z, z ^= y, y ^= z;
  if (x > y) x ^= y, y ^= x, x ^= y;
  return {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(z)};
}

// A zigzag is the strip through the corners z, z + 1, z - 1, z + 2, z - 2, ... or its mirror image. With an odd number
// of corners a strip read backwards is a mirrored one, so that one hand has them all; with an even number it is of the
// same hand, and half of the starts with either hand are all.
std::uint32_t strip_corner(std::uint32_t corners, std::uint32_t fill, std::uint32_t i) {
  const bool mirrored = corners % 2 == 0 && fill >= corners / 2;
  const std::uint32_t start = mirrored ? fill - corners / 2 : fill;
  const std::uint32_t step = (i + 1) / 2;
  const bool forward = (i % 2 == 1) != mirrored;
  const std::uint32_t corner = forward ? start + step : start + corners - step;
  return corner < corners ? corner : corner - corners;
}

}  // namespace

std::uint32_t fill_count(std::uint32_t corners) {
  return corners <= kMostCornersOfAllFills ? kCounts[corners] : corners;
}

const FillTriangle* triples() { return kTriples.of; }

const std::uint8_t* triples_of_fills(std::uint32_t corners) { return kFills[corners - 3].triples[0]; }

FillTriangle fill_triangle(std::uint32_t corners, std::uint32_t fill, std::uint32_t t) {
  if (is_fan(fill)) {
    const std::uint32_t apex = fill - kFirstFan, next = apex + 1 + t, after = apex + 2 + t;
    return sorted(apex, next < corners ? next : next - corners, after < corners ? after : after - corners);
  }
  if (corners <= kMostCornersOfAllFills) return kTriples.of[kFills[corners - 3].triples[fill][t]];
  return sorted(strip_corner(corners, fill, t), strip_corner(corners, fill, t + 1), strip_corner(corners, fill, t + 2));
}

}  // namespace usuzumi::firmware
