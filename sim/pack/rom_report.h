// What is in a ROM, mesh by mesh, for people and for scripts.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "hal/status.h"

namespace usuzumi::sim {

/// Whether a ROM is sound, and its description. `rom` is 4-byte aligned.
struct RomReport {
  bool sound = false;
  std::string error;  // where unsound: what is wrong and where, one line
  std::string text;   // table for people; empty where unsound
  std::string json;   // one object, also where unsound: {"sound": false, "error": …, "offset": …}
};
RomReport describe_rom(std::span<const std::byte> rom, const std::string& file);

/// What DrawingData::open() found wrong with `rom`, with what to do about it: one line.
std::string unsound_line(std::span<const std::byte> rom, const std::string& file, const Status& status);

/// "0 unset", "1 keep", …
const char* level_label(unsigned level);

}  // namespace usuzumi::sim
