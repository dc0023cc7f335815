// Checks section SOLD before anything of it is used. Private to this folder.
#pragma once

#include "firmware/drawing_data/words.h"
#include "firmware/solids/solids_view.h"
#include "hal/status.h"

namespace usuzumi::firmware {

/// The section as it lies there, or nothing where there is none. After check_solids().
SolidsView solids_of(const Words& words, const Sections& sections);

/// kDataLoss with the byte offset in the file.
Status check_solids(const Words& words, const Sections& sections);

}  // namespace usuzumi::firmware
