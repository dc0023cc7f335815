#include "sim/desk/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace usuzumi::sim {
namespace {

using nlohmann::ordered_json;

const char* cause_name(firmware::UpdateCause cause) {
  switch (cause) {
    case firmware::UpdateCause::kFirst: return "first";
    case firmware::UpdateCause::kDecisions: return "decisions changed";
    case firmware::UpdateCause::kLayers: return "layers moved";
    case firmware::UpdateCause::kUnchanged: return "unchanged";
  }
  return "";
}

/// What was decided for how many meshes, for kept ones why. The numbers add up to meshes_in.
ordered_json decisions_json(const firmware::ThinningReport& t) {
  using firmware::Action;
  using firmware::Reason;
  const auto decided = [&](Action action) { return t.actions[static_cast<std::size_t>(action)]; };
  const auto kept = [&](Reason reason) { return t.kept_for[static_cast<std::size_t>(reason)]; };
  return {{"deleted", decided(Action::kDelete)},
          {"collapsed", decided(Action::kCollapse)},
          {"points", decided(Action::kPoint)},
          {"lines", decided(Action::kLine)},
          {"kept_by_level", kept(Reason::kAuthorLevel)},
          {"kept_level_unset", kept(Reason::kLevelUnset)},
          {"kept_thinning_off", kept(Reason::kThinningOff)},
          {"kept_above_area", kept(Reason::kAboveArea)},
          {"kept_not_chosen", kept(Reason::kNotChosen)},
          {"kept_telltale", kept(Reason::kTelltale)}};
}

ordered_json layers_json(std::span<const float> layers) {
  ordered_json list = ordered_json::array();
  for (const float layer : layers) list.push_back(layer < 0 ? ordered_json() : ordered_json(layer));
  return list;
}

ordered_json solids_json(const firmware::SolidsReport& s) {
  return {{"high", s.drawn[0]}, {"medium", s.drawn[1]},   {"low", s.drawn[2]},
          {"rough", s.drawn[3]}, {"clipped", s.clipped}, {"faces", s.faces}};
}

std::uint32_t solids_drawn(const firmware::SolidsReport& s) {
  return s.drawn[0] + s.drawn[1] + s.drawn[2] + s.drawn[3];
}
std::uint32_t solids_in(const firmware::SolidsReport& s) { return solids_drawn(s) + s.clipped; }

ordered_json frame_json(const FrameRecord& f) {
  const firmware::ThinningReport& t = f.firmware.thinning;
  return {{"frame", f.frame},
          {"crc32", fmt::format("{:08x}", f.crc32)},
          {"shown", firmware::shown_name(f.shown)},
          {"mode", firmware::draw_mode_name(f.mode)},
          {"backlight", f.backlight},
          {"wake_ms", f.wake_ms},
          {"fault", f.fault},
          {"meshes_in", t.meshes_in},
          {"meshes_out", t.meshes_out},
          {"faces_in", t.faces_in},
          {"faces_thinned", t.faces_out},
          {"faces_drawn", f.firmware.faces_drawn},
          {"engine_cycles", f.firmware.engine_cycles},
          {"thin_ms", f.thin_ms},
          {"draw_ms", f.draw_ms},
          {"scanout_ms", f.scanout_ms},
          {"host_ms", f.host_ms},
          {"layers", layers_json(f.layers)},
          {"solids", solids_json(f.firmware.solids)},
          {"thinning",
           {{"cause", t.meshes_in + solids_in(f.firmware.solids) > 0 ? cause_name(t.cause) : "nothing drawn"},
            {"decisions", decisions_json(t)},
            {"meshes_built", t.meshes_built},
            {"meshes_collapsed", t.meshes_collapsed},
            {"quotas_missed", t.quotas_missed},
            {"meshes_unthinned", t.meshes_unthinned},
            {"meshes_dropped", t.meshes_dropped},
            {"quota_halvings", t.quota_halvings},
            {"bytes_left_in_rom", t.bytes_left_in_rom},
            {"meshes_layered", t.meshes_layered},
            {"meshes_moved", t.meshes_moved},
            {"chains_refused", t.chains_refused},
            {"layers_given_up", t.layers_given_up},
            {"max_error", t.max_error}}}};
}

/// One line for every frame in which the instrument changed what it shows, where it ever did.
std::string pins_text(std::span<const FrameRecord> frames) {
  const auto same = [](const FrameRecord& a, const FrameRecord& b) {
    return a.shown == b.shown && a.mode == b.mode && a.backlight == b.backlight && a.fault == b.fault;
  };
  const bool any = std::any_of(frames.begin(), frames.end(), [&](const FrameRecord& f) {
    return !same(f, frames.front()) || f.shown != firmware::Shown::kPicture;
  });
  std::string text;
  for (std::size_t i = 0; any && i < frames.size(); ++i) {
    const FrameRecord& f = frames[i];
    if (i > 0 && same(f, frames[i - 1])) continue;
    text += fmt::format("  frame {:<5} {}, mode {}, backlight {}", f.frame, firmware::shown_name(f.shown),
                        firmware::draw_mode_name(f.mode), f.backlight ? "on" : "off");
    if (f.wake_ms > 0) text += fmt::format(", {:.2f} ms after ignition", f.wake_ms);
    text += f.fault.empty() ? "\n" : fmt::format(" ({})\n", f.fault);
  }
  return text;
}

/// From which layer to which the frames' meshes were drawn, where any was drawn from its layers.
std::string layers_text(const RunSummary& summary, std::span<const FrameRecord> frames) {
  float finest = 0, coarsest = -1;
  for (const FrameRecord& f : frames)
    for (const float layer : f.layers) {
      if (layer < 0) continue;
      finest = coarsest < 0 ? layer : std::min(finest, layer);
      coarsest = std::max(coarsest, layer);
    }
  if (coarsest < 0) return {};
  return fmt::format("  layers  {:.2f} to {:.2f} of {} mesh(es) that have them\n", finest, coarsest,
                     summary.layered_meshes.size());
}

}  // namespace

