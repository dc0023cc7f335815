// Image files as pictures: PNG by libpng, JPEG by libjpeg.
//
// glTF 2.0 (section 3.8.3) has colour profiles and gamma values inside images ignored; so do the tools that write the
// other formats. Samples are taken as sRGB, as they stand. Runs in the isolated process: image files come from
// anywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Larger pictures are refused, in texels each way.
inline constexpr std::uint32_t kMostDecoded = 16384;

/// A PNG or JPEG file, told apart by its first bytes. Grey, palette and 16-bit images become 8 bits a channel. nullopt
/// where it cannot be used; `fault` then says why, as in "is damaged: …". The name is left empty.
std::optional<Picture> decode_picture(std::span<const std::byte> file, std::string& fault);

/// Room for a picture's texels, for the decoders below. nullopt, and why in `fault`, where it is too large.
std::optional<Picture> picture_of(std::uint32_t width, std::uint32_t height, std::string& fault);

std::optional<Picture> decode_png(std::span<const std::byte> file, std::string& fault);
std::optional<Picture> decode_jpeg(std::span<const std::byte> file, std::string& fault);

}  // namespace usuzumi::sim
