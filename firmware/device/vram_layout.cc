#include "firmware/device/vram_layout.h"

namespace usuzumi::firmware {

Result<VramLayout> plan_vram(BusAddress base, std::uint32_t bytes, std::uint32_t width, std::uint32_t height,
                             command::PixelFormat format, command::DepthFormat depth) {
  constexpr std::uint32_t kStrideUnit = 64, kMaxSize = 4096;
  if (width == 0 || height == 0 || width > kMaxSize || height > kMaxSize)
    return Status{StatusCode::kInvalidArgument, "picture width and height must be 1 to 4096", width};
  const auto stride = [&](std::uint32_t pixel_bytes) {
    return (width * pixel_bytes + kStrideUnit - 1) / kStrideUnit * kStrideUnit;
  };
  VramLayout layout;
  layout.picture_stride_bytes = stride(command::bytes_per_pixel(format));
  layout.depth_stride_bytes = stride(command::bytes_per_depth(depth));
  const std::uint64_t picture = std::uint64_t{layout.picture_stride_bytes} * height;
  const std::uint64_t total = 2 * picture + std::uint64_t{layout.depth_stride_bytes} * height;
  if (total > bytes)
    return Status{StatusCode::kResourceExhausted,
                  "VRAM is too small for two pictures and depth at this size; bytes needed",
                  static_cast<std::uint32_t>(total)};
  layout.picture[0] = base;
  layout.picture[1] = base + static_cast<std::uint32_t>(picture);
  layout.depth = base + static_cast<std::uint32_t>(2 * picture);
  layout.used_bytes = static_cast<std::uint32_t>(total);
  return layout;
}

}  // namespace usuzumi::firmware
