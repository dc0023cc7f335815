// The picture for when something has failed: a warning triangle on black, painted by the CPU alone, so that it needs
// neither the 3D engine nor drawing data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/display.h"

namespace usuzumi::firmware {

/// Where the triangle stands in a picture of that size: in the middle, two fifths of the smaller side, all that a
/// display must fetch.
PictureRectangle safe_picture_part(std::uint32_t width, std::uint32_t height);

/// Paints the whole picture. `pixels` holds scanout.height rows of scanout.stride_bytes.
void paint_safe_picture(const Scanout& scanout, std::span<std::byte> pixels);

}  // namespace usuzumi::firmware
