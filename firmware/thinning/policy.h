// Which meshes are thinned: the policies of JP2015-22462A [0014] and [0015], and the face quota of level 3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/layers/layer_choice.h"
#include "firmware/simplify/simplify.h"
#include "firmware/thinning/screen_area.h"

namespace usuzumi::firmware {

/// What a policy chooses among are the meshes that carry its level. An area threshold that the author gave a mesh is a
/// limit under every policy: above it the mesh is kept.
enum class PolicyKind : std::uint8_t {
  kAlways,     // all of them
  kBelowArea,  // those whose area on the screen is at most the author's threshold, or the policy's where there is none
  kChosen,     // the named ones
  kRandom,     // a random subset, the same for the same seed
};

struct Policy {
  PolicyKind kind = PolicyKind::kAlways;
  float area_threshold_px = 0;            // kBelowArea
  std::span<const std::uint32_t> chosen;  // kChosen: mesh numbers, rising
  std::uint32_t random_millionths = 0;    // kRandom: the share that is thinned, rounded to the nearest mesh
  std::uint32_t seed = 1;                 // kRandom
};

/// A face quota from outside the drawing data. kFaces is one budget over all level-3 meshes, shared by their face
/// counts. A mesh that a policy passes over keeps its share and is drawn whole, so that the budget is exceeded by it:
/// another mesh's quota does not change with what the policy does to this one, and nothing else is thinned anew for it.
struct Quota {
  format::QuotaKind kind = format::QuotaKind::kNone;
  std::uint32_t value = 0;
};

/// A level-3 mesh without any quota keeps half of its faces. The number is arbitrary; authors are meant to give their
/// own.
inline constexpr std::uint32_t kDefaultQuotaMillionths = 500'000;

/// A method for all level-3 meshes, whatever their authors said. An author's settings count where the method is theirs.
struct MethodOverride {
  bool given = false;
  Method method = Method::kQem;
};

/// How level-3 meshes that have a chain of layers are drawn. A chain serves where it was made by the method that the
/// mesh is to be thinned by; the others are thinned by that method, as if they had none.
enum class LayerMode : std::uint8_t {
  kFaces,      // with the faces of their quota, by replaying collapses; a quota beyond the last layer by the method
  kQuota,      // in the middle layer that their quota falls on: nothing jumps while a quota changes
  kAutomatic,  // in the layer that choose_layer() takes; their quota, where anybody has given one, is the coarsest
};

struct LayerSettings {
  LayerMode mode = LayerMode::kFaces;
  LayerChoiceSettings choice;  // kAutomatic
  Attention attention;         // kAutomatic
};

struct ThinningSettings {
  bool enabled = true;      // off: every mesh is kept
  Policy delete_policy;     // level 2
  Policy collapse_policy;   // level 3
  Quota quota;              // replaces the authors' quotas where its kind is not kNone
  Placement placement = Placement::kOptimal;
  MethodOverride method_override;
  LayerSettings layers;
};

enum class Action : std::uint8_t { kKeep, kDelete, kCollapse, kPoint, kLine };
inline constexpr std::size_t kActionCount = 5;

/// Why a mesh is treated as it is.
enum class Reason : std::uint8_t {
  kAuthorLevel,      // as its level says
  kLevelUnset,       // no level: kept ([0022])
  kThinningOff,
  kAboveArea,        // level 2 to 5, but larger on the screen than the threshold
  kNotChosen,        // the policy passed it over
  kTelltale,         // level 2, but a telltale is never deleted
};
inline constexpr std::size_t kReasonCount = 6;

struct Decision {
  Action action = Action::kKeep;
  Reason reason = Reason::kAuthorLevel;
  Placement placement = Placement::kOptimal;  // kCollapse by Method::kQem
  Method method = Method::kQem;               // kCollapse, with the settings in the drawing data
  std::uint32_t target_faces = 0;             // kCollapse
  float target_fraction = 0;                  // of a face: what rounding took off the quota; middle layers have it
  bool quota_given = false;                   // kCollapse: by the settings or the author, not the default
  bool layered = false;                       // kCollapse, by the mesh's chain of layers: the copy holds all of it
  bool vertices_move = false;                 // of layered
  /// Whether the RAM copy of a mesh decided so is the same; the reason does not change the copy.
  bool same_copy(const Decision& other) const {
    if (action != other.action || layered != other.layered) return false;
    if (action != Action::kCollapse) return true;
    if (layered) return vertices_move == other.vertices_move;
    return target_faces == other.target_faces && placement == other.placement && method == other.method;
  }
};

/// Counts over the drawing data that policies share among meshes.
struct LevelTotals {
  std::uint32_t meshes[kLevelCount] = {};
  std::uint64_t collapse_faces = 0;  // proper faces of all level-3 meshes
};

/// Decides mesh by mesh, in rising order of number: a random subset is drawn as the meshes go by.
class Decider {
 public:
  Decider(const ThinningSettings& settings, const LevelTotals& totals, const View& view);
  /// `faces` is the mesh's proper_face_count().
  Decision decide(const MeshView& mesh, std::uint32_t faces);

  std::uint64_t faces_measured() const { return faces_measured_; }

 private:
  /// Selection sampling (Knuth, The Art of Computer Programming vol. 2, 3.4.2, algorithm S): exactly `wanted` of
  /// `left`.
  struct Draw {
    std::uint32_t wanted = 0, left = 0;
    std::uint64_t state = 0;
    bool next();
  };

  struct FaceTarget {
    std::uint32_t whole = 0;
    float fraction = 0;
  };

  bool policy_takes(const Policy& policy, const MeshView& mesh, Draw& draw);
  bool above_area(const Policy* policy, const MeshView& mesh);
  FaceTarget face_target(const MeshView& mesh, std::uint64_t faces) const;

  const ThinningSettings& settings_;
  const LevelTotals& totals_;
  const View& view_;
  Draw delete_draw_, collapse_draw_;
  std::uint64_t faces_measured_ = 0;
};

}  // namespace usuzumi::firmware
