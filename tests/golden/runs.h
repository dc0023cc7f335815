// Whole runs of the device with goldens of their own: drawing data thinned by the firmware, drawn by the software
// engine, sent by the display controller, and read from the panel.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "firmware/solids/solid_choice.h"
#include "firmware/thinning/policy.h"
#include "sim/desk/desk.h"
#include "tests/golden/golden_store.h"
#include "tests/support/rom_builder.h"

namespace usuzumi::golden {

/// A real board that a run is too big for, by the names of boards/.
struct NotOn {
  const char* board;
  const char* reason;
};

struct DeviceRun {
  const char* name;  // names the PNG and the lines in the manifest
  const char* note;  // what the run proves
  sim::BoardDescription board;
  std::uint32_t width, height;
  std::function<testing::RomImage()> rom;
  firmware::ThinningSettings thinning;
  std::vector<double> azimuths_rad;  // of the camera, one a frame; the last frame has the PNG
  std::vector<NotOn> not_on;
  std::vector<std::uint32_t> quotas_millionths = {};  // one a frame, in place of the settings' quota; or none
  std::vector<std::uint32_t> boot_layers_millionths = {};
  std::vector<firmware::Thresholds> thresholds = {};  // of solids, one a frame; or none
};

std::span<const DeviceRun> all_runs();

struct RunPicture {
  sim::Image picture;               // the last frame on the panel
  std::uint32_t signature_crc = 0;  // of it, by the display controller's signature unit
  std::uint32_t vram_crc = 0;       // of it, straight from VRAM
  firmware::ThinningReport thinning;
  firmware::SolidsReport solids;
  sim::Desk::Memory memory;
  /// The manifest's lines: every frame, and every mesh of the RAM copy after the last one, sorted by name.
  std::vector<Entry> entries;
};

/// Boots a device and draws the run's frames from `first_frame` on. Throws sim::Error where the device fails.
RunPicture draw_run(const DeviceRun& run, std::size_t first_frame = 0, std::uint32_t threads = 1);

}  // namespace usuzumi::golden
