// A quota that falls frame by frame, drawn with middle layers and without: what changes on the panel from one frame to
// the next.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "sim/desk/desk.h"

namespace usuzumi::testing {

/// Largest change of a block of 8 x 8 pixels from one picture to another of its size: the mean difference of its
/// channels, 0 .. 255.
inline double block_change(const sim::Image& a, const sim::Image& b) {
  constexpr std::uint32_t kSide = 8;
  double largest = 0;
  for (std::uint32_t y = 0; y + kSide <= a.height; y += kSide)
    for (std::uint32_t x = 0; x + kSide <= a.width; x += kSide) {
      int sum = 0;
      for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const std::uint32_t p = a.at(x + i % kSide, y + i / kSide), q = b.at(x + i % kSide, y + i / kSide);
        for (const int shift : {0, 8, 16})
          sum += std::abs(static_cast<int>(p >> shift & 0xFF) - static_cast<int>(q >> shift & 0xFF));
      }
      largest = std::max(largest, sum / (3.0 * kSide * kSide));
    }
  return largest;
}

/// From all faces to the last layer's share of them.
struct QuotaSweep {
  int frames = 300;
  std::span<const std::uint32_t> layers_millionths;  // those of every mesh that has any, from 1,000,000 down
  bool geometric = false;  // the quota falls by the same share in every frame, not by as many faces
};

/// The largest block_change() between two neighbouring frames of a sweep.
struct SweepChange {
  double middle = 0;    // drawn in middle layers
  double switched = 0;  // drawn in the coarsest layer that has as many faces as the quota
};

/// `middle` and `switched` are desks of one drawing data; `request` is what both draw, but for quota and mode.
inline SweepChange sweep_quota(sim::Desk& middle, sim::Desk& switched, const firmware::FrameRequest& request,
                               const QuotaSweep& sweep) {
  constexpr double kMillion = 1e6;
  const double last = sweep.layers_millionths.back() / kMillion;
  const auto drawn = [&](sim::Desk& desk, std::uint32_t millionths, firmware::LayerMode mode) -> const sim::Image& {
    firmware::FrameRequest asked = request;
    asked.thinning.quota = {firmware::format::QuotaKind::kMillionths, millionths};
    asked.thinning.layers.mode = mode;
    return desk.draw(asked).picture;
  };
  SweepChange change;
  sim::Image before_middle, before_switched;
  for (int i = 0; i < sweep.frames; ++i) {
    const double way = static_cast<double>(i) / (sweep.frames - 1);
    const double share = sweep.geometric ? std::pow(last, way) : 1 - (1 - last) * way;
    const auto quota = static_cast<std::uint32_t>(std::lround(share * kMillion));
    std::uint32_t layer = 0;
    for (const std::uint32_t q : sweep.layers_millionths)
      if (q >= quota) layer = q;
    const sim::Image& a = drawn(middle, quota, firmware::LayerMode::kQuota);
    const sim::Image& b = drawn(switched, layer, firmware::LayerMode::kFaces);
    if (i > 0) {
      change.middle = std::max(change.middle, block_change(before_middle, a));
      change.switched = std::max(change.switched, block_change(before_switched, b));
    }
    before_middle = a;
    before_switched = b;
  }
  return change;
}

}  // namespace usuzumi::testing
