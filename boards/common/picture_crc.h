// The CRC-32 of a picture as a panel shows it, the same that the display controller's signature unit computes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/display.h"

namespace usuzumi::boards {

/// Of the R, G, B bytes in scan order; five and six bits become eight by repeating the upper ones. `pixels` holds
/// scanout.height rows of scanout.stride_bytes.
std::uint32_t picture_crc32(const Scanout& scanout, std::span<const std::byte> pixels);

}  // namespace usuzumi::boards
