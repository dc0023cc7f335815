// Checks drawing data as a whole before anything of them is used. Private to this folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/drawing_data/words.h"
#include "hal/status.h"

namespace usuzumi::firmware {

/// Walks the records of the bare layout in [begin, end): mesh-max and as many records, nothing left over.
/// `may_be_none`: there may be no mesh, as where there are solids.
Status check_records(const Words& words, std::uint32_t begin, std::uint32_t end, bool may_be_none = false);

/// Checks the container that fills `rom`, at least a word long, and tells where its sections are.
Status check_container(std::span<const std::byte> rom, Sections& sections);

}  // namespace usuzumi::firmware
