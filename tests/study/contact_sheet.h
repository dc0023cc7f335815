// Pictures side by side.
#pragma once

#include <cstdint>
#include <span>

#include "sim/image/image.h"

namespace usuzumi::study {

/// The pictures row by row, `columns` in each, with `gap` pixels of `rgb` (0x00RRGGBB) between them and none around.
/// All are of the first one's size; there is at least one.
sim::Image contact_sheet(std::span<const sim::Image> pictures, std::uint32_t columns, std::uint32_t gap = 2,
                         std::uint32_t rgb = 0xFFFFFF);

}  // namespace usuzumi::study
