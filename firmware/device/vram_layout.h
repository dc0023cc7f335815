// Where the two picture buffers and the depth buffer lie in VRAM.
#pragma once

#include <cstdint>

#include "hal/bus.h"
#include "hal/command_list.h"
#include "hal/status.h"

namespace usuzumi::firmware {

struct VramLayout {
  BusAddress picture[2] = {};  // drawn and shown in turn
  BusAddress depth = 0;
  std::uint32_t picture_stride_bytes = 0;  // both strides are multiples of 64, the display controller's unit
  std::uint32_t depth_stride_bytes = 0;
  std::uint32_t used_bytes = 0;
};

/// kResourceExhausted with the bytes needed in `where`.
Result<VramLayout> plan_vram(BusAddress base, std::uint32_t bytes, std::uint32_t width, std::uint32_t height,
                             command::PixelFormat format, command::DepthFormat depth);

}  // namespace usuzumi::firmware
