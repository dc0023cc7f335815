// The model on a turntable: what a device shows of it when nobody says otherwise.
#pragma once

#include <cstdint>

#include "firmware/device/device.h"
#include "firmware/scene/camera.h"

namespace usuzumi::firmware {

/// A little from the right and from above: 30 and 20 degrees. It stands where `frames` is 0; otherwise it goes once
/// around in that many frames, and on.
Camera turntable_camera(const Bounds& bounds, std::uint32_t frame, std::uint32_t frames, float aspect);

/// The model as `camera` sees it. Light comes over the viewer's right shoulder and follows the camera, so that no side
/// stays dark.
FrameRequest lit_request(const Camera& camera, float aspect, Rgba8 background);

}  // namespace usuzumi::firmware
