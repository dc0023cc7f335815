// Pictures as PNG files.
#pragma once

#include <filesystem>

#include "sim/image/image.h"

namespace usuzumi::sim {

/// Larger pictures are refused: 16384 pixels each way.
inline constexpr std::uint32_t kMaxPngSize = 16384;

/// Any PNG; grey, palette and 16-bit pictures become 8 bits a channel, transparent parts are laid over black. Throws
/// Error kBadInput: missing, not a PNG, truncated or damaged, too large.
Image read_png(const std::filesystem::path& path);

enum class PngEffort {
  kSmall,  // libpng's default compression
  kFast,   // about three times as fast, for a picture per frame
};

/// 8 bits a channel, no alpha. Written beside `path` and renamed. Throws Error kCannotWrite.
void write_png(const std::filesystem::path& path, const Image& image, PngEffort effort = PngEffort::kSmall);

}  // namespace usuzumi::sim
