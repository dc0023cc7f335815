// Where drawing data end in a flash memory that is larger than they are.
#pragma once

#include <cstddef>
#include <span>

namespace usuzumi::firmware {

/// The image that begins with `flash`: as long as a container says of itself, or as the records of bare data reach.
/// Checks nothing else; what claims to be longer than the flash is cut at its end, for DrawingData::open() to refuse.
/// Empty where the flash holds no image: erased (all ones) or blank (zeros).
std::span<const std::byte> image_in_flash(std::span<const std::byte> flash);

}  // namespace usuzumi::firmware
