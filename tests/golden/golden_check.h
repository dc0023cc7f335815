// Judges a picture: against its golden, exactly; against another engine's, within a tolerance.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "sim/image/image.h"
#include "tests/golden/golden_store.h"

namespace usuzumi::golden {

/// `report` says what is wrong, where, and which files show it; empty when `ok`.
struct Verdict {
  bool ok = true;
  std::string report;
};

/// Every pixel and the CRC-32 as in the store. A scene without a golden fails. On failure the pictures actual, expected
/// and difference are written to `failures`.
Verdict check_golden(const Store& store, const std::string& scene, const sim::Image& actual,
                     const std::filesystem::path& failures);

/// One engine's pictures of a scene over two backgrounds that differ in every channel: a pixel is covered when both
/// agree.
struct TwoBackgrounds {
  sim::Image first, second;
  bool covered(std::uint32_t x, std::uint32_t y) const { return first.at(x, y) == second.at(x, y); }
};

/// How two engines' drawings of one scene differ.
struct PeerComparison {
  std::size_t covered = 0;           // pixels that at least one engine covers
  std::size_t covered_by_one = 0;    // ... and the other does not
  std::size_t compared = 0;          // covered by both
  std::size_t beyond_tolerance = 0;  // ... with a channel further apart than the tolerance
  std::uint32_t worst = 0;           // largest difference of a channel
  std::string first_coverage, first_colour;  // the first such pixel and its colours; empty where there is none

  /// What the golden tests allow: 0.05 % of the covered pixels, and 0.5 % of those compared where nobody says more.
  bool coverage_ok() const { return covered_by_one * 2000 <= covered; }
  bool colour_ok(std::uint32_t per_mille = 5) const { return beyond_tolerance * 1000 <= compared * per_mille; }

  /// Sums of both, the first places of the first that has any.
  PeerComparison& operator+=(const PeerComparison& other);
};
inline constexpr std::uint32_t kChannelTolerance = 2;  // of 255

PeerComparison compare_with_peer(const TwoBackgrounds& ours, const TwoBackgrounds& peers,
                                 std::uint32_t tolerance = kChannelTolerance);

}  // namespace usuzumi::golden
