// Writes one frame's command list: the second half of JP2015-22462A fig. 6 (S608-S612), mesh 1 to NEW_MESH_MAX.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/solids/solid_choice.h"
#include "firmware/solids/solid_members.h"
#include "firmware/thinning/screen_area.h"
#include "firmware/thinning/thinning.h"
#include "hal/bus.h"
#include "hal/command_list.h"
#include "hal/status.h"

namespace usuzumi::firmware {

/// Light and background of a frame. The defaults suit a model seen from outside: light over the viewer's shoulder.
struct Lighting {
  Vec3 to_light{0, 0, 1};  // model space, unit length
  Vec3 ambient{0.25f, 0.25f, 0.25f};
  Vec3 diffuse{0.75f, 0.75f, 0.75f};
  Rgba8 background = rgba8(0, 0, 0);
};

/// Which members solids are drawn with.
struct SolidSettings {
  Thresholds thresholds;   // that fall; where they do not, the default
  float clip_margin = 0;   // SolidView: solids so far outside the picture are taken to be in sight
};

struct SolidsReport {
  std::uint32_t drawn[kMemberCount] = {};  // by member
  std::uint32_t clipped = 0;
  std::uint32_t faces = 0;  // told to the engine, as the paper counts: a quad is one
};

struct SolidsToDraw {
  SolidMembers& members;
  const SolidSettings& settings;
  SolidsReport& report;
};

struct FrameTarget {
  BusAddress picture = 0;
  std::uint32_t picture_stride_bytes = 0;
  command::PixelFormat format = command::PixelFormat::kXrgb8888;
  BusAddress depth = 0;
  std::uint32_t depth_stride_bytes = 0;
  command::DepthFormat depth_format = command::DepthFormat::kUnorm24;
};

/// Words that a list of all of the data's meshes and solids needs at most.
std::uint32_t scene_command_words(const DrawingData& data);

/// The list that draws the copy, in `words`: meshes in their order, then `solids` (null: none), then those parts of
/// meshes that are laid over others (format::AlphaMode::kBlend), in the same order, and without writing depth, so that
/// none of them hides another. Textures, and vertices that the copy leaves there, are read from ROM.
/// kResourceExhausted when it does not fit; kFailedPrecondition, with the mesh's or solid's number, when the copy, a
/// texture, vertices or members lie where the bus does not reach.
Result<std::span<const std::uint32_t>> write_scene(const Thinning& thinning, const View& view, const Lighting& lighting,
                                                   const FrameTarget& target, const AddressTranslation& bus,
                                                   std::span<std::uint32_t> words,
                                                   const SolidsToDraw* solids = nullptr);

}  // namespace usuzumi::firmware
