// The judges judged: what must fail does, and says where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/golden/golden_check.h"
#include "tests/golden/golden_png.h"
#include "tests/golden/golden_store.h"

namespace usuzumi::golden {
namespace {

using testing::HasSubstr;

RgbPicture plain(std::uint32_t width, std::uint32_t height, std::uint8_t level) {
  return {width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 3, level)};
}

Entry entry_of(const std::string& scene, const RgbPicture& picture) {
  return {scene, picture.width, picture.height, scenes::picture_crc32(picture), "a note of words"};
}

class GoldenCheck : public testing::Test {
 protected:
  GoldenCheck() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / ("usuzumi-golden-" + std::string(test->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~GoldenCheck() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path failures() const { return folder_ / "failures"; }

  std::filesystem::path folder_;
};

TEST_F(GoldenCheck, CrcIsThatOfRgbBytesInScanOrder) {
  // "123456789" as three pixels: the check value of CRC-32/ISO-HDLC.
  EXPECT_EQ(scenes::picture_crc32({3, 1, {'1', '2', '3', '4', '5', '6', '7', '8', '9'}}), 0xCBF43926u);
}

TEST_F(GoldenCheck, ApprovedPictureIsReadBackAndPasses) {
  RgbPicture picture = plain(5, 4, 10);
  picture.rgb[7] = 200;
  Store(folder_).put(entry_of("02-b", plain(2, 2, 1)), plain(2, 2, 1));
  Store(folder_).put(entry_of("01-a", picture), picture);
  const Store store(folder_);
  ASSERT_EQ(store.entries().size(), 2u);
  EXPECT_EQ(store.entries()[0].scene, "01-a") << "sorted by scene";
  EXPECT_EQ(store.entries()[0].width, 5u);
  EXPECT_EQ(store.entries()[0].height, 4u);
  EXPECT_EQ(store.entries()[0].note, "a note of words");
  const Verdict verdict = check_golden(store, "01-a", picture, failures());
  EXPECT_TRUE(verdict.ok) << verdict.report;
}

TEST_F(GoldenCheck, MissingGoldenFailsAndLeavesTheActualPicture) {
  const Verdict verdict = check_golden(Store(folder_), "77-new", plain(3, 3, 9), failures());
  EXPECT_FALSE(verdict.ok);
  EXPECT_THAT(verdict.report, HasSubstr("has no golden"));
  EXPECT_THAT(verdict.report, HasSubstr("approve.sh 77-new"));
  EXPECT_EQ(read_png(failures() / "77-new.actual.png"), plain(3, 3, 9));
}

TEST_F(GoldenCheck, GoldenWithoutItsPngFails) {
  Store store(folder_);
  store.put(entry_of("01-a", plain(3, 3, 9)), plain(3, 3, 9));
  std::filesystem::remove(store.picture_path("01-a"));
  EXPECT_THAT(check_golden(store, "01-a", plain(3, 3, 9), failures()).report, HasSubstr("golden has no PNG"));
}

TEST_F(GoldenCheck, ManifestAndPngThatContradictEachOtherFail) {
  Store store(folder_);
  Entry entry = entry_of("01-a", plain(3, 3, 9));
  entry.crc32 ^= 1;
  store.put(entry, plain(3, 3, 9));
  EXPECT_THAT(check_golden(store, "01-a", plain(3, 3, 9), failures()).report, HasSubstr("its own PNG"));
}

TEST_F(GoldenCheck, OneWrongPixelFailsByItsPlaceAndLeavesThreePictures) {
  const RgbPicture expected = plain(4, 3, 100);
  RgbPicture actual = expected;
  actual.rgb[(2 * 4 + 1) * 3 + 2] = 101;  // blue of (1, 2)
  Store store(folder_);
  store.put(entry_of("01-a", expected), expected);
  const Verdict verdict = check_golden(store, "01-a", actual, failures());
  EXPECT_FALSE(verdict.ok);
  EXPECT_THAT(verdict.report, HasSubstr("1 pixels differ, by up to 1; first at (1, 2): expected #646464, actual #646465"));
  EXPECT_THAT(verdict.report, HasSubstr((failures() / "01-a.difference.png").string()));
  EXPECT_EQ(read_png(failures() / "01-a.actual.png"), actual);
  EXPECT_EQ(read_png(failures() / "01-a.expected.png"), expected);
  const RgbPicture difference = read_png(failures() / "01-a.difference.png");
  EXPECT_THAT(std::vector<int>(difference.pixel(1, 2), difference.pixel(1, 2) + 3), testing::ElementsAre(0, 0, 65));
  EXPECT_THAT(std::vector<int>(difference.pixel(0, 0), difference.pixel(0, 0) + 3), testing::ElementsAre(12, 12, 12));
}

TEST_F(GoldenCheck, PictureOfAnotherSizeFails) {
  Store store(folder_);
  store.put(entry_of("01-a", plain(4, 3, 1)), plain(4, 3, 1));
  EXPECT_THAT(check_golden(store, "01-a", plain(3, 4, 1), failures()).report, HasSubstr("is 3 x 4, golden is 4 x 3"));
}

TEST_F(GoldenCheck, ManifestLineThatCannotBeReadIsNamed) {
  std::ofstream(folder_ / "manifest.txt") << "# a comment\n\n01-a 3 3 0badcafe note\n02-b 3 three 0badcafe\n";
  EXPECT_THAT([&] { Store store(folder_); }, testing::ThrowsMessage<std::runtime_error>(HasSubstr("manifest.txt:4")));
  std::ofstream(folder_ / "manifest.txt") << "01-a 3 3 0badcafe\n01-a 3 3 0badcafe\n";
  EXPECT_THAT([&] { Store store(folder_); }, testing::ThrowsMessage<std::runtime_error>(HasSubstr("named twice")));
}

TEST_F(GoldenCheck, RemovedGoldenIsGoneFromManifestAndFolder) {
  Store store(folder_);
  store.put(entry_of("01-a", plain(4, 3, 1)), plain(4, 3, 1));
  EXPECT_THAT(store.pictures_on_disk(), testing::ElementsAre("01-a"));
  store.remove("01-a");
  EXPECT_EQ(Store(folder_).find("01-a"), nullptr);
  EXPECT_THAT(store.pictures_on_disk(), testing::IsEmpty());
}

// 100 x 20 pixels on backgrounds 0 and 255; the first `covered` pixels drawn at `level`.
TwoBackgrounds drawing(std::size_t covered, std::uint8_t level) {
  TwoBackgrounds pictures{plain(100, 20, 0), plain(100, 20, 255)};
  for (std::size_t i = 0; i < covered * 3; ++i) pictures.first.rgb[i] = pictures.second.rgb[i] = level;
  return pictures;
}

TEST(PeerComparison, CountsCoverageOfEitherAndColourOfBoth) {
  const PeerComparison c = compare_with_peer(drawing(1000, 80), drawing(1002, 82));
  EXPECT_EQ(c.covered, 1002u);
  EXPECT_EQ(c.covered_by_one, 2u);
  EXPECT_EQ(c.compared, 1000u);
  EXPECT_EQ(c.beyond_tolerance, 0u);
  EXPECT_EQ(c.worst, 2);
  EXPECT_THAT(c.first_coverage, HasSubstr("(0, 10)"));
  EXPECT_FALSE(c.coverage_ok()) << "2 of 1002 is 0.2 %";
  EXPECT_TRUE(c.colour_ok());
}

TEST(PeerComparison, OnePixelInTwoThousandIsTheMostForCoverage) {
  EXPECT_TRUE(compare_with_peer(drawing(2000, 80), drawing(1999, 80)).coverage_ok());
  EXPECT_FALSE(compare_with_peer(drawing(1999, 80), drawing(1998, 80)).coverage_ok());
}

TEST(PeerComparison, PixelDrawnInABackgroundsColourCountsAsCovered) {
  EXPECT_EQ(compare_with_peer(drawing(10, 0), drawing(10, 255)).covered, 10u);
}

TEST(PeerComparison, OnePixelInTwoHundredIsTheMostForColour) {
  TwoBackgrounds ours = drawing(400, 80);
  const TwoBackgrounds peers = drawing(400, 80);
  for (std::size_t i = 0; i < 3; ++i) {
    ours.first.rgb[i * 300] = ours.second.rgb[i * 300] = 83;
    EXPECT_EQ(compare_with_peer(ours, peers).colour_ok(), i < 2) << i + 1 << " of 400";
  }
}

}  // namespace
}  // namespace usuzumi::golden
