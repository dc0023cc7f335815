#include "firmware/drawing_data/flash_image.h"

#include <gtest/gtest.h>

#include <vector>

#include "firmware/drawing_data/drawing_data.h"
#include "tests/support/test_meshes.h"

namespace usuzumi {
namespace {

using firmware::DrawingData;
using firmware::image_in_flash;

/// The image at the start of a flash that is otherwise erased.
std::vector<std::uint32_t> flash_with(std::span<const std::byte> image, std::size_t flash_bytes) {
  std::vector<std::uint32_t> flash(flash_bytes / 4, 0xFFFFFFFFu);
  std::memcpy(flash.data(), image.data(), image.size());
  return flash;
}

TEST(FlashImage, IsAsLongAsTheImageOfEitherFormat) {
  const auto meshes = {testing::hills(6, 1), testing::square(0.5f, 2, 0.1f)};
  for (const bool bare : {false, true}) {
    std::vector<testing::TestMesh> strips;
    for (const auto& mesh : meshes) strips.push_back(bare ? testing::as_strip(mesh) : mesh);
    const testing::RomImage rom = bare ? testing::bare_rom(strips) : testing::container_rom(strips);
    const auto flash = flash_with(rom.bytes(), 1 << 16);
    const auto image = image_in_flash(std::as_bytes(std::span(flash)));
    EXPECT_EQ(image.size(), rom.bytes().size());
    EXPECT_TRUE(DrawingData::open(image).ok());
    EXPECT_EQ(image_in_flash(rom.bytes()).size(), rom.bytes().size()) << "a flash that is full";
  }
}

TEST(FlashImage, ErasedAndBlankFlashHoldNone) {
  for (const std::uint32_t word : {0xFFFFFFFFu, 0u}) {
    const std::vector<std::uint32_t> flash(1024, word);
    EXPECT_TRUE(image_in_flash(std::as_bytes(std::span(flash))).empty());
  }
  EXPECT_TRUE(image_in_flash({}).empty());
}

TEST(FlashImage, WhatClaimsToReachBeyondTheFlashIsLeftForTheReaderToRefuse) {
  const testing::RomImage container = testing::container_rom({testing::hills(6, 1)});
  const testing::RomImage bare = testing::bare_rom({testing::as_strip(testing::hills(6, 1))});
  for (const testing::RomImage* rom : {&container, &bare})
    for (const std::size_t cut : {std::size_t{4}, rom->bytes().size() / 2}) {
      const auto image = image_in_flash(rom->bytes().first(rom->bytes().size() - cut));
      EXPECT_LE(image.size(), rom->bytes().size() - cut);
      EXPECT_FALSE(DrawingData::open(image).ok());
    }
  const std::vector<std::uint32_t> noise(1024, 0x12345678);
  EXPECT_FALSE(DrawingData::open(image_in_flash(std::as_bytes(std::span(noise)))).ok());
}

}  // namespace
}  // namespace usuzumi
