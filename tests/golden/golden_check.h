// Judges a picture: against its golden, exactly; against another engine's, within a tolerance.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "tests/golden/golden_store.h"

namespace usuzumi::golden {

using scenes::RgbPicture;

/// `report` says what is wrong, where, and which files show it; empty when `ok`.
struct Verdict {
  bool ok = true;
  std::string report;
};

/// Every pixel and the CRC-32 as in the store. A scene without a golden fails. On failure the pictures actual, expected and
/// difference are written to `failures`.
Verdict check_golden(const Store& store, const std::string& scene, const RgbPicture& actual, const std::filesystem::path& failures);

/// Pixels where two pictures of one size differ.
struct Difference {
  std::size_t pixels = 0;
  std::uint32_t first_x = 0, first_y = 0;  // in scan order; only where pixels > 0
  int worst = 0;                           // largest difference of a channel
};
Difference compare_pictures(const RgbPicture& expected, const RgbPicture& actual);

/// Equal pixels dim, others the difference of each channel, from 64 up so that a difference of one is seen.
RgbPicture difference_picture(const RgbPicture& expected, const RgbPicture& actual);

/// One engine's pictures of a scene over two backgrounds that differ in every channel: a pixel is covered when both agree.
struct TwoBackgrounds {
  RgbPicture first, second;
  bool covered(std::uint32_t x, std::uint32_t y) const;
};

/// How two engines' drawings of one scene differ.
struct PeerComparison {
  std::size_t covered = 0;             // pixels that at least one engine covers
  std::size_t covered_by_one = 0;      // ... and the other does not
  std::size_t compared = 0;            // covered by both
  std::size_t beyond_tolerance = 0;    // ... with a channel more than kChannelTolerance apart
  int worst = 0;
  std::string first_coverage, first_colour;  // where, and both colours; empty where there is none

  /// Tolerances of the golden tests: 0.05 % of the covered pixels, and 0.5 % of those compared.
  bool coverage_ok() const { return covered_by_one * 2000 <= covered; }
  bool colour_ok() const { return beyond_tolerance * 200 <= compared; }
};
inline constexpr int kChannelTolerance = 2;

PeerComparison compare_with_peer(const TwoBackgrounds& ours, const TwoBackgrounds& peers);

}  // namespace usuzumi::golden
