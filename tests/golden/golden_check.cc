#include "tests/golden/golden_check.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "sim/image/compare.h"
#include "sim/image/png.h"

namespace usuzumi::golden {
namespace {

std::string hex8(std::uint32_t v) {
  char text[16];
  std::snprintf(text, sizeof text, "%08x", v);
  return text;
}

std::string colour_text(std::uint32_t xrgb) { return "#" + hex8(xrgb).substr(2); }

std::string size_text(const sim::Image& p) { return std::to_string(p.width) + " x " + std::to_string(p.height); }

std::uint32_t channel_distance(std::uint32_t a, std::uint32_t b) {
  std::uint32_t worst = 0;
  for (unsigned shift = 0; shift < 24; shift += 8) {
    const std::uint32_t p = (a >> shift) & 0xFF, q = (b >> shift) & 0xFF;
    worst = std::max(worst, p > q ? p - q : q - p);
  }
  return worst;
}

// Where a failed scene's pictures go.
struct FailureFiles {
  std::filesystem::path folder;
  std::string scene;
  std::filesystem::path actual() const { return folder / (scene + ".actual.png"); }
  std::filesystem::path expected() const { return folder / (scene + ".expected.png"); }
  std::filesystem::path difference() const { return folder / (scene + ".difference.png"); }
};

// What is wrong with the golden itself; empty when nothing is. `expected` is its PNG, where there is one.
std::string golden_fault(const Entry* entry, const std::filesystem::path& path,
                         const std::optional<sim::Image>& expected, const sim::Image& actual) {
  if (entry == nullptr) return "has no golden";
  if (!expected) return "golden has no PNG: " + path.string();
  if (sim::picture_crc32(*expected) != entry->crc32)
    return "manifest says CRC-32 " + hex8(entry->crc32) + " but its own PNG has " + hex8(sim::picture_crc32(*expected));
  if (expected->width != actual.width || expected->height != actual.height)
    return "is " + size_text(actual) + ", golden is " + size_text(*expected);
  if (entry->width != actual.width || entry->height != actual.height) return "manifest gives another size than its PNG";
  return {};
}

// `picture` grown to hold `other` too: where it has no pixel it gets one that differs from the other's.
sim::Image grown_to_hold(const sim::Image& picture, const sim::Image& other) {
  sim::Image grown(std::max(picture.width, other.width), std::max(picture.height, other.height));
  for (std::uint32_t y = 0; y < grown.height; ++y)
    for (std::uint32_t x = 0; x < grown.width; ++x) {
      if (x < picture.width && y < picture.height) grown.at(x, y) = picture.at(x, y);
      else if (x < other.width && y < other.height) grown.at(x, y) = other.at(x, y) ^ 0xFFFFFFu;
    }
  return grown;
}

// Leaves the pictures and says where.
std::string write_pictures(const FailureFiles& files, const std::optional<sim::Image>& expected,
                           const sim::Image& actual) {
  std::filesystem::create_directories(files.folder);
  sim::write_png(files.actual(), actual);
  std::string text = "\n  actual:     " + files.actual().string();
  if (!expected) return text;
  sim::write_png(files.expected(), *expected);
  sim::write_png(files.difference(),
                 sim::difference_image(grown_to_hold(*expected, actual), grown_to_hold(actual, *expected)));
  return text + "\n  expected:   " + files.expected().string() + "\n  difference: " + files.difference().string();
}

}  // namespace

Verdict check_golden(const Store& store, const std::string& scene, const sim::Image& actual,
                     const std::filesystem::path& failures) {
  const std::filesystem::path path = store.picture_path(scene);
  std::optional<sim::Image> expected;
  if (std::filesystem::exists(path)) expected = sim::read_png(path);
  std::string report = golden_fault(store.find(scene), path, expected, actual);
  if (report.empty()) {
    const sim::CompareReport compared = sim::compare_images(*expected, actual);
    if (compared.result == sim::CompareResult::kSame) return {};
    report = sim::report_text(compared);
  }
  return {false, scene + ": " + report + write_pictures({failures, scene}, expected, actual) +
                     "\n  CRC-32 now: " + hex8(sim::picture_crc32(actual)) +
                     "\n  if the new picture is right: bash tests/golden/approve.sh " + scene};
}

PeerComparison& PeerComparison::operator+=(const PeerComparison& other) {
  covered += other.covered;
  covered_by_one += other.covered_by_one;
  compared += other.compared;
  beyond_tolerance += other.beyond_tolerance;
  worst = std::max(worst, other.worst);
  if (first_coverage.empty()) first_coverage = other.first_coverage;
  if (first_colour.empty()) first_colour = other.first_colour;
  return *this;
}

PeerComparison compare_with_peer(const TwoBackgrounds& ours, const TwoBackgrounds& peers, std::uint32_t tolerance) {
  PeerComparison result;
  const auto place = [&](std::uint32_t x, std::uint32_t y) {
    return "(" + std::to_string(x) + ", " + std::to_string(y) + "): ours " + colour_text(ours.first.at(x, y)) +
           ", the peer's " + colour_text(peers.first.at(x, y));
  };
  for (std::uint32_t y = 0; y < ours.first.height; ++y) {
    for (std::uint32_t x = 0; x < ours.first.width; ++x) {
      const bool by_us = ours.covered(x, y), by_peer = peers.covered(x, y);
      if (!by_us && !by_peer) continue;
      ++result.covered;
      if (by_us != by_peer) {
        if (result.covered_by_one++ == 0)
          result.first_coverage = place(x, y) + (by_us ? " (not covered)" : " (covered)");
        continue;
      }
      ++result.compared;
      const std::uint32_t distance = channel_distance(ours.first.at(x, y), peers.first.at(x, y));
      result.worst = std::max(result.worst, distance);
      if (distance > tolerance && result.beyond_tolerance++ == 0) result.first_colour = place(x, y);
    }
  }
  return result;
}

}  // namespace usuzumi::golden
