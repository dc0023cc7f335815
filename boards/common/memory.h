// The memories a board gives the device. On a board with 32-bit addresses each is an identity_region().
#pragma once

#include <cstddef>
#include <span>

#include "hal/memory_regions.h"

namespace usuzumi::boards {

struct BoardMemory {
  MemoryRegion rom;   // flash that begins with an image of drawing data; writable = false
  MemoryRegion ram;   // work area of the firmware: tables, thinned copy, room to thin in
  MemoryRegion vram;  // two pictures and depth; its base is a multiple of Display::kPictureAlignment
  std::span<std::byte> engine_work;  // of the software 3D engine, at a multiple of 64
};

}  // namespace usuzumi::boards
