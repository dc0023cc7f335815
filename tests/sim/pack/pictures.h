// Image files as libpng and libjpeg write them, for models that the tests make.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/vec.h"

namespace usuzumi::testing {

/// A PNG of 8 bits a channel with alpha. `gamma` above 0 is stored beside it.
std::string png_file(std::uint32_t width, std::uint32_t height, const std::vector<Rgba8>& texels, double gamma = 0);
/// A baseline JPEG of quality 100 without subsampling.
std::string jpeg_file(std::uint32_t width, std::uint32_t height, const std::vector<Rgba8>& texels);

/// width * height texels of one colour.
std::vector<Rgba8> plain(std::uint32_t width, std::uint32_t height, Rgba8 colour);

}  // namespace usuzumi::testing
