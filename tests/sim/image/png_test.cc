// PNG in and out: exact round trips, sentences for what cannot be read or written, nothing half-written.
#include "sim/image/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim/common/error.h"
#include "sim/common/files.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class PngTest : public ::testing::Test {
 protected:
  PngTest()
      : folder_(fs::path(::testing::TempDir()) /
                ("usuzumi_png_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~PngTest() override { fs::remove_all(folder_); }

  /// The sentence with which reading `path` is refused; "" when it is not.
  static std::string refusal(const fs::path& path, ExitCode code = ExitCode::kBadInput) {
    try {
      read_png(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

Image colourful(std::uint32_t width, std::uint32_t height) {
  Image image(width, height);
  std::uint32_t state = 1;
  for (std::uint32_t& p : image.xrgb) p = (state = state * 1664525 + 1013904223) >> 8;
  return image;
}

TEST_F(PngTest, WhatIsWrittenIsReadBackBitForBit) {
  for (const PngEffort effort : {PngEffort::kSmall, PngEffort::kFast})
    for (const Image& image : {colourful(1, 1), colourful(37, 11), colourful(200, 3)}) {
      write_png(folder_ / "a.png", image, effort);
      EXPECT_EQ(read_png(folder_ / "a.png"), image);
    }
}

TEST_F(PngTest, UpperByteOfAPixelIsNotWritten) {
  Image image(1, 1, 0xFF123456);
  write_png(folder_ / "a.png", image);
  EXPECT_EQ(read_png(folder_ / "a.png").xrgb[0], 0x123456u);
}

TEST_F(PngTest, WritingLeavesNoOtherFile) {
  write_png(folder_ / "a.png", colourful(9, 9));
  write_png(folder_ / "a.png", colourful(8, 8));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
  EXPECT_EQ(read_png(folder_ / "a.png").width, 8u);
}

TEST_F(PngTest, UnwritablePlacesAreNamed) {
  try {
    write_png(folder_ / "no" / "such" / "a.png", colourful(2, 2));
    FAIL() << "wrote into a folder that is not there";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kCannotWrite);
    EXPECT_THAT(error.what(), HasSubstr("a.png"));
  }
}

TEST_F(PngTest, MissingFilesAreNamed) { EXPECT_THAT(refusal(folder_ / "missing.png"), HasSubstr("missing.png")); }

TEST_F(PngTest, OtherFilesAreRefused) {
  write_file_atomically(folder_ / "a.png", std::string_view("this is no picture at all"));
  EXPECT_THAT(refusal(folder_ / "a.png"), HasSubstr("not a readable PNG"));
  write_file_atomically(folder_ / "a.png", std::string_view(""));
  EXPECT_NE(refusal(folder_ / "a.png"), "");
}

TEST_F(PngTest, EveryPrefixOfAPngIsRefused) {
  write_png(folder_ / "a.png", colourful(13, 7));
  const std::vector<std::byte> whole = read_file(folder_ / "a.png");
  // The last 12 bytes are the IEND chunk; libpng needs no more than the pixels' own end.
  for (std::size_t n = 0; n + 16 < whole.size(); ++n) {
    write_file_atomically(folder_ / "b.png", std::span(whole).first(n));
    EXPECT_NE(refusal(folder_ / "b.png"), "") << "prefix of " << n;
  }
}

TEST_F(PngTest, DamageInThePixelsIsSeen) {
  write_png(folder_ / "a.png", colourful(13, 7));
  std::vector<std::byte> file = read_file(folder_ / "a.png");
  file[file.size() / 2] ^= std::byte{0x10};
  write_file_atomically(folder_ / "a.png", file);
  EXPECT_NE(refusal(folder_ / "a.png"), "");
}

TEST(PictureCrc, IsTheCrcOfRedGreenBlueBytes) {
  Image image(3, 1);
  image.xrgb = {0xFF313233, 0x343536, 0x373839};  // "123456789"
  EXPECT_EQ(picture_crc32(image), 0xCBF43926u);
}

}  // namespace
}  // namespace usuzumi::sim
