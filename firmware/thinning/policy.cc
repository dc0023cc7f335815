#include "firmware/thinning/policy.h"

namespace usuzumi::firmware {
namespace {

constexpr std::uint64_t kMillion = 1'000'000;

/// SplitMix64: one multiply-xorshift chain per number, good in all bits, the same everywhere.
std::uint64_t next_random(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15u;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

bool contains(std::span<const std::uint32_t> rising, std::uint32_t number) {
  std::size_t low = 0, high = rising.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (rising[middle] < number) low = middle + 1; else high = middle;
  }
  return low < rising.size() && rising[low] == number;
}

}  // namespace

bool Decider::Draw::next() {
  // The high 32 bits scaled to [0, left): biased by less than 2^-16 for any number of meshes the format allows.
  const auto pick = static_cast<std::uint32_t>(((next_random(state) >> 32) * left) >> 32);
  --left;
  if (pick >= wanted) return false;
  --wanted;
  return true;
}

Decider::Decider(const ThinningSettings& settings, const LevelTotals& totals, const View& view)
    : settings_(settings), totals_(totals), view_(view) {
  const auto draw_of = [](const Policy& policy, std::uint32_t meshes) {
    const std::uint64_t wanted = (std::uint64_t{meshes} * policy.random_millionths + kMillion / 2) / kMillion;
    return Draw{static_cast<std::uint32_t>(wanted < meshes ? wanted : meshes), meshes, policy.seed};
  };
  delete_draw_ = draw_of(settings.delete_policy, totals.meshes[static_cast<std::size_t>(Level::kDelete)]);
  collapse_draw_ = draw_of(settings.collapse_policy, totals.meshes[static_cast<std::size_t>(Level::kCollapse)]);
}

Decision Decider::decide(const MeshView& mesh, std::uint32_t faces) {
  const auto keep = [](Reason reason) { return Decision{.action = Action::kKeep, .reason = reason}; };
  // Every mesh of a level takes its turn in that level's draw, so that one mesh's area does not shift the others' luck.
  const bool delete_taken = mesh.level == Level::kDelete && policy_takes(settings_.delete_policy, mesh, delete_draw_);
  const bool collapse_taken =
      mesh.level == Level::kCollapse && policy_takes(settings_.collapse_policy, mesh, collapse_draw_);
  if (mesh.level == Level::kUnset) return keep(Reason::kLevelUnset);
  if (mesh.level == Level::kKeep) return keep(Reason::kAuthorLevel);
  if (!settings_.enabled) return keep(Reason::kThinningOff);
  switch (mesh.level) {
    case Level::kDelete:
      if (mesh.telltale()) return keep(Reason::kTelltale);
      if (!delete_taken) return keep(Reason::kNotChosen);
      if (above_area(&settings_.delete_policy, mesh)) return keep(Reason::kAboveArea);
      return {.action = Action::kDelete};
    case Level::kCollapse: {
      if (!collapse_taken) return keep(Reason::kNotChosen);
      if (above_area(&settings_.collapse_policy, mesh)) return keep(Reason::kAboveArea);
      const FaceTarget target = face_target(mesh, faces);
      return {.action = Action::kCollapse,
              .placement = settings_.placement,
              .method = settings_.method_override.given ? settings_.method_override.method : mesh.method,
              .target_faces = target.whole,
              .target_fraction = target.fraction,
              .quota_given = settings_.quota.kind != format::QuotaKind::kNone ||
                             mesh.quota_kind != format::QuotaKind::kNone};
    }
    default:  // point and line
      if (above_area(nullptr, mesh)) return keep(Reason::kAboveArea);
      return {.action = mesh.level == Level::kPoint ? Action::kPoint : Action::kLine};
  }
}

bool Decider::policy_takes(const Policy& policy, const MeshView& mesh, Draw& draw) {
  switch (policy.kind) {
    case PolicyKind::kAlways:
    case PolicyKind::kBelowArea: return true;
    case PolicyKind::kChosen: return contains(policy.chosen, mesh.number);
    case PolicyKind::kRandom: return draw.next();
  }
  return false;
}

bool Decider::above_area(const Policy* policy, const MeshView& mesh) {
  float threshold = mesh.area_threshold_px;
  if (threshold < 0) {
    if (policy == nullptr || policy->kind != PolicyKind::kBelowArea) return false;
    threshold = policy->area_threshold_px;
  }
  return screen_area_px(mesh, view_, threshold, faces_measured_) > threshold;
}

Decider::FaceTarget Decider::face_target(const MeshView& mesh, std::uint64_t faces) const {
  const auto share = [faces](std::uint64_t value, std::uint64_t of) -> FaceTarget {
    const std::uint64_t product = faces * value;
    return {static_cast<std::uint32_t>(product / of), static_cast<float>(product % of) / static_cast<float>(of)};
  };
  if (settings_.quota.kind == format::QuotaKind::kFaces)
    return totals_.collapse_faces == 0 ? FaceTarget{} : share(settings_.quota.value, totals_.collapse_faces);
  const bool from_settings = settings_.quota.kind != format::QuotaKind::kNone;
  const auto kind = from_settings ? settings_.quota.kind : mesh.quota_kind;
  const std::uint32_t value = from_settings ? settings_.quota.value : mesh.quota;
  switch (kind) {
    case format::QuotaKind::kFaces: return {value, 0};
    case format::QuotaKind::kMillionths: return share(value, kMillion);
    case format::QuotaKind::kNone: break;
  }
  return share(kDefaultQuotaMillionths, kMillion);
}

}  // namespace usuzumi::firmware
