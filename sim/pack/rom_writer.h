// A model as drawing data in ROM: the container, or the patent's bare layout. firmware/drawing_data/format.h is the
// law.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// How texels are stored. kAuto loses nothing: kXrgb8888, or kArgb8888 where alpha is not full everywhere.
enum class TexelChoice { kAuto, kRgb565, kXrgb8888, kArgb8888 };

struct RomOptions {
  std::string board = {};  // the only one that will take it; empty for any
  TexelChoice texels = TexelChoice::kAuto;
  bool mips = true;  // all levels of each texture; the first alone where false
};

/// The container: one record per mesh, indexed, with normals, colours, texture coordinates, quotas, thresholds,
/// methods, names and chains of layers, and the model's materials and textures. The same model gives the same bytes.
/// Throws Error kBadInput where the format's bounds are exceeded.
std::vector<std::byte> write_container(const Model& model, const RomOptions& options = {});

/// A texture's format in ROM. One whose alpha is not full everywhere is kArgb8888 whatever the choice.
command::TextureFormat stored_format(const Picture& picture, TexelChoice choice);

/// The patent's layout alone: per mesh one triangle strip that draws every face of it with its winding, joined by faces
/// without area. Positions and levels survive, nothing else.
std::vector<std::byte> write_bare(const Model& model);

}  // namespace usuzumi::sim
