// What the mode button steps through: full, thinned, budget, and full again.
#pragma once

#include <cstdint>

#include "firmware/thinning/policy.h"

namespace usuzumi::firmware {

enum class DrawMode : std::uint8_t {
  kFull,     // nothing is thinned
  kThinned,  // as the authors of the drawing data allow
  kBudget,   // as above, with a face quota in place of the authors'
};
inline constexpr std::uint32_t kDrawModeCount = 3;

constexpr const char* draw_mode_name(DrawMode mode) {
  switch (mode) {
    case DrawMode::kFull: return "full";
    case DrawMode::kThinned: return "thinned";
    case DrawMode::kBudget: return "budget";
  }
  return "draw mode out of range";
}

/// The mode that these settings are.
constexpr DrawMode draw_mode_of(const ThinningSettings& settings) {
  if (!settings.enabled) return DrawMode::kFull;
  return settings.quota.kind == format::QuotaKind::kNone ? DrawMode::kThinned : DrawMode::kBudget;
}

/// The settings after `presses` of the button, which begins where `settings` are. A budget is that of `settings`, or
/// `budget` where they have none. Policies and placement stay.
constexpr ThinningSettings after_presses(const ThinningSettings& settings, std::uint32_t presses, const Quota& budget) {
  const auto first = static_cast<std::uint32_t>(draw_mode_of(settings));
  const auto mode = static_cast<DrawMode>((first + presses % kDrawModeCount) % kDrawModeCount);
  ThinningSettings result = settings;
  result.enabled = mode != DrawMode::kFull;
  if (mode == DrawMode::kThinned) result.quota = {};
  if (mode == DrawMode::kBudget && result.quota.kind == format::QuotaKind::kNone) result.quota = budget;
  return result;
}

}  // namespace usuzumi::firmware
