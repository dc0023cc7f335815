// Where the two picture buffers and the depth buffer lie in VRAM.
#pragma once

#include <cstdint>

#include "hal/bus.h"
#include "hal/command_list.h"
#include "hal/display.h"
#include "hal/status.h"

namespace usuzumi::firmware {

struct VramLayout {
  Scanout scanout;  // the pictures are drawn and shown in turn
  BusAddress depth = 0;
  command::DepthFormat depth_format = command::DepthFormat::kUnorm24;
  std::uint32_t depth_stride_bytes = 0;  // a multiple of 64
  std::uint32_t used_bytes = 0;
};

/// Places the pictures, each at a multiple of Display::kPictureAlignment, and the depth. All of `wanted` but the
/// pictures' addresses is the caller's. `base` is a multiple of kPictureAlignment. kResourceExhausted with the bytes
/// needed in `where`.
Result<VramLayout> plan_vram(BusAddress base, std::uint32_t bytes, const Scanout& wanted, command::DepthFormat depth);

}  // namespace usuzumi::firmware
