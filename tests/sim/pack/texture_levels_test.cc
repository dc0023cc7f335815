// Smaller levels and texel formats, against arithmetic by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/pack/picture_file.h"
#include "sim/pack/prepare_textures.h"
#include "sim/pack/texture_levels.h"
#include "tests/sim/pack/pictures.h"

namespace usuzumi {
namespace {

using command::TextureFormat;
using sim::Picture;
using testing::plain;

Picture picture(std::uint32_t width, std::uint32_t height, std::vector<Rgba8> texels) {
  return {"p", width, height, std::move(texels)};
}

/// The sRGB curve as IEC 61966-2-1 has it, in double precision.
double to_linear(double code) {
  const double c = code / 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double to_code(double linear) {
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

TEST(TextureLevels, AreHalvesRoundedDownToOneTexel) {
  const auto levels = sim::levels_of(picture(5, 2, plain(5, 2, rgba8(9, 9, 9))), 99);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(sim::full_level_count(5, 2), 3u);
  EXPECT_EQ(levels[1].width, 2u);
  EXPECT_EQ(levels[1].height, 1u);
  EXPECT_EQ(levels[2].width, 1u);
  EXPECT_EQ(levels[2].height, 1u);
  EXPECT_EQ(sim::levels_of(picture(5, 2, plain(5, 2, {})), 2).size(), 2u);
}

TEST(TextureLevels, MixLightAndNotCodeValues) {
  // Half black, half white is half the light, which is code value 188 and not 128.
  const auto levels = sim::levels_of(picture(2, 1, {rgba8(0, 0, 0), rgba8(255, 255, 255)}), 2);
  EXPECT_EQ(levels[1].texels[0], rgba8(188, 188, 188));
  EXPECT_NEAR(to_code(0.5), 188, 0.5);
}

TEST(TextureLevels, OddSizesWeighTexelsByTheAreaThatIsCovered) {
  // Three texels into one: a third each. Five into two: 1, 1 and a half of each five halves.
  const auto three = sim::levels_of(picture(3, 1, {rgba8(30, 0, 0), rgba8(90, 0, 0), rgba8(240, 0, 0)}), 2);
  EXPECT_NEAR(three[1].texels[0].r(), to_code((to_linear(30) + to_linear(90) + to_linear(240)) / 3), 0.51);
  const auto five = sim::levels_of(
      picture(1, 5, {rgba8(0, 10, 0), rgba8(0, 60, 0), rgba8(0, 120, 0), rgba8(0, 180, 0), rgba8(0, 250, 0)}), 2);
  ASSERT_EQ(five[1].height, 2u);
  EXPECT_NEAR(five[1].texels[0].g(), to_code((to_linear(10) + to_linear(60) + to_linear(120) / 2) / 2.5), 0.51);
  EXPECT_NEAR(five[1].texels[1].g(), to_code((to_linear(120) / 2 + to_linear(180) + to_linear(250)) / 2.5), 0.51);
}

TEST(TextureLevels, KeepEveryPlainColourDownToTheLast) {
  for (std::uint32_t code = 0; code < 256; ++code) {
    const Rgba8 colour = rgba8(code, 255 - code, code / 2, 255);
    for (const Picture& level : sim::levels_of(picture(7, 5, plain(7, 5, colour)), 99))
      for (const Rgba8 c : level.texels) ASSERT_EQ(c, colour) << code;
  }
}

TEST(TextureLevels, WhatCannotBeSeenTintsNothing) {
  const auto levels = sim::levels_of(picture(2, 1, {rgba8(200, 0, 0, 255), rgba8(0, 255, 0, 0)}), 2);
  EXPECT_EQ(levels[1].texels[0], rgba8(200, 0, 0, 128));
  // Unseen all over, the colour stays, since a bilinear filter reaches for it from the border.
  EXPECT_EQ(sim::levels_of(picture(2, 2, plain(2, 2, rgba8(10, 20, 30, 0))), 2)[1].texels[0], rgba8(10, 20, 30, 0));
}

TEST(Texels, HaveTheLayoutOfTheCommandList) {
  const Picture p = picture(1, 2, {rgba8(0x11, 0x22, 0x33, 0x44), rgba8(0xFF, 0, 0)});
  const auto bytes = [](std::initializer_list<int> all) {
    std::vector<std::byte> out;
    for (int b : all) out.push_back(static_cast<std::byte>(b));
    return out;
  };
  EXPECT_EQ(sim::texels_of(p, TextureFormat::kArgb8888), bytes({0x33, 0x22, 0x11, 0x44, 0, 0, 0xFF, 0xFF}));
  EXPECT_EQ(sim::texels_of(p, TextureFormat::kXrgb8888), bytes({0x33, 0x22, 0x11, 0xFF, 0, 0, 0xFF, 0xFF}));
  // Rows of one 16-bit texel are padded to 4 bytes.
  const Picture red = picture(1, 2, plain(1, 2, rgba8(0xFF, 0, 0)));
  EXPECT_EQ(sim::texels_of(red, TextureFormat::kRgb565), bytes({0x00, 0xF8, 0, 0, 0x00, 0xF8, 0, 0}));
}

std::uint32_t texel565(const std::vector<std::byte>& bytes, std::size_t i) {
  return std::to_integer<std::uint32_t>(bytes[2 * i]) | std::to_integer<std::uint32_t>(bytes[2 * i + 1]) << 8;
}

TEST(Texels, Rgb565KeepsExactlyWhatItCanHold) {
  for (std::uint32_t q = 0; q < 64; ++q) {
    const std::uint32_t five = q / 2, green = q << 2 | q >> 4, red = five << 3 | five >> 2;
    const auto bytes = sim::texels_of(picture(4, 4, plain(4, 4, rgba8(red, green, red))), TextureFormat::kRgb565);
    for (std::size_t i = 0; i < 16; ++i) ASSERT_EQ(texel565(bytes, i), five << 11 | q << 5 | five) << q;
  }
}

TEST(Texels, Rgb565DithersSoThatTheMeanIsTheColour) {
  for (std::uint32_t code = 0; code < 256; ++code) {
    const auto bytes = sim::texels_of(picture(4, 4, plain(4, 4, rgba8(code, code, code))), TextureFormat::kRgb565);
    double red = 0, green = 0;
    for (std::size_t i = 0; i < 16; ++i) {
      red += (texel565(bytes, i) >> 11) * 255.0 / 31 / 16;
      green += (texel565(bytes, i) >> 5 & 63) * 255.0 / 63 / 16;
    }
    EXPECT_NEAR(red, code, 1.1);  // a step is 8.2: without dithering the mean would be up to 4.1 off
    EXPECT_NEAR(green, code, 0.77);  // the margin: 48 of 255 steps of 4.05
  }
}

sim::Model textured(const std::vector<Picture>& pictures, const std::vector<sim::Material>& materials) {
  sim::Model model;
  model.textures = pictures;
  model.materials = materials;
  for (std::uint32_t m = 0; m < materials.size(); ++m) {
    sim::Mesh mesh;
    mesh.material = m;
    model.meshes.push_back(mesh);
  }
  return model;
}

TEST(PrepareTextures, StoresEqualImagesOnceAndUnusedOnesNever) {
  const Picture red = picture(2, 2, plain(2, 2, rgba8(255, 0, 0))), blue = picture(2, 2, plain(2, 2, rgba8(0, 0, 255)));
  sim::Model model =
      textured({blue, red, red}, {{.texture = 1}, {.texture = 2, .wrap_s = command::TextureWrap::kClamp}});
  sim::prepare_textures(model);
  ASSERT_EQ(model.textures.size(), 1u);
  EXPECT_EQ(model.textures[0].texels, red.texels);
  ASSERT_EQ(model.materials.size(), 2u) << "their wrapping differs";
  EXPECT_EQ(*model.materials[0].texture, 0u);
  EXPECT_EQ(*model.materials[1].texture, 0u);
}

TEST(PrepareTextures, AlphaThatNobodyLooksAtBecomesFull) {
  const Picture leaf = picture(1, 1, {rgba8(1, 2, 3, 0)});
  sim::Model model =
      textured({leaf}, {{.texture = 0}, {.texture = 0, .alpha_mode = firmware::format::AlphaMode::kMask}});
  sim::prepare_textures(model);
  ASSERT_EQ(model.textures.size(), 2u);
  EXPECT_EQ(model.textures[0].texels[0], rgba8(1, 2, 3, 255));
  EXPECT_EQ(model.textures[1].texels[0], rgba8(1, 2, 3, 0));
}

TEST(PrepareTextures, HalvesUntilItFitsAndTellsOfTheFormatsBound) {
  sim::Model model = textured({picture(4100, 3, plain(4100, 3, rgba8(7, 7, 7)))}, {{.texture = 0}});
  sim::Model small = model;
  sim::prepare_textures(model);
  EXPECT_EQ(model.textures[0].width, 2050u);
  EXPECT_EQ(model.textures[0].height, 1u);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_NE(model.notes[0].find("4100x3"), std::string::npos);
  sim::prepare_textures(small, 1000);
  EXPECT_EQ(small.textures[0].width, 512u);
}

TEST(PictureFile, ReadsPngAndJpegAsTheyAreStoredWhateverGammaTheyName) {
  const std::vector<Rgba8> texels{rgba8(200, 100, 50), rgba8(0, 255, 7, 9), rgba8(1, 2, 3), rgba8(128, 128, 128)};
  std::string fault;
  const auto read = [&](const std::string& file) { return sim::decode_picture(std::as_bytes(std::span(file)), fault); };
  for (double gamma : {0.0, 1.0, 0.45455}) {
    const auto png = read(testing::png_file(2, 2, texels, gamma));
    ASSERT_TRUE(png) << fault;
    EXPECT_EQ(png->texels, texels) << gamma;
  }
  const auto jpeg = read(testing::jpeg_file(16, 16, plain(16, 16, rgba8(200, 100, 50))));
  ASSERT_TRUE(jpeg) << fault;
  ASSERT_EQ(jpeg->texels.size(), 256u);
  for (const Rgba8 c : jpeg->texels) {
    EXPECT_NEAR(c.r(), 200, 2);
    EXPECT_NEAR(c.g(), 100, 2);
    EXPECT_NEAR(c.b(), 50, 2);
    EXPECT_EQ(c.a(), 255u);
  }
}

TEST(PictureFile, EveryCutOffFileIsRefusedWithAReason) {
  std::vector<Rgba8> noise;
  for (std::uint32_t i = 0; i < 256; ++i) noise.push_back(rgba8(i * 37 % 251, i * 91 % 253, i * 53 % 255));
  for (const std::string& whole : {testing::png_file(16, 16, noise), testing::jpeg_file(16, 16, noise)})
    for (std::size_t size = 0; size + 16 < whole.size(); size += 7) {
      std::string fault;
      const std::string part = whole.substr(0, size);
      EXPECT_FALSE(sim::decode_picture(std::as_bytes(std::span(part)), fault)) << size << " of " << whole.size();
      EXPECT_FALSE(fault.empty());
    }
}

TEST(PictureFile, MoreThan16384TexelsEachWayAreRefused) {
  const auto file_of = [](bool png, std::uint32_t width, std::uint32_t height) {
    const std::vector<Rgba8> texels = plain(width, height, rgba8(1, 2, 3));
    return png ? testing::png_file(width, height, texels) : testing::jpeg_file(width, height, texels);
  };
  for (const bool png : {true, false}) {
    std::string fault;
    const std::string wide = file_of(png, 16384, 1), wider = file_of(png, 16385, 1), taller = file_of(png, 1, 16385);
    const auto picture = sim::decode_picture(std::as_bytes(std::span(wide)), fault);
    ASSERT_TRUE(picture) << fault;
    EXPECT_EQ(picture->texels.size(), 16384u);
    EXPECT_FALSE(sim::decode_picture(std::as_bytes(std::span(wider)), fault));
    EXPECT_EQ(fault, "has 16385x1 texels, and at most 16384 each way are read");
    EXPECT_FALSE(sim::decode_picture(std::as_bytes(std::span(taller)), fault));
    EXPECT_EQ(fault, "has 1x16385 texels, and at most 16384 each way are read");
  }
}

}  // namespace
}  // namespace usuzumi
