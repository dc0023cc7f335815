// Comparing pictures: what counts as a difference, what is told about it, and what cannot be compared.
#include "sim/image/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "sim/common/error.h"
#include "sim/image/png.h"

namespace usuzumi::sim {
namespace {

using ::testing::HasSubstr;

TEST(Compare, EqualPicturesAreTheSame) {
  const Image a(4, 3, 0x102030);
  const CompareReport report = compare_images(a, a);
  EXPECT_EQ(report.result, CompareResult::kSame);
  EXPECT_EQ(report.pixels_compared, 12u);
  EXPECT_EQ(report.pixels_differing, 0u);
  EXPECT_EQ(report.largest_difference, 0u);
  EXPECT_FALSE(report.first);
  EXPECT_FALSE(report.bounds);
  EXPECT_EQ(exit_code(report.result), 0);
}

TEST(Compare, TellsTheFirstPlaceTheBoundsAndTheLargestDifference) {
  const Image expected(10, 8, 0x102030);
  Image actual = expected;
  actual.at(7, 2) = 0x102031;
  actual.at(3, 5) = 0x10202A;
  actual.at(5, 5) = 0x122030;
  const CompareReport report = compare_images(expected, actual);
  EXPECT_EQ(report.result, CompareResult::kDiffer);
  EXPECT_EQ(report.pixels_differing, 3u);
  EXPECT_EQ(report.largest_difference, 6u);
  ASSERT_TRUE(report.first);
  EXPECT_EQ(report.first->x, 7u);
  EXPECT_EQ(report.first->y, 2u);
  EXPECT_EQ(report.first->expected, 0x102030u);
  EXPECT_EQ(report.first->actual, 0x102031u);
  EXPECT_EQ(report.bounds, (Rectangle{3, 2, 7, 5}));
  EXPECT_EQ(exit_code(report.result), 1);
}

TEST(Compare, MaxDiffIsTheLargestAllowedChannelDifference) {
  const Image expected(2, 2, 0x808080);
  Image actual = expected;
  actual.at(1, 1) = 0x7D8283;  // red 3 less, green 2 more, blue 3 more
  EXPECT_EQ(compare_images(expected, actual, {.max_diff = 2}).result, CompareResult::kDiffer);
  const CompareReport report = compare_images(expected, actual, {.max_diff = 3});
  EXPECT_EQ(report.result, CompareResult::kSame);
  EXPECT_EQ(report.largest_difference, 3u);
  EXPECT_EQ(report.pixels_differing, 0u);
}

TEST(Compare, MaxPixelsIsTheLargestAllowedNumberOfDifferingPixels) {
  const Image expected(3, 1, 0);
  Image actual = expected;
  actual.at(0, 0) = actual.at(2, 0) = 0xFFFFFF;
  EXPECT_EQ(compare_images(expected, actual, {.max_pixels = 1}).result, CompareResult::kDiffer);
  const CompareReport report = compare_images(expected, actual, {.max_pixels = 2});
  EXPECT_EQ(report.result, CompareResult::kSame);
  EXPECT_EQ(report.pixels_differing, 2u) << "still told";
}

TEST(Compare, IgnoredRectanglesIncludeBothCorners) {
  const Image expected(6, 6, 0);
  Image actual = expected;
  for (std::uint32_t y = 2; y <= 4; ++y)
    for (std::uint32_t x = 1; x <= 3; ++x) actual.at(x, y) = 0x00FF00;
  const CompareReport report = compare_images(expected, actual, {.ignore = {{1, 2, 3, 3}, {0, 4, 5, 4}}});
  EXPECT_EQ(report.result, CompareResult::kSame);
  EXPECT_EQ(report.pixels_compared, 36u - 6 - 6);
  EXPECT_EQ(compare_images(expected, actual, {.ignore = {{1, 2, 3, 3}, {0, 4, 2, 4}}}).pixels_differing, 1u);
  EXPECT_EQ(compare_images(expected, actual, {.ignore = {{0, 1, 100000, 100000}}}).pixels_compared, 6u) << "clipped";
}

TEST(Compare, PicturesOfWhichNothingIsLookedAtCannotBeCompared) {
  const Image picture(6, 4, 0);
  EXPECT_EQ(compare_images(picture, picture, {.ignore = {{0, 0, 5, 2}}}).result, CompareResult::kSame);
  for (const std::vector<Rectangle>& all : {std::vector<Rectangle>{{0, 0, 5, 3}}, {{0, 0, 2, 9}, {3, 0, 9, 3}}}) {
    const CompareReport report = compare_images(picture, picture, {.ignore = all});
    EXPECT_EQ(report.result, CompareResult::kCannotCompare);
    EXPECT_THAT(report.reason, HasSubstr("no pixel"));
  }
}

TEST(Compare, RectanglesOutsideThePictureAreMistakes) {
  const Image picture(6, 4, 0);
  EXPECT_EQ(compare_images(picture, picture, {.ignore = {{5, 3, 5, 3}}}).result, CompareResult::kSame);
  for (const Rectangle outside : {Rectangle{6, 0, 9, 3}, Rectangle{0, 4, 5, 9}}) {
    const CompareReport report = compare_images(picture, picture, {.ignore = {outside}});
    EXPECT_EQ(report.result, CompareResult::kCannotCompare);
    EXPECT_THAT(report.reason, HasSubstr("outside the picture of 6x4"));
  }
}

TEST(Compare, UpperByteOfAPixelDoesNotCount) {
  EXPECT_EQ(compare_images(Image(1, 1, 0xFF000001), Image(1, 1, 0x00000001)).result, CompareResult::kSame);
}

TEST(Compare, DifferentSizesCannotBeCompared) {
  const CompareReport report = compare_images(Image(4, 3), Image(3, 4));
  EXPECT_EQ(report.result, CompareResult::kCannotCompare);
  EXPECT_THAT(report.reason, HasSubstr("expected 4x3, actual 3x4"));
  EXPECT_EQ(exit_code(report.result), 2);
}

TEST(ParseRectangle, TakesTwoCornersAndNothingElse) {
  EXPECT_EQ(parse_rectangle("10:20-30:40"), (Rectangle{10, 20, 30, 40}));
  EXPECT_EQ(parse_rectangle("0:0-0:0"), (Rectangle{0, 0, 0, 0}));
  for (const char* bad : {"", "1", "1:2", "1:2-3", "1:2-3:", "1:2-3:4 ", " 1:2-3:4", "1:2-3:4x", "a:2-3:4", "1,2-3,4",
                          "-1:2-3:4", "5:2-3:4", "1:5-3:4", "1:2-3:99999999999", "1:2-3:4-5:6"})
    EXPECT_FALSE(parse_rectangle(bad)) << bad;
}

TEST(DifferenceImage, ShowsDifferencesRedToleratedGreenIgnoredBlue) {
  const Image expected(4, 1, 0x303030);
  Image actual = expected;
  actual.at(1, 0) = 0x303032;
  actual.at(2, 0) = 0xFF3030;
  actual.at(3, 0) = 0xFFFFFF;
  const Image picture = difference_image(expected, actual, {.max_diff = 2, .ignore = {{3, 0, 3, 0}}});
  EXPECT_EQ(picture.at(0, 0), 0x101010u) << "a third of the expected grey";
  EXPECT_EQ(picture.at(1, 0), 0x008000u);
  EXPECT_EQ(picture.at(2, 0), (127u + 104u) << 16);
  EXPECT_EQ(picture.at(3, 0), 0x101060u);
}

TEST(CompareReport, TextAndJsonSayWhereExpectedAndActual) {
  const Image expected(10, 8, 0x102030);
  Image actual = expected;
  actual.at(7, 2) = 0xFF2031;
  const CompareReport report = compare_images(expected, actual);
  EXPECT_EQ(report_text(report),
            "differ: 1 of 80 pixels differ, largest channel difference 239\n"
            "first at x=7 y=2: expected #102030, actual #FF2031\n"
            "all within 7:2-7:2\n");
  const auto json = nlohmann::json::parse(report_json(report));
  EXPECT_EQ(json["result"], "differ");
  EXPECT_EQ(json["pixels_differing"], 1);
  EXPECT_EQ(json["largest_difference"], 239);
  EXPECT_EQ(json["first"]["x"], 7);
  EXPECT_EQ(json["first"]["actual"], "#FF2031");
  EXPECT_EQ(json["bounds"]["y1"], 2);
  EXPECT_TRUE(json["reason"].is_null());
}

TEST(CompareReport, SameAndCannotCompareAreOneLine) {
  EXPECT_EQ(report_text(compare_images(Image(2, 2), Image(2, 2))), "same: every pixel is equal\n");
  EXPECT_EQ(report_text(compare_images(Image(2, 2), Image(2, 1))),
            "cannot compare: sizes differ: expected 2x2, actual 2x1; draw both at one size\n");
  const auto json = nlohmann::json::parse(report_json(compare_images(Image(2, 2), Image(2, 2))));
  EXPECT_EQ(json["result"], "same");
  EXPECT_TRUE(json["first"].is_null());
}

TEST(CompareFiles, WritesTheDifferencePictureAndRefusesWhatItCannotRead) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "usuzumi_compare_files";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  write_png(folder / "a.png", Image(3, 3, 0));
  write_png(folder / "b.png", Image(3, 3, 0xFF));
  EXPECT_EQ(compare_png_files(folder / "a.png", folder / "b.png", {}, folder / "d.png").result, CompareResult::kDiffer);
  EXPECT_EQ(read_png(folder / "d.png").at(1, 1), 0xFF0000u);
  const CompareReport missing = compare_png_files(folder / "a.png", folder / "missing.png");
  EXPECT_EQ(missing.result, CompareResult::kCannotCompare);
  EXPECT_THAT(missing.reason, HasSubstr("missing.png"));
  write_png(folder / "small.png", Image(3, 2, 0));
  const CompareReport sizes = compare_png_files(folder / "a.png", folder / "small.png", {}, folder / "none.png");
  EXPECT_THAT(sizes.reason, ::testing::AllOf(HasSubstr("a.png"), HasSubstr("small.png: sizes differ")));
  EXPECT_FALSE(std::filesystem::exists(folder / "none.png"));
  EXPECT_THROW(compare_png_files(folder / "a.png", folder / "b.png", {}, folder / "no" / "d.png"), Error);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace usuzumi::sim
