// What a run measured, as JSON and as a table.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/desk/desk.h"

namespace usuzumi::sim {

struct RunSummary {
  std::string rom;
  std::string board;
  std::string engine;
  std::uint32_t width = 0, height = 0;
  Desk::Memory memory;
  std::vector<std::string> layered_meshes;  // names of those that have layers
};

/// {"rom", "board", "engine", "width", "height", "ram_peak_bytes", "vram_bytes", "rom_bytes", "layered_meshes": names
/// of those that have layers, "frames": [...]}. Each frame has crc32 (eight hexadecimal digits), shown (picture, dark,
/// safe), mode (full, thinned, budget), backlight, wake_ms (from ignition to light, in the frame that lit it), fault
/// (why it is not the picture), meshes_in, meshes_out, faces_in, faces_thinned, faces_drawn, engine_cycles, thin_ms,
/// draw_ms, scanout_ms (virtual time), host_ms, layers, solids and thinning. layers has an entry for each of
/// layered_meshes: the layer it was drawn in, 1.25 a quarter of the way from layer 1 to layer 2; null where it was not
/// drawn from its layers. solids has how many were drawn by which member (high, medium, low, rough), how many were out
/// of sight (clipped), and the faces told to the engine. thinning says why it ran or did not (cause), what it decided
/// for how many meshes and why it keeps them (decisions: deleted, collapsed, points, lines, kept_by_level,
/// kept_level_unset, kept_thinning_off, kept_above_area, kept_not_chosen, kept_telltale), and what it did in this
/// frame: meshes_built, meshes_collapsed, quotas_missed, meshes_unthinned, meshes_dropped, quota_halvings,
/// bytes_left_in_rom (of vertices drawn from there), meshes_layered, meshes_moved, chains_refused, layers_given_up,
/// max_error.
std::string run_report_json(const RunSummary& summary, std::span<const FrameRecord> frames);

/// A few lines for a person.
std::string run_report_text(const RunSummary& summary, std::span<const FrameRecord> frames);

}  // namespace usuzumi::sim
