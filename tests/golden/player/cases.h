// How the player plays one case of each kind.
#pragma once

#include <cstdint>
#include <string_view>

#include "boards/common/text_line.h"
#include "hal/status.h"
#include "tests/golden/player/bundle.h"
#include "tests/golden/player/player.h"

namespace usuzumi::golden {

/// Ends lines, passes them on and counts them.
class ResultSink {
 public:
  explicit ResultSink(LineSink& lines) : lines_(lines) {}

  void line(boards::TextLine& text) {
    ++count_;
    lines_.line(text.finish());
  }
  std::uint32_t count() const { return count_; }

 private:
  LineSink& lines_;
  std::uint32_t count_ = 0;
};

/// " 480 272 6307efc7" behind a name: width and height, or vertices and indices, and the CRC-32.
inline boards::TextLine& add_result(boards::TextLine& line, std::uint32_t first, std::uint32_t second,
                                    std::uint32_t crc) {
  return line.text(" ").number(first).text(" ").number(second).text(" ").hex(crc);
}

/// Draws case n, a scene, and prints the line of its picture. Errors: of the engine; kResourceExhausted for too little
/// VRAM; kDataLoss where the engine wrote outside its targets.
Status play_scene(const Bundle& bundle, std::uint32_t n, std::string_view name, const PlayerMemory& memory,
                  ResultSink& out);

/// Boots a device with case n, a run, draws its frames and prints a line for each, then one for every mesh of the RAM
/// copy. Errors: of the device; kResourceExhausted for too little RAM or VRAM.
Status play_run(const Bundle& bundle, std::uint32_t n, std::string_view name, const PlayerMemory& memory,
                ResultSink& out);

}  // namespace usuzumi::golden
