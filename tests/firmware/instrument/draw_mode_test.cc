#include "firmware/instrument/draw_mode.h"

#include <gtest/gtest.h>

namespace usuzumi {
namespace {

using namespace firmware;
using format::QuotaKind;

constexpr Quota kBudget{QuotaKind::kMillionths, 250'000};

TEST(DrawMode, CyclesFullThinnedBudgetFromWhereverItBegins) {
  const ThinningSettings authors;
  EXPECT_EQ(draw_mode_of(after_presses(authors, 0, kBudget)), DrawMode::kThinned);
  EXPECT_EQ(draw_mode_of(after_presses(authors, 1, kBudget)), DrawMode::kBudget);
  EXPECT_EQ(draw_mode_of(after_presses(authors, 2, kBudget)), DrawMode::kFull);
  EXPECT_EQ(draw_mode_of(after_presses(authors, 3, kBudget)), DrawMode::kThinned);
  ThinningSettings full;
  full.enabled = false;
  EXPECT_EQ(draw_mode_of(after_presses(full, 1, kBudget)), DrawMode::kThinned);
  EXPECT_EQ(draw_mode_of(after_presses(full, 0xFFFFFFFFu, kBudget)), DrawMode::kFull) << "2^32 - 1 is a multiple of 3";
}

TEST(DrawMode, ABudgetOfTheRequestsOwnIsKeptAndComesBack) {
  ThinningSettings own;
  own.quota = {QuotaKind::kFaces, 1000};
  EXPECT_EQ(after_presses(own, 0, kBudget).quota.value, 1000u);
  EXPECT_FALSE(after_presses(own, 1, kBudget).enabled);
  EXPECT_EQ(after_presses(own, 2, kBudget).quota.kind, QuotaKind::kNone);
  EXPECT_EQ(after_presses(own, 3, kBudget).quota.value, 1000u);
  EXPECT_EQ(after_presses({}, 1, kBudget).quota.value, 250'000u);
}

TEST(DrawMode, PoliciesAndPlacementStay) {
  ThinningSettings settings;
  settings.placement = Placement::kMidpoint;
  settings.delete_policy = {PolicyKind::kBelowArea, 12, {}, 0, 1};
  for (std::uint32_t presses = 0; presses < 3; ++presses) {
    const ThinningSettings after = after_presses(settings, presses, kBudget);
    EXPECT_EQ(after.placement, Placement::kMidpoint);
    EXPECT_EQ(after.delete_policy.area_threshold_px, 12);
  }
}

}  // namespace
}  // namespace usuzumi
