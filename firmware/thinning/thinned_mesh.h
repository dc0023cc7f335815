// Blocks of the RAM copy for level 3. Private to this folder.
#pragma once

#include <cstdint>

#include "firmware/drawing_data/mesh_view.h"
#include "firmware/thinning/mesh_builder.h"
#include "firmware/thinning/policy.h"
#include "firmware/thinning/ram_copy.h"
#include "hal/clock.h"

namespace usuzumi::firmware {

/// Thins the mesh at the start of the free memory with the method's scratch behind it, and adds what is left of it to
/// the copy. False, with nothing added, where there is no room to work in.
bool copy_thinned(const MeshView& mesh, std::uint32_t faces, const Decision& decision, RamCopy& copy, Clock& clock,
                  BuildReport& report);

/// Bytes that the mesh unpacked takes beside its streams, without the method's scratch.
std::uint64_t unpacked_bytes(const MeshView& mesh, std::uint32_t faces, const Decision& decision, const RamCopy& copy);

}  // namespace usuzumi::firmware
