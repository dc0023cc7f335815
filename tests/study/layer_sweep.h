// A model with layers while its quota falls (tests/support/quota_sweep.h), seen from around.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/simplify.h"
#include "sim/pack/model.h"
#include "tests/study/views.h"
#include "tests/support/quota_sweep.h"

namespace usuzumi::study {

/// The largest changes seen from `views` directions at equal angles around the model, 23 degrees above it; the first is
/// 17 degrees to the right of its front. Every mesh is packed with the sweep's layers, made by `method`; where the
/// method ends before the last of them, there the mesh stays. Throws sim::Error.
testing::SweepChange sweep_layers(sim::Model model, firmware::Method method, const testing::QuotaSweep& sweep,
                                  PictureSize size, int views);

}  // namespace usuzumi::study
