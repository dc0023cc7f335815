// The judges judged: what must fail does, and says where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "sim/image/png.h"
#include "tests/golden/golden_check.h"
#include "tests/golden/golden_store.h"

namespace usuzumi::golden {
namespace {

using testing::HasSubstr;

Entry entry_of(const std::string& scene, const sim::Image& picture) {
  return {scene, picture.width, picture.height, sim::picture_crc32(picture), "a note of words"};
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
  sim::Image picture(3, 1);
  picture.xrgb = {0x313233, 0x343536, 0x373839};
  EXPECT_EQ(sim::picture_crc32(picture), 0xCBF43926u);
}

TEST_F(GoldenCheck, ApprovedPictureIsReadBackAndPasses) {
  sim::Image picture(5, 4, 0x0A0A0A);
  picture.at(2, 1) = 0xC80A0A;
  Store(folder_).put({entry_of("02-b", sim::Image(2, 2, 1))}, {}, sim::Image(2, 2, 1));
  Store(folder_).put({entry_of("01-a", picture)}, {}, picture);
  const Store store(folder_);
  ASSERT_EQ(store.entries().size(), 2u);
  EXPECT_EQ(store.entries()[0].name, "01-a") << "sorted by scene";
  EXPECT_EQ(store.entries()[0].width, 5u);
  EXPECT_EQ(store.entries()[0].height, 4u);
  EXPECT_EQ(store.entries()[0].note, "a note of words");
  const Verdict verdict = check_golden(store, "01-a", picture, failures());
  EXPECT_TRUE(verdict.ok) << verdict.report;
}

TEST_F(GoldenCheck, MissingGoldenFailsAndLeavesTheActualPicture) {
  const sim::Image picture(3, 3, 9);
  const Verdict verdict = check_golden(Store(folder_), "77-new", picture, failures());
  EXPECT_FALSE(verdict.ok);
  EXPECT_THAT(verdict.report, HasSubstr("has no golden"));
  EXPECT_THAT(verdict.report, HasSubstr("approve.sh 77-new"));
  EXPECT_EQ(sim::read_png(failures() / "77-new.actual.png"), picture);
}

TEST_F(GoldenCheck, GoldenWithoutItsPngFails) {
  const sim::Image picture(3, 3, 9);
  Store store(folder_);
  store.put({entry_of("01-a", picture)}, {}, picture);
  std::filesystem::remove(store.picture_path("01-a"));
  EXPECT_THAT(check_golden(store, "01-a", picture, failures()).report, HasSubstr("golden has no PNG"));
}

TEST_F(GoldenCheck, ManifestAndPngThatContradictEachOtherFail) {
  const sim::Image picture(3, 3, 9);
  Store store(folder_);
  Entry entry = entry_of("01-a", picture);
  entry.crc32 ^= 1;
  store.put({entry}, {}, picture);
  EXPECT_THAT(check_golden(store, "01-a", picture, failures()).report, HasSubstr("its own PNG"));
}

TEST_F(GoldenCheck, OneWrongPixelFailsByItsPlaceAndLeavesThreePictures) {
  const sim::Image expected(4, 3, 0x646464);
  sim::Image actual = expected;
  actual.at(1, 2) = 0x646465;
  Store store(folder_);
  store.put({entry_of("01-a", expected)}, {}, expected);
  const Verdict verdict = check_golden(store, "01-a", actual, failures());
  EXPECT_FALSE(verdict.ok);
  EXPECT_THAT(verdict.report, HasSubstr("1 of 12 pixels differ, largest channel difference 1"));
  EXPECT_THAT(verdict.report, HasSubstr("first at x=1 y=2"));
  EXPECT_THAT(verdict.report, HasSubstr((failures() / "01-a.difference.png").string()));
  EXPECT_EQ(sim::read_png(failures() / "01-a.actual.png"), actual);
  EXPECT_EQ(sim::read_png(failures() / "01-a.expected.png"), expected);
  const sim::Image difference = sim::read_png(failures() / "01-a.difference.png");
  EXPECT_NE(difference.at(1, 2), difference.at(0, 0));
}

TEST_F(GoldenCheck, PictureOfAnotherSizeFailsAndLeavesThreePicturesToo) {
  Store store(folder_);
  const sim::Image expected(4, 3, 1), actual(3, 4, 1);
  store.put({entry_of("01-a", expected)}, {}, expected);
  EXPECT_THAT(check_golden(store, "01-a", actual, failures()).report, HasSubstr("is 3 x 4, golden is 4 x 3"));
  EXPECT_EQ(sim::read_png(failures() / "01-a.actual.png"), actual);
  EXPECT_EQ(sim::read_png(failures() / "01-a.expected.png"), expected);
  const sim::Image difference = sim::read_png(failures() / "01-a.difference.png");
  ASSERT_EQ(difference.width, 4u);
  ASSERT_EQ(difference.height, 4u);
  EXPECT_EQ(difference.at(2, 2), difference.at(0, 0)) << "in both, and the same";
  EXPECT_NE(difference.at(3, 0), difference.at(0, 0)) << "expected only";
  EXPECT_NE(difference.at(0, 3), difference.at(0, 0)) << "came unexpected";
}

TEST_F(GoldenCheck, ManifestLineThatCannotBeReadIsNamed) {
  const auto refused = [&](const char* manifest, const char* message) {
    std::ofstream(folder_ / "manifest") << manifest;
    EXPECT_THAT([&] { Store store(folder_); }, testing::ThrowsMessage<std::runtime_error>(HasSubstr(message)));
  };
  refused("# a comment\n\n01-a 3 3 0badcafe note\n02-b 3 three 0badcafe\n", "manifest:4");
  refused("01-a 3 3 0badcafe\n01-a 3 3 0badcafe\n", "named twice");
  refused("01-a 3 3 0badcafe\n01-a not on m7:\n", "manifest:2");
  refused("01-a not on m7: too wide\n01-a 3 3 0badcafe\n", "no picture of 01-a above");
  refused("01-a 3 3 0badcafe\n01-a not on m7: too wide\n01-a not on m7: too high\n", "come twice");
}

TEST_F(GoldenCheck, CaseKeepsItsFramesMeshesAndBoardsThroughTheManifest) {
  const sim::Image picture(4, 3, 1);
  const std::vector<Entry> lines{entry_of("run-1", picture), {"run-1/frame-0", 4, 3, 7, "frame 1 of 2"},
                                 {"run-1/mesh-00", 12, 0, 9, "a strip has no indices"}};
  const std::vector<Exclusion> boards{{"run-1", "m7", "too wide: 4 columns"}, {"run-1", "m0", "too high"}};
  Store store(folder_);
  store.put({entry_of("run-1-more", picture)}, {}, picture);
  store.put({lines[2], lines[1], lines[0]}, boards, picture);
  EXPECT_EQ(Store(folder_).entries_of("run-1"), lines) << "sorted by name, apart from run-1-more";
  EXPECT_EQ(Store(folder_).exclusions_of("run-1"), boards);
  store.put({lines[0], lines[1]}, {}, picture);
  EXPECT_EQ(Store(folder_).entries_of("run-1").size(), 2u) << "what the case no longer has is gone";
  EXPECT_TRUE(Store(folder_).exclusions().empty());
  store.remove("run-1");
  ASSERT_EQ(Store(folder_).entries().size(), 1u);
  EXPECT_EQ(Store(folder_).entries()[0].name, "run-1-more");
}

TEST_F(GoldenCheck, RemovedGoldenIsGoneFromManifestAndFolder) {
  Store store(folder_);
  store.put({entry_of("01-a", sim::Image(4, 3, 1))}, {}, sim::Image(4, 3, 1));
  EXPECT_THAT(store.pictures_on_disk(), testing::ElementsAre("01-a"));
  store.remove("01-a");
  EXPECT_EQ(Store(folder_).find("01-a"), nullptr);
  EXPECT_THAT(store.pictures_on_disk(), testing::IsEmpty());
}

// 100 x 20 pixels on black and on white; the first `covered` pixels drawn in grey of `level`.
TwoBackgrounds drawing(std::size_t covered, std::uint32_t level) {
  TwoBackgrounds pictures{sim::Image(100, 20, 0), sim::Image(100, 20, 0xFFFFFF)};
  for (std::size_t i = 0; i < covered; ++i) pictures.first.xrgb[i] = pictures.second.xrgb[i] = level * 0x010101;
  return pictures;
}

TEST(PeerComparison, CountsCoverageOfEitherAndColourOfBoth) {
  const PeerComparison c = compare_with_peer(drawing(1000, 80), drawing(1002, 82));
  EXPECT_EQ(c.covered, 1002u);
  EXPECT_EQ(c.covered_by_one, 2u);
  EXPECT_EQ(c.compared, 1000u);
  EXPECT_EQ(c.beyond_tolerance, 0u);
  EXPECT_EQ(c.worst, 2u);
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

TEST(PeerComparison, SumsAddUpAndKeepTheFirstPlace) {
  PeerComparison sum = compare_with_peer(drawing(10, 80), drawing(10, 80));
  sum += compare_with_peer(drawing(10, 80), drawing(9, 90));
  EXPECT_EQ(sum.covered, 20u);
  EXPECT_EQ(sum.covered_by_one, 1u);
  EXPECT_EQ(sum.compared, 19u);
  EXPECT_EQ(sum.beyond_tolerance, 9u);
  EXPECT_EQ(sum.worst, 10u);
  EXPECT_THAT(sum.first_coverage, HasSubstr("(9, 0)"));
}

TEST(PeerComparison, OnePixelInTwoHundredIsTheMostForColour) {
  TwoBackgrounds ours = drawing(400, 80);
  const TwoBackgrounds peers = drawing(400, 80);
  for (std::size_t i = 0; i < 3; ++i) {
    ours.first.xrgb[i * 100] = ours.second.xrgb[i * 100] = 0x505350;
    EXPECT_EQ(compare_with_peer(ours, peers).colour_ok(), i < 2) << i + 1 << " of 400";
  }
}

}  // namespace
}  // namespace usuzumi::golden
