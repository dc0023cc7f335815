// The player and its bundle: what is wrong is told and stops neither the process nor the other cases.
#include "tests/golden/player/player.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "hal/crc32.h"
#include "tests/golden/bundle_writer.h"
#include "tests/golden/player/bundle.h"
#include "tests/support/test_meshes.h"

namespace usuzumi::golden {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Lines final : public LineSink {
 public:
  std::vector<std::string> all;

 private:
  void do_line(std::string_view text) override {
    EXPECT_EQ(text.back(), '\n');
    all.emplace_back(text.substr(0, text.size() - 1));
  }
};

/// Words, so that the bundle lies at a multiple of 4.
class TestBundle {
 public:
  explicit TestBundle(const std::vector<std::byte>& bytes) : words_(bytes.size() / 4) {
    std::memcpy(words_.data(), bytes.data(), bytes.size());
  }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(words_)); }
  std::uint32_t& word(std::size_t byte) { return words_[byte / 4]; }
  std::size_t size() const { return 4 * words_.size(); }
  /// Makes the CRC-32 right again.
  void seal() { word(offsetof(bundle::Header, crc32)) = crc32(kCrc32Start, bytes().subspan(sizeof(bundle::Header))); }

 private:
  std::vector<std::uint32_t> words_;
};

testing::RomImage two_squares() {
  return testing::container_rom({testing::square(0.5f, 1), testing::square(0.25f, 3, 0.5f)});
}

DeviceRun small_run() {
  sim::BoardDescription board = sim::small_board();
  board.pixel_format = command::PixelFormat::kXrgb8888;
  board.ram_bytes = 20'000;
  return {"run-small", "", board, 64, 48, two_squares, {}, {0.1, 0.2}, {{"tiny", "two squares are one too many"}}};
}

std::span<const scenes::Scene> some_scenes() { return scenes::all_scenes().subspan(28, 4); }  // 29 to 32

TestBundle small_bundle() { return TestBundle(write_bundle(some_scenes(), std::vector{small_run()})); }

