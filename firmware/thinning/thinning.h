// Thinning of the whole drawing data into the RAM copy: the flow of JP2015-22462A figures 6 (S601-S607) and 7.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/thinning/layer_table.h"
#include "firmware/thinning/layered_mesh.h"
#include "firmware/thinning/mesh_builder.h"
#include "firmware/thinning/policy.h"
#include "firmware/thinning/ram_copy.h"
#include "hal/arena.h"
#include "hal/clock.h"
#include "hal/status.h"

namespace usuzumi::firmware {

/// Why an update thinned, or did not.
enum class UpdateCause : std::uint8_t {
  kFirst,       // there was no copy yet
  kDecisions,   // settings, or a mesh's area on the screen, ask for another copy of some mesh
  kLayers,      // meshes were moved along their layers, none was built
  kUnchanged,   // nothing asks for another copy: nothing was thinned
};

struct ThinningReport {
  UpdateCause cause = UpdateCause::kFirst;
  std::uint32_t meshes_in = 0;        // MESH_MAX
  std::uint32_t meshes_out = 0;       // NEW_MESH_MAX
  std::uint64_t faces_in = 0;         // proper ones, as MeshView counts them; so are those of the copy
  std::uint64_t faces_out = 0;        // in the copy
  std::uint32_t actions[kActionCount] = {};   // how many meshes each Action was decided for
  std::uint32_t kept_for[kReasonCount] = {};  // those kept, by Reason
  std::uint32_t meshes_built = 0;     // copied or thinned by this update; the rest of the copy was left as it stood
  std::uint32_t meshes_collapsed = 0; // of these, by level 3
  std::uint32_t quotas_missed = 0;    // in the copy: collapsed as far as their surface allows, above the quota
  std::uint32_t meshes_unthinned = 0; // in the copy as they are because there was no room to thin them
  std::uint32_t meshes_dropped = 0;   // not in the copy for want of RAM
  std::uint32_t first_dropped = 0;    // the first such mesh's number, if meshes_dropped > 0
  std::uint32_t meshes_layered = 0;   // in the copy with their chain of layers
  std::uint32_t meshes_moved = 0;     // of these, along their chain by this update
  std::uint32_t chains_refused = 0;   // contradict themselves, so that the mesh is thinned without
  bool layers_given_up = false;       // meshes are thinned without their chains for want of RAM
  std::uint32_t quota_halvings = 0;   // how often every level-3 quota was halved to make the copy fit
  std::uint64_t copy_bytes = 0;
  std::uint64_t bytes_left_in_rom = 0;  // vertices of thinned meshes that are drawn from ROM, not part of the copy
  std::uint64_t peak_bytes = 0;       // of the copy's memory, working space included
  float max_error = 0;                // largest of the meshes collapsed by this update, model units
};

/// What stands in the copy for one mesh, and why.
struct MeshState {
  Decision decision;
  BuildReport build;
  std::uint32_t record_offset = 0;
  std::uint32_t faces = 0;  // proper ones of the mesh in ROM, counted once
  bool wanted = false;  // scratch of an update: to be built
  bool built = false;   // by the last update
  bool known = false;   // decision and build are those of the copy
};

/// Keeps the RAM copy in step with settings and view.
class Thinning {
 public:
  /// Takes tables and the copy's memory from `ram`, all of it that is left. `data` must outlive this.
  /// `rom_on_bus`: the 3D engine reads `data` where they lie. Meshes that their method thins without new vertices are
  /// then drawn with the vertices in ROM wherever that takes less RAM.
  /// `boot_layers`: quotas of layers (layer_quotas_fall()) to make for those level-3 meshes that ROM has none for, in
  /// their order, as long as what is left of RAM holds every mesh whole, layered ones with their chain's block, and
  /// what thinning any one takes. Takes as long as thinning them to the last quota. kInvalidArgument: the quotas do not
  /// fall.
  Status begin(const DrawingData& data, Arena& ram, bool rom_on_bus = false,
               std::span<const std::uint32_t> boot_layers = {});

  /// Decides every mesh anew and rebuilds those whose copy would differ. On return the copy is complete and sound.
  /// Meshes with layers are then moved along them: no mesh is built for that.
  /// The copy is that of a device with plenty of memory or, where something was given up, of this one just started: no
  /// earlier frame has a part in it, but for the layers of LayerMode::kAutomatic and normals that there was no room to
  /// make.
  /// When memory runs short, meshes are first thinned without their layers, as their blocks are larger than a thinned
  /// copy. Then level-2 meshes that are to be drawn are left out: their authors allow their loss, but nobody fewer
  /// faces than a quota. Then the quotas of level 3 are halved, up to four times; then level-3 meshes
  /// are left out, then points and lines. kResourceExhausted, with the mesh's number: a level-1 mesh, a mesh without a
  /// level or a telltale found no room; the copy then holds what fitted, and must not be taken for the picture.
  Status update(const ThinningSettings& settings, const View& view, Clock& clock, ThinningReport& report);

  const RamCopy& copy() const { return copy_; }
  const MeshState& state(std::uint32_t n) const { return states_[n]; }
  /// The chain of layers that mesh n has, in ROM or made at boot; null where it has none.
  const LayeredMesh* layers(std::uint32_t n) const { return layers_.find(n); }
  /// The layer that mesh n is drawn in, between two where it is a fraction (LayeredMesh::place); negative where it is
  /// not drawn from its layers.
  float drawn_layer(std::uint32_t n) const;
  const DrawingData& data() const { return *data_; }

 private:
  /// Who is built, and kept, before whom.
  enum Priority : std::uint32_t { kMust, kMark, kCollapsible, kDeletable, kPriorityCount };
  static Priority priority(const MeshView& mesh);

  MeshView view_of(std::uint32_t n) const { return data_->mesh_at(n, states_[n].record_offset); }
  void decide_layers(LayerMode mode, std::uint32_t n, Decision& decision);
  std::uint32_t move_along_layers(const LayerSettings& settings, const View& view, Clock& clock);
  void build_all(Clock& clock);
  BuildReport build(const MeshView& mesh, const Decision& decision, Clock& clock);
  bool short_of_room() const;
  bool same_copy(Decision was, Decision is) const;
  bool any_layered() const;
  bool decide_all(const ThinningSettings& settings, const View& view, Clock& clock);
  void build_wanted(Clock& clock);
  void build_one(const MeshView& mesh, Clock& clock);
  bool make_room(Priority below);
  bool dropped_any(Priority up_to) const;
  bool can_halve_quotas() const;
  void want_collapses();
  void count_decisions_and_builds(ThinningReport& report) const;
  bool sound() const;
  Status summarize(ThinningReport& report) const;

  const DrawingData* data_ = nullptr;
  RamCopy copy_;
  std::span<MeshState> states_;
  LayerTable layers_;
  LevelTotals totals_;
  std::uint64_t faces_in_ = 0;
  std::uint32_t quota_halvings_ = 0;
  bool layers_given_up_ = false;
  bool begun_ = false;
};

}  // namespace usuzumi::firmware
