// Holds one picture against another: the library behind `usuzumi compare` and the golden tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/image/image.h"

namespace usuzumi::sim {

/// Pixels x0 .. x1, y0 .. y1, both ends included.
struct Rectangle {
  std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  constexpr bool contains(std::uint32_t x, std::uint32_t y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
  friend constexpr bool operator==(const Rectangle&, const Rectangle&) = default;
};

/// "x0:y0-x1:y1", both corners included: "10:20-30:40". nullopt when it is anything else or x1 < x0 or y1 < y0.
std::optional<Rectangle> parse_rectangle(std::string_view text);

struct CompareOptions {
  std::uint32_t max_diff = 0;      // a pixel is the same when no channel differs by more
  std::uint64_t max_pixels = 0;    // the pictures are the same when no more pixels differ
  std::vector<Rectangle> ignore{};  // not looked at; each begins inside the picture, parts beyond its edge do no harm
};

enum class CompareResult { kSame, kDiffer, kCannotCompare };

struct DifferingPixel {
  std::uint32_t x = 0, y = 0;
  std::uint32_t expected = 0, actual = 0;  // 0x00RRGGBB
};

struct CompareReport {
  CompareResult result = CompareResult::kSame;
  std::string reason;                          // why they cannot be compared
  std::uint64_t pixels_compared = 0;           // outside the ignored parts
  std::uint64_t pixels_differing = 0;          // by more than max_diff
  std::uint32_t largest_difference = 0;        // of any channel of any pixel compared
  std::optional<DifferingPixel> first;         // of the differing ones, in reading order
  std::optional<Rectangle> bounds;             // around all differing ones
};

/// 0 same, 1 differ, 2 cannot compare.
int exit_code(CompareResult result);

/// Never throws for pictures' sake: different sizes, an ignored rectangle outside the picture and no pixel left to look
/// at are kCannotCompare.
CompareReport compare_images(const Image& expected, const Image& actual, const CompareOptions& options = {});

/// The same from PNG files, which the reason names; unreadable ones are kCannotCompare with the reader's sentence as
/// it.
CompareReport compare_png_files(const std::filesystem::path& expected, const std::filesystem::path& actual,
                                const CompareOptions& options = {},
                                const std::optional<std::filesystem::path>& difference_picture = std::nullopt);

/// The expected picture in dim grey; differing pixels from dark red (by 1) to bright red (by 255), pixels that differ
/// within max_diff in green, ignored parts tinted blue. The pictures have one size.
Image difference_image(const Image& expected, const Image& actual, const CompareOptions& options = {});

/// For people: one line when same or not comparable, a few otherwise, each ended by a line break.
std::string report_text(const CompareReport& report);
/// One JSON object: result, reason, pixels_compared, pixels_differing, largest_difference, first {x, y, expected,
/// actual}, bounds {x0, y0, x1, y1}; colours as "#RRGGBB", absent things as null.
std::string report_json(const CompareReport& report);

}  // namespace usuzumi::sim