class GoldenPlayer : public ::testing::Test {
 protected:
  Status play_in(std::span<const std::byte> bundle, std::size_t ram_bytes, std::size_t vram_bytes,
                 std::size_t work_bytes = 100'000, std::string_view board = "host") {
    std::vector<std::byte> ram(ram_bytes), vram(vram_bytes), work(work_bytes);
    lines.all.clear();
    return play(bundle, {ram, vram, work}, board, lines);
  }
  Status play_well_equipped(std::span<const std::byte> bundle, std::string_view board = "host") {
    return play_in(bundle, 40'000, 200'000, 100'000, board);
  }

  TestBundle recorded = small_bundle();
  Lines lines;
};

TEST_F(GoldenPlayer, PrintsALineForEveryPictureAndMesh) {
  const Status status = play_well_equipped(recorded.bytes());
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_THAT(lines.all, ElementsAre("# golden: 5 cases on host", "29-rgb565-odd-width 133 131 cd9019c9",
                                     "30-odd-stride 131 113 38b5830f", "31-one-pixel 1 1 a51c4347",
                                     "32-two-lists 132 124 1f943d1f", StartsWith("run-small/frame-0 64 48 "),
                                     StartsWith("run-small 64 48 "), StartsWith("run-small/mesh-00 4 0 "),
                                     StartsWith("run-small/mesh-01 "), "# golden: done, 8 lines"));
}

TEST_F(GoldenPlayer, PassesOverWhatIsNotForTheBoardAndSaysWhy) {
  ASSERT_TRUE(play_well_equipped(recorded.bytes(), "tiny").ok());
  ASSERT_EQ(lines.all.size(), 7u);
  EXPECT_EQ(lines.all[5], "run-small not on tiny: two squares are one too many");
}

TEST_F(GoldenPlayer, RunShortOfRamFailsWithTheBytesItNeedsAndTheOthersAreStillPlayed) {
  const Status status = play_in(recorded.bytes(), 19'000, 200'000);
  EXPECT_EQ(status.code, StatusCode::kResourceExhausted);
  ASSERT_EQ(lines.all.size(), 7u);
  EXPECT_EQ(lines.all[4], "32-two-lists 132 124 1f943d1f");
  EXPECT_EQ(lines.all[5], "run-small failed: RAM is too small for the run; bytes needed 20000");
}

TEST_F(GoldenPlayer, SceneShortOfVramFailsAndTheOthersAreStillPlayed) {
  EXPECT_EQ(play_in(recorded.bytes(), 40'000, 100'000).code, StatusCode::kResourceExhausted);
  EXPECT_THAT(lines.all[1], StartsWith("29-rgb565-odd-width 133 131 "));
  EXPECT_THAT(lines.all[2], StartsWith("30-odd-stride failed: VRAM is too small for the scene; bytes needed "));
  EXPECT_EQ(lines.all[3], "31-one-pixel 1 1 a51c4347");
}

TEST_F(GoldenPlayer, RunThatWouldBeDrawnInSmallerFormatsFails) {
  // Two pictures and depth at whole pages take 30,720 bytes in 32 bits a pixel, 22,528 in 16.
  EXPECT_EQ(play_in(recorded.bytes(), 40'000, 30'719).code, StatusCode::kResourceExhausted);
  EXPECT_EQ(lines.all[5],
            "run-small failed: VRAM is too small for the run's formats; bytes used by smaller ones 22528");
}

TEST_F(GoldenPlayer, EngineShortOfWorkingMemoryFails) {
  EXPECT_EQ(play_in(recorded.bytes(), 40'000, 200'000, 1'000).code, StatusCode::kResourceExhausted);
  EXPECT_THAT(lines.all[1], StartsWith("29-rgb565-odd-width failed: the engine's working memory is too small"));
}

TEST_F(GoldenPlayer, BundleCutShortAnywhereIsRefused) {
  for (std::size_t size = 0; size < recorded.size(); size += size < 2000 ? 4 : 1000) {
    EXPECT_FALSE(play_well_equipped(recorded.bytes().first(size)).ok()) << size << " bytes";
    ASSERT_EQ(lines.all.size(), 1u) << size << " bytes";
    EXPECT_THAT(lines.all[0], StartsWith("# golden: bundle: "));
  }
}

TEST_F(GoldenPlayer, BundleWithOneBitWrongIsRefused) {
  for (std::size_t byte = 0; byte < recorded.size(); byte += byte < 2000 ? 4 : 1000) {
    recorded.word(byte) ^= 0x00100000;
    EXPECT_FALSE(play_well_equipped(recorded.bytes()).ok()) << "word at " << byte;
    recorded.word(byte) ^= 0x00100000;
  }
}

TEST_F(GoldenPlayer, AnotherVersionIsNotAFault) {
  recorded.word(offsetof(bundle::Header, version)) = 4;
  EXPECT_EQ(play_well_equipped(recorded.bytes()).code, StatusCode::kUnsupported);
  EXPECT_EQ(lines.all[0], "# golden: bundle: another version; record it again with this build 4");
}

TEST_F(GoldenPlayer, BundleMayBeFollowedByOtherThingsInRom) {
  std::vector<std::byte> longer(recorded.bytes().begin(), recorded.bytes().end());
  longer.resize(longer.size() + 100, std::byte{0xFF});
  EXPECT_TRUE(play_well_equipped(TestBundle(longer).bytes()).ok());
}

// Under AddressSanitizer this finds every offset and count that is used before it is checked.
TEST_F(GoldenPlayer, NoWordOfAnyRecordIsTrusted) {
  const std::size_t first_record = sizeof(bundle::Header);
  std::vector<std::size_t> words;
  const auto add_words = [&](std::size_t from, std::size_t bytes) {
    for (std::size_t at = from; at < from + bytes; at += 4) words.push_back(at);
  };
  add_words(first_record, 5 * sizeof(bundle::CaseRecord));
  for (std::size_t n = 0; n < 5; ++n) {
    const std::size_t record = first_record + n * sizeof(bundle::CaseRecord);
    add_words(recorded.word(record + offsetof(bundle::CaseRecord, details)),
              recorded.word(record + offsetof(bundle::CaseRecord, details) + 4));
    add_words(recorded.word(record + offsetof(bundle::CaseRecord, exclusions)),
              recorded.word(record + offsetof(bundle::CaseRecord, exclusions) + 4));
    if (n < 4) {
      const std::size_t scene = recorded.word(record + offsetof(bundle::CaseRecord, details));
      add_words(recorded.word(scene + offsetof(bundle::SceneRecord, lists)),
                recorded.word(scene + offsetof(bundle::SceneRecord, lists) + 4));
    }
  }
  EXPECT_EQ(words.size(), 142u);
  int refused = 0;
  for (const std::size_t at : words) {
    const std::uint32_t right = recorded.word(at);
    for (const std::uint32_t wrong : {0xFFFFFFFFu, 0x7FFFFFFCu, right + 4, right - 4, right + 1, 0u}) {
      recorded.word(at) = wrong;
      recorded.seal();
      refused += play_well_equipped(recorded.bytes()).ok() ? 0 : 1;
      EXPECT_GE(lines.all.size(), 3u) << "the other cases are played: word at " << at << " " << wrong;
    }
    recorded.word(at) = right;
  }
  EXPECT_GT(refused, 300);
}

TEST(GoldenBundle, KeepsEverySettingOfThinning) {
  static constexpr std::uint32_t kChosen[] = {3, 5, 9};
  DeviceRun run = small_run();
  run.thinning.enabled = false;
  run.thinning.delete_policy.kind = firmware::PolicyKind::kBelowArea;
  run.thinning.delete_policy.area_threshold_px = 12.5f;
  run.thinning.collapse_policy = {firmware::PolicyKind::kChosen, 0, kChosen, 250'000, 77};
  run.thinning.quota = {firmware::format::QuotaKind::kMillionths, 300'000};
  run.thinning.placement = firmware::Placement::kMidpoint;
  run.thresholds = {{3, 2, 1}, {9, 8, 7}};
  const TestBundle bundle(write_bundle({}, std::vector{run}));
  const auto opened = Bundle::open(bundle.bytes());
  ASSERT_TRUE(opened.ok()) << opened.status().message;
  const auto read = opened->run(0);
  ASSERT_TRUE(read.ok()) << read.status().message;
  EXPECT_FALSE(read->thinning.enabled);
  EXPECT_EQ(read->thinning.delete_policy.kind, firmware::PolicyKind::kBelowArea);
  EXPECT_EQ(read->thinning.delete_policy.area_threshold_px, 12.5f);
  EXPECT_EQ(read->thinning.collapse_policy.kind, firmware::PolicyKind::kChosen);
  EXPECT_THAT(read->thinning.collapse_policy.chosen, ElementsAre(3u, 5u, 9u));
  EXPECT_EQ(read->thinning.collapse_policy.random_millionths, 250'000u);
  EXPECT_EQ(read->thinning.collapse_policy.seed, 77u);
  EXPECT_EQ(read->thinning.quota.kind, firmware::format::QuotaKind::kMillionths);
  EXPECT_EQ(read->thinning.quota.value, 300'000u);
  EXPECT_EQ(read->thinning.placement, firmware::Placement::kMidpoint);
  ASSERT_EQ(read->thresholds.size(), 2u);
  EXPECT_EQ(read->thresholds[1], (firmware::Thresholds{9, 8, 7}));
  EXPECT_EQ(read->ram_bytes, 20'000u);
  EXPECT_EQ(read->frame_count, 2u);
  EXPECT_EQ(opened->azimuth_rad(0, 1), 0.2);
  EXPECT_TRUE(std::equal(read->rom.begin(), read->rom.end(), two_squares().bytes().begin()));
}

TEST(GoldenBundle, MustLieAtAMultipleOfFour) {
  const TestBundle bundle = small_bundle();
  EXPECT_EQ(Bundle::open(bundle.bytes().subspan(2)).status().code, StatusCode::kInvalidArgument);
}

TEST(GoldenBundle, TextThatThePlayersLinesCannotHoldIsNotWritten) {
  DeviceRun run = small_run();
  const std::string reason(bundle::kReasonMax + 1, 'x');
  run.not_on[0].reason = reason.c_str();
  EXPECT_THAT([&] { write_bundle({}, std::vector{run}); },
              ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("must have 1 to 120 bytes")));
}

}  // namespace
}  // namespace usuzumi::golden
