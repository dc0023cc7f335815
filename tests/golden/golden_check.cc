#include "tests/golden/golden_check.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/golden/golden_png.h"

namespace usuzumi::golden {
namespace {

std::string hex8(std::uint32_t v) {
  char text[16];
  std::snprintf(text, sizeof text, "%08x", v);
  return text;
}

std::string colour_text(const std::uint8_t* p) {
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", p[0], p[1], p[2]);
  return text;
}

std::string size_text(const RgbPicture& p) { return std::to_string(p.width) + " x " + std::to_string(p.height); }

int channel_distance(const std::uint8_t* a, const std::uint8_t* b) {
  int worst = 0;
  for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(int{a[i]} - int{b[i]}));
  return worst;
}

bool same_size(const RgbPicture& a, const RgbPicture& b) { return a.width == b.width && a.height == b.height; }

std::string file_list(const std::filesystem::path& folder, const std::string& scene) {
  return "\n  actual:     " + (folder / (scene + ".actual.png")).string() + "\n  expected:   " + (folder / (scene + ".expected.png")).string() +
         "\n  difference: " + (folder / (scene + ".difference.png")).string();
}

}  // namespace

Difference compare_pictures(const RgbPicture& expected, const RgbPicture& actual) {
  Difference difference;
  for (std::uint32_t y = 0; y < expected.height; ++y) {
    for (std::uint32_t x = 0; x < expected.width; ++x) {
      const int distance = channel_distance(expected.pixel(x, y), actual.pixel(x, y));
      if (distance == 0) continue;
      if (difference.pixels++ == 0) {
        difference.first_x = x;
        difference.first_y = y;
      }
      difference.worst = std::max(difference.worst, distance);
    }
  }
  return difference;
}

RgbPicture difference_picture(const RgbPicture& expected, const RgbPicture& actual) {
  RgbPicture picture{expected.width, expected.height, {}};
  for (std::size_t i = 0; i < expected.rgb.size(); i += 3) {
    const std::uint8_t *a = &expected.rgb[i], *b = &actual.rgb[i];
    const bool same = std::memcmp(a, b, 3) == 0;
    for (int c = 0; c < 3; ++c) {
      const int distance = std::abs(int{a[c]} - int{b[c]});
      picture.rgb.push_back(static_cast<std::uint8_t>(same ? a[c] / 8 : (distance == 0 ? 0 : std::min(255, 64 + distance))));
    }
  }
  return picture;
}

Verdict check_golden(const Store& store, const std::string& scene, const RgbPicture& actual, const std::filesystem::path& failures) {
  std::filesystem::create_directories(failures);
  const std::uint32_t crc = scenes::picture_crc32(actual);
  const auto fail = [&](const std::string& reason) {
    write_png(failures / (scene + ".actual.png"), actual);
    return Verdict{false, scene + ": " + reason + "\n  CRC-32 now: " + hex8(crc) +
                              "\n  if the new picture is right: bash tests/golden/approve.sh " + scene};
  };
  const std::string actual_only = "\n  actual: " + (failures / (scene + ".actual.png")).string();
  const Entry* entry = store.find(scene);
  if (entry == nullptr) return fail("has no golden" + actual_only);
  if (!std::filesystem::exists(store.picture_path(scene))) return fail("golden has no PNG: " + store.picture_path(scene).string() + actual_only);
  const RgbPicture expected = read_png(store.picture_path(scene));
  if (scenes::picture_crc32(expected) != entry->crc32)
    return fail("manifest says CRC-32 " + hex8(entry->crc32) + " but its own PNG has " + hex8(scenes::picture_crc32(expected)) + actual_only);
  if (!same_size(expected, actual)) return fail("is " + size_text(actual) + ", golden is " + size_text(expected) + actual_only);
  if (entry->width != actual.width || entry->height != actual.height) return fail("manifest gives another size than its PNG" + actual_only);
  if (expected == actual) return {};
  write_png(failures / (scene + ".expected.png"), expected);
  write_png(failures / (scene + ".difference.png"), difference_picture(expected, actual));
  const Difference d = compare_pictures(expected, actual);
  return fail(std::to_string(d.pixels) + " pixels differ, by up to " + std::to_string(d.worst) + "; first at (" + std::to_string(d.first_x) +
              ", " + std::to_string(d.first_y) + "): expected " + colour_text(expected.pixel(d.first_x, d.first_y)) + ", actual " +
              colour_text(actual.pixel(d.first_x, d.first_y)) + file_list(failures, scene));
}

bool TwoBackgrounds::covered(std::uint32_t x, std::uint32_t y) const { return std::memcmp(first.pixel(x, y), second.pixel(x, y), 3) == 0; }

PeerComparison compare_with_peer(const TwoBackgrounds& ours, const TwoBackgrounds& peers) {
  PeerComparison result;
  const auto place = [&](std::uint32_t x, std::uint32_t y) {
    return "(" + std::to_string(x) + ", " + std::to_string(y) + "): ours " + colour_text(ours.first.pixel(x, y)) + ", the peer's " +
           colour_text(peers.first.pixel(x, y));
  };
  for (std::uint32_t y = 0; y < ours.first.height; ++y) {
    for (std::uint32_t x = 0; x < ours.first.width; ++x) {
      const bool by_us = ours.covered(x, y), by_peer = peers.covered(x, y);
      if (!by_us && !by_peer) continue;
      ++result.covered;
      if (by_us != by_peer) {
        if (result.covered_by_one++ == 0) result.first_coverage = place(x, y) + (by_us ? " (not covered)" : " (covered)");
        continue;
      }
      ++result.compared;
      const int distance = channel_distance(ours.first.pixel(x, y), peers.first.pixel(x, y));
      result.worst = std::max(result.worst, distance);
      if (distance > kChannelTolerance && result.beyond_tolerance++ == 0) result.first_colour = place(x, y);
    }
  }
  return result;
}

}  // namespace usuzumi::golden
