#include "firmware/device/vram_layout.h"

namespace usuzumi::firmware {

Result<VramLayout> plan_vram(BusAddress base, std::uint32_t bytes, const Scanout& wanted, command::DepthFormat depth) {
  constexpr std::uint32_t kDepthStrideUnit = 64, kMaxSize = 4096;
  if (wanted.width == 0 || wanted.height == 0 || wanted.width > kMaxSize || wanted.height > kMaxSize)
    return Status{StatusCode::kInvalidArgument, "picture width and height must be 1 to 4096", wanted.width};
  const auto round_up = [](std::uint64_t value, std::uint32_t unit) { return (value + unit - 1) / unit * unit; };
  VramLayout layout;
  layout.scanout = wanted;
  layout.depth_format = depth;
  layout.depth_stride_bytes = static_cast<std::uint32_t>(
      round_up(std::uint64_t{wanted.width} * command::bytes_per_depth(depth), kDepthStrideUnit));
  const std::uint64_t picture =
      round_up(std::uint64_t{wanted.stride_bytes} * wanted.height, Display::kPictureAlignment);
  const std::uint64_t total = 2 * picture + std::uint64_t{layout.depth_stride_bytes} * wanted.height;
  if (total > bytes)
    return Status{StatusCode::kResourceExhausted,
                  "VRAM is too small for two pictures and depth at this size; bytes needed",
                  static_cast<std::uint32_t>(total)};
  layout.scanout.picture[0] = base;
  layout.scanout.picture[1] = base + static_cast<std::uint32_t>(picture);
  layout.depth = base + static_cast<std::uint32_t>(2 * picture);
  layout.used_bytes = static_cast<std::uint32_t>(total);
  return layout;
}

}  // namespace usuzumi::firmware
