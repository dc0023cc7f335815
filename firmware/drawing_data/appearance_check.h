// Checks what version 1.1 of the container adds: textures, materials, and what meshes say of them and of methods.
// Private to this folder.
#pragma once

#include <cstdint>

#include "firmware/drawing_data/words.h"
#include "hal/status.h"

namespace usuzumi::firmware {

Status check_textures(const Words& words, const Sections& sections);
/// After check_textures().
Status check_materials(const Words& words, const Sections& sections);

/// The mesh's texture coordinates and its material, of a mesh of `vertices` whose descriptor stands at `at`. After
/// check_materials().
Status check_appearance(const Words& words, const Sections& sections, const format::MeshDescriptor& d,
                        std::uint32_t vertices, std::uint32_t at);
/// Its method, that method's settings, and its edge values.
Status check_method(const Words& words, const Sections& sections, const format::MeshDescriptor& d,
                    std::uint32_t vertices, std::uint32_t at);

}  // namespace usuzumi::firmware
