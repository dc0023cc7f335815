// The solids of drawing data as they lie there.
#pragma once

#include <span>

#include "firmware/solids/solid_format.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// Section SOLD, checked.
struct SolidsView {
  format::SolidDetail detail;
  std::span<const Vec3> candidates;
  std::span<const format::Solid> solids;
};

}  // namespace usuzumi::firmware
