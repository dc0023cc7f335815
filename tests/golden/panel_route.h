// The other way to a scene's picture: VRAM read out by the display controller, rebuilt by the panel from the signal.
#pragma once

#include <cstdint>

#include "sim/image/image.h"
#include "tests/support/scene.h"

namespace usuzumi::golden {

struct PanelShot {
  Status status;                    // of the display driver
  sim::Image picture;               // the scene's part of what the panel shows: all of it from 16 x 16 pixels on
  std::uint32_t panel_crc = 0;      // of all that the panel shows
  std::uint32_t signature_crc = 0;  // the same by the controller's signature unit, before the cable
  bool faults = false;              // FIFO underflow or illegal configuration
};

/// Puts a drawing's colour plane into a machine's VRAM as it is, rows and padding, and shows it by the display driver.
PanelShot show_on_panel(const scenes::TargetSpec& target, const scenes::SceneDrawing& drawing);

}  // namespace usuzumi::golden
