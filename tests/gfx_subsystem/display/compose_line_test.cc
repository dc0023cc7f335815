// compose_line against hand-worked pixels and against a plain model written apart from it, one pixel and channel at a
// time.
#include "gfx_subsystem/display/compose_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "gfx_subsystem/display/pixel_kernels.h"

namespace usuzumi::gfx {
namespace {

using display_registers::LayerFormat;
using Words = std::vector<std::uint32_t>;

std::vector<std::byte> bytes_of(const Words& words) {
  std::vector<std::byte> bytes(words.size() * 4);
  std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}

Words compose(std::uint32_t background, const std::vector<LayerRow>& rows, std::size_t width) {
  Words line(width, 0xDEADBEEF);
  compose_line(background, rows, line);
  return line;
}

TEST(ComposeLine, BackgroundAloneFillsTheLine) {
  EXPECT_EQ(compose(0x00123456, {}, 5), Words(5, 0x00123456));
}

TEST(ComposeLine, Rgb565IsWidenedSoThatFullScaleStaysFullScale) {
  const std::uint16_t raw[6] = {0xFFFF, 0x0000, 0xF800, 0x07E0, 0x001F, 0x8410};
  const LayerRow row{
      .pixels = reinterpret_cast<const std::byte*>(raw), .x_begin = 0, .x_end = 6, .format = LayerFormat::kRgb565};
  EXPECT_EQ(compose(0, {row}, 6), (Words{0xFFFFFF, 0x000000, 0xFF0000, 0x00FF00, 0x0000FF, 0x848284}));
}

TEST(ComposeLine, UpperByteOfXrgbNeverReachesThePanel) {
  const auto bytes = bytes_of({0xFF112233, 0x00445566});
  const LayerRow row{.pixels = bytes.data(), .x_begin = 1, .x_end = 3};
  EXPECT_EQ(compose(0x0A0B0C, {row}, 4), (Words{0x0A0B0C, 0x112233, 0x445566, 0x0A0B0C}));
}

TEST(ComposeLine, BlendingRoundsToTheNearestHalvesUp) {
  // 200 * 128 / 255 + 100 * 127 / 255 = 150.196; 1 * 128 / 255 = 0.502 -> 1; 1 * 127 / 255 = 0.498 -> 0.
  const auto bytes = bytes_of({0x80C80100, 0x7FC80100});
  const LayerRow row{
      .pixels = bytes.data(), .x_begin = 0, .x_end = 2, .format = LayerFormat::kArgb8888, .per_pixel_alpha = true};
  EXPECT_EQ(compose(0x640000, {row}, 2), (Words{0x960100, 0x960000}));
}

TEST(ComposeLine, DivisionBy255IsExactForEveryProductOfTwoBytes) {
  for (std::uint32_t v = 0; v <= 255 * 255; ++v)
    ASSERT_EQ(divide_by_255(v), static_cast<std::uint32_t>(std::floor(v / 255.0 + 0.5))) << v;
}

TEST(ComposeLine, AlphaOfTheFormatCountsOnlyWhenEnabled) {
  const auto bytes = bytes_of({0x00112233});
  LayerRow row{.pixels = bytes.data(), .x_begin = 0, .x_end = 1, .format = LayerFormat::kArgb8888};
  EXPECT_EQ(compose(0xFFFFFF, {row}, 1), Words{0x112233});
  row.per_pixel_alpha = true;
  EXPECT_EQ(compose(0xFFFFFF, {row}, 1), Words{0xFFFFFF});
  row.format = LayerFormat::kXrgb8888;
  EXPECT_EQ(compose(0xFFFFFF, {row}, 1), Words{0x112233});
}

TEST(ComposeLine, KeyedPixelsLetTheLayerBelowThrough) {
  const auto below = bytes_of({0x010101, 0x020202, 0x030303});
  const auto above = bytes_of({0x55FF00FF, 0x00FF00FE, 0xAAFF00FF});
  const LayerRow back{.pixels = below.data(), .x_begin = 0, .x_end = 3};
  const LayerRow front{.pixels = above.data(), .x_begin = 0, .x_end = 3, .key_enabled = true, .key_rgb = 0xFF00FF};
  EXPECT_EQ(compose(0, {back, front}, 3), (Words{0x010101, 0xFF00FE, 0x030303}));
}

/// Written from the register page alone, in double precision, with no regard for speed.
std::uint32_t reference_pixel(std::uint32_t background, const std::vector<LayerRow>& rows, std::uint32_t x) {
  const auto divide = [](double v) { return static_cast<std::uint32_t>(std::floor(v / 255.0 + 0.5)); };
  std::uint32_t shown = background;
  for (const LayerRow& row : rows) {
    if (x < row.x_begin || x >= row.x_end) continue;
    std::uint32_t alpha = 255, rgb = 0;
    if (row.format == LayerFormat::kRgb565) {
      std::uint16_t p;
      std::memcpy(&p, row.pixels + 2 * (x - row.x_begin), 2);
      const std::uint32_t r = p / 2048u, g = p / 32u % 64u, b = p % 32u;
      rgb = (r * 8 + r / 4) * 65536 + (g * 4 + g / 16) * 256 + (b * 8 + b / 4);
    } else {
      std::uint32_t p;
      std::memcpy(&p, row.pixels + 4 * (x - row.x_begin), 4);
      rgb = p % 0x1000000;
      if (row.format == LayerFormat::kArgb8888 && row.per_pixel_alpha) alpha = p / 0x1000000;
    }
    if (row.key_enabled && rgb == row.key_rgb) continue;
    alpha = divide(alpha * double(row.global_alpha));
    std::uint32_t blended = 0;
    for (std::uint32_t unit : {0x10000u, 0x100u, 1u}) {
      const double s = rgb / unit % 256, d = shown / unit % 256;
      blended += divide(s * alpha + d * (255 - alpha)) * unit;
    }
    shown = blended;
  }
  return shown;
}

TEST(ComposeLine, EqualsTheReferenceForRandomStacksOfLayers) {
  std::mt19937 random(20261122);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  for (int round = 0; round < 3000; ++round) {
    const std::uint32_t width = 1 + below(200);
    std::vector<std::vector<std::byte>> memory;
    std::vector<LayerRow> rows;
    for (std::uint32_t n = below(6); n > 0; --n) {
      LayerRow row;
      row.x_begin = below(3) == 0 ? 0 : below(width);
      row.x_end = below(3) == 0 ? width : row.x_begin + 1 + below(width - row.x_begin);
      row.format = static_cast<LayerFormat>(below(3));
      row.per_pixel_alpha = below(2) == 0;
      row.global_alpha = below(2) == 0 ? 255 : below(256);
      row.key_enabled = below(3) == 0;
      // Few colours, so that keys meet; alphas often at the ends, so that runs of both occur.
      row.key_rgb = 0;
      Words words(row.x_end - row.x_begin);
      const std::uint32_t style = below(4);
      for (std::uint32_t& w : words) {
        w = below(3) == 0 ? 0 : static_cast<std::uint32_t>(random());
        if (style == 0) w |= 0xFF000000;
        if (style == 1) w &= 0x00FFFFFF;
      }
      memory.push_back(bytes_of(words));
      row.pixels = memory.back().data();
      rows.push_back(row);
    }
    const std::uint32_t background = below(0x1000000);
    const Words line = compose(background, rows, width);
    for (std::uint32_t x = 0; x < width; ++x)
      ASSERT_EQ(line[x], reference_pixel(background, rows, x)) << "round " << round << " x " << x;
  }
}

/// Runs `body` with every variant of the kernels that this processor has; there is one at least.
template <class Body>
void for_each_kernel(Body body) {
  int variants = 0;
  for (const PixelKernels* kernels : all_pixel_kernels()) {
    if (!kernels->supported()) continue;
    SCOPED_TRACE(kernels->name);
    body(*kernels);
    ++variants;
  }
  ASSERT_GE(variants, 1);
}

TEST(PixelKernels, PackingWritesRedGreenBlueForAnyCountAndNothingBeyond) {
  for_each_kernel([](const PixelKernels& kernels) {
    for (std::uint32_t n = 0; n <= 70; ++n) {
      Words pixels;
      std::vector<std::byte> expected;
      for (std::uint32_t i = 0; i < n; ++i) {
        pixels.push_back((3 * i + 1) << 16 | (3 * i + 2) << 8 | (3 * i + 3));
        for (std::uint32_t c = 1; c <= 3; ++c) expected.push_back(static_cast<std::byte>(3 * i + c));
      }
      std::vector<std::byte> bytes(3 * n + 16, std::byte{0xEE});
      kernels.pack_rgb(pixels.data(), n, bytes.data());
      expected.insert(expected.end(), 16, std::byte{0xEE});
      ASSERT_EQ(bytes, expected) << n;
    }
  });
}

TEST(PixelKernels, EveryAlphaSourceAndBackgroundBlendsAsTheFormulaSays) {
  for_each_kernel([](const PixelKernels& kernels) {
    for (std::uint32_t alpha = 0; alpha < 256; ++alpha)
      for (std::uint32_t source = 0; source < 256; source += 5) {
        Words above(256), line(256);
        for (std::uint32_t d = 0; d < 256; ++d) {
          above[d] = alpha << 24 | source << 16 | (255 - source) << 8 | source;
          line[d] = d << 16 | d << 8 | (255 - d);
        }
        kernels.blend_row(bytes_of(above).data(), 256, line.data());
        for (std::uint32_t d = 0; d < 256; ++d) {
          const auto channel = [&](std::uint32_t s, std::uint32_t b) {
            return static_cast<std::uint32_t>(std::floor((s * alpha + b * (255 - alpha)) / 255.0 + 0.5));
          };
          ASSERT_EQ(line[d], channel(source, d) << 16 | channel(255 - source, d) << 8 | channel(source, 255 - d));
        }
      }
  });
}

TEST(PixelKernels, EveryVariantGivesTheSameBytesForAnyCountAndAlignment) {
  std::mt19937 random(3);
  for (std::uint32_t round = 0; round < 2000; ++round) {
    const std::size_t count = random() % 60, shift = random() % 4;
    std::vector<std::byte> argb(4 * count + 4);
    for (std::byte& b : argb) b = random() % 3 == 0 ? std::byte(random() % 2 * 255) : std::byte(random() & 0xFF);
    Words below(count + 1);
    for (std::uint32_t& w : below) w = static_cast<std::uint32_t>(random() & 0xFFFFFF);
    Words expected = below;
    all_pixel_kernels().front()->blend_row(argb.data() + shift, count, expected.data());
    for_each_kernel([&](const PixelKernels& kernels) {
      Words line = below;
      kernels.blend_row(argb.data() + shift, count, line.data());
      ASSERT_EQ(line, expected);
    });
  }
}

}  // namespace
}  // namespace usuzumi::gfx
