// How a picture is looked at.
#pragma once

#include <cstdint>

#include "hal/vec.h"

namespace usuzumi::firmware {

/// Where the viewer stands and how large the picture is.
struct View {
  Mat4 model_to_clip;
  std::uint32_t width = 0, height = 0;  // pixels
};

}  // namespace usuzumi::firmware
