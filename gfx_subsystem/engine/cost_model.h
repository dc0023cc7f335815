// Engine clocks that a command list takes: the table below times what the engine counted. Counts do not depend on
// threads, SIMD width or which Engine runs, and so neither does the time.
//
// The numbers are those of a plausible small fixed-function part, not of any one product: a front end that reads a
// command word per clock, a vertex unit of one multiply-add lane (a 4x4 transform is 16 of them, light and divide
// overlap the next vertex), a set-up unit of 24 clocks, one tested pixel per clock and a 64-bit path that fills four
// pixels a clock in clears. Its texture unit fetches before it is known whether the pixel is hidden, two texels a clock
// over the same path without a cache, and a pixel that is blended costs a clock more, to read what is there. The stages
// overlap in such a part; here their clocks are added, which is the upper bound.
#pragma once

#include <cstdint>

#include "gfx_subsystem/engine/engine.h"

namespace usuzumi::gfx {

/// Engine clock of the desk machine; other boards state their own.
inline constexpr std::uint64_t kEngineClockHz = 200'000'000;

struct EngineCosts {         // engine clocks
  std::uint64_t list = 200;  // doorbell, first fetch, interrupt
  std::uint64_t command_word = 1;
  std::uint64_t vertex = 16;
  std::uint64_t primitive = 4;    // assembly, trivial rejection and culling of each one submitted
  std::uint64_t face_drawn = 24;  // set-up of each triangle that reaches the rasterizer
  std::uint64_t pixel_tested = 1;
  std::uint64_t pixels_cleared_per_clock = 4;
  std::uint64_t texels_fetched_per_clock = 2;
  std::uint64_t pixel_blended = 1;
};
inline constexpr EngineCosts kEngineCosts{};

/// No overflow for counts below 2^59.
constexpr std::uint64_t engine_cycles(const EngineCounters& c) {
  constexpr EngineCosts k = kEngineCosts;
  return k.list + k.command_word * c.command_words + k.vertex * c.vertices_transformed + k.primitive * c.primitives_in +
         k.face_drawn * c.faces_drawn + k.pixel_tested * c.pixels_tested +
         (c.pixels_cleared + k.pixels_cleared_per_clock - 1) / k.pixels_cleared_per_clock +
         (c.texels_fetched + k.texels_fetched_per_clock - 1) / k.texels_fetched_per_clock +
         k.pixel_blended * c.pixels_blended;
}

}  // namespace usuzumi::gfx
