// Numbers that follow from the timing registers (hal/registers/display.h has the fields and the rule of legality).
#pragma once

#include <cstdint>

#include "hal/registers/display.h"

namespace usuzumi::gfx {

/// What the timing makes of one line of the frame.
enum class LineKind : std::uint8_t { kPicture, kBlank, kVerticalSync };

/// A legal timing in plain counts.
struct ScanGeometry {
  std::uint32_t width = 0, height = 0;                  // pixels, lines of picture
  std::uint32_t front_porch = 0, sync = 0, back_porch = 0;  // pixels
  std::uint32_t line_pixels = 0, frame_lines = 0;
  std::uint32_t vsync_line = 0, vsync_lines = 0;        // first line with VSYNC and how many
  std::uint32_t divider = 1;                            // reference ticks per pixel

  constexpr std::uint64_t line_ticks() const { return std::uint64_t{line_pixels} * divider; }
  constexpr std::uint64_t frame_ticks() const { return line_ticks() * frame_lines; }
  constexpr LineKind kind(std::uint32_t line) const {
    if (line < height) return LineKind::kPicture;
    return line >= vsync_line && line - vsync_line < vsync_lines ? LineKind::kVerticalSync : LineKind::kBlank;
  }
};

constexpr ScanGeometry scan_geometry(const display_registers::Timing& t) {
  return {.width = t.hdp + 1,
          .height = t.vdp + 1,
          .front_porch = t.hsp - t.hdp,
          .sync = t.hsw + 1,
          .back_porch = t.htp - (t.hsp + t.hsw + 1),
          .line_pixels = t.htp + 1,
          .frame_lines = t.vtr + 1,
          .vsync_line = t.vsp + 1,
          .vsync_lines = t.vsw + 1,
          .divider = t.sc + 1};
}

}  // namespace usuzumi::gfx