std::string run_report_json(const RunSummary& summary, std::span<const FrameRecord> frames) {
  ordered_json report{{"rom", summary.rom},
                      {"board", summary.board},
                      {"engine", summary.engine},
                      {"width", summary.width},
                      {"height", summary.height},
                      {"ram_peak_bytes", summary.memory.ram_peak_bytes},
                      {"vram_bytes", summary.memory.vram_bytes},
                      {"rom_bytes", summary.memory.rom_bytes},
                      {"layered_meshes", summary.layered_meshes},
                      {"frames", ordered_json::array()}};
  for (const FrameRecord& f : frames) report["frames"].push_back(frame_json(f));
  return report.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string run_report_text(const RunSummary& summary, std::span<const FrameRecord> frames) {
  std::string text =
      fmt::format("{}: {} frame{} of {}x{} on board {}, engine {}\n", summary.rom, frames.size(),
                  frames.size() == 1 ? "" : "s", summary.width, summary.height, summary.board, summary.engine);
  if (frames.empty()) return text;
  double thin_ms = 0, longest_thin_ms = 0, engine_ms = 0, host_ms = 0;
  for (const FrameRecord& f : frames) {
    thin_ms += f.thin_ms, engine_ms += f.draw_ms, host_ms += f.host_ms;
    longest_thin_ms = std::max(longest_thin_ms, f.thin_ms);
  }
  const auto count = static_cast<double>(frames.size());
  const auto drawn = std::find_if(frames.rbegin(), frames.rend(),
                                  [](const FrameRecord& f) { return f.shown == firmware::Shown::kPicture; });
  const FrameRecord& last = drawn != frames.rend() ? *drawn : frames.back();
  const firmware::ThinningReport& t = last.firmware.thinning;
  if (t.meshes_in > 0) {
    text += fmt::format("  meshes  {} in the ROM, {} drawn\n", t.meshes_in, t.meshes_out);
    text += fmt::format("  faces   {} in the ROM, {} after thinning, {} on the screen\n", t.faces_in, t.faces_out,
                        last.firmware.faces_drawn);
    text += layers_text(summary, frames);
  }
  const firmware::SolidsReport& s = last.firmware.solids;
  if (solids_in(s) > 0)
    text += fmt::format("  solids  {} in sight of {}: {} high, {} medium, {} low, {} rough; {} faces\n",
                        solids_drawn(s), solids_in(s), s.drawn[0], s.drawn[1], s.drawn[2], s.drawn[3],
                        s.faces);
  if (t.meshes_in + solids_in(s) == 0) text += "  nothing was drawn\n";
  text += fmt::format(
      "  device  thinning {:.2f} ms a frame ({:.2f} ms the longest), drawing {:.2f} ms a frame, scan-out {:.2f} ms "
      "(virtual time)\n",
      thin_ms / count, longest_thin_ms, engine_ms / count, last.scanout_ms);
  text += fmt::format("  host    {:.2f} ms a frame\n", host_ms / count);
  text += fmt::format("  memory  {:.1f} KB of RAM at most, {:.1f} KB of VRAM, {:.1f} KB of ROM\n",
                      static_cast<double>(summary.memory.ram_peak_bytes) / 1e3,
                      static_cast<double>(summary.memory.vram_bytes) / 1e3,
                      static_cast<double>(summary.memory.rom_bytes) / 1e3);
  text += fmt::format("  CRC-32  {:08x} (last frame)\n", frames.back().crc32);
  text += pins_text(frames);
  if (t.quotas_missed > 0)
    text += fmt::format(
        "  {} mesh(es) kept more faces than their quota: every collapse left would turn a face over, make a sliver, "
        "break the surface, or pass a limit or lock of the author's{}\n",
        t.quotas_missed, t.meshes_layered > 0 ? ", or the quota lies beyond their last layer" : "");
  if (t.chains_refused > 0)
    text += fmt::format("  layers of {} mesh(es) contradict themselves and are not used; pack the model again\n",
                        t.chains_refused);
  if (t.layers_given_up) text += "  RAM was short: meshes were thinned without their layers\n";
  if (t.quota_halvings > 0)
    text += fmt::format("  RAM was short: level-3 quotas were halved {} time(s)\n", t.quota_halvings);
  if (t.meshes_unthinned > 0)
    text += fmt::format("  RAM was short: {} level-3 mesh(es) are drawn unthinned\n", t.meshes_unthinned);
  if (t.meshes_dropped > 0)
    text += fmt::format("  RAM was short: {} mesh(es) are not drawn, the first is number {}\n", t.meshes_dropped,
                        t.first_dropped);
  return text;
}

}  // namespace usuzumi::sim
