#include "sim/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "sim/common/error.h"
#include "sim/image/png.h"

namespace usuzumi::sim {
namespace {

/// The largest difference of the three channels.
std::uint32_t channel_difference(std::uint32_t a, std::uint32_t b) {
  std::uint32_t largest = 0;
  for (unsigned shift = 0; shift < 24; shift += 8) {
    const std::uint32_t ca = a >> shift & 0xFF, cb = b >> shift & 0xFF;
    largest = std::max(largest, ca > cb ? ca - cb : cb - ca);
  }
  return largest;
}

bool is_ignored(std::uint32_t x, std::uint32_t y, const CompareOptions& options) {
  return std::any_of(options.ignore.begin(), options.ignore.end(),
                     [=](const Rectangle& r) { return r.contains(x, y); });
}

CompareReport cannot_compare(std::string reason) {
  CompareReport report;
  report.result = CompareResult::kCannotCompare;
  report.reason = std::move(reason);
  return report;
}

void note_difference(CompareReport& report, const DifferingPixel& pixel) {
  ++report.pixels_differing;
  if (!report.first) {
    report.first = pixel;
    report.bounds = Rectangle{pixel.x, pixel.y, pixel.x, pixel.y};
  }
  Rectangle& b = *report.bounds;
  b = {std::min(b.x0, pixel.x), std::min(b.y0, pixel.y), std::max(b.x1, pixel.x), std::max(b.y1, pixel.y)};
}

std::string colour(std::uint32_t rgb) { return fmt::format("#{:06X}", rgb & 0xFFFFFF); }

/// As parse_rectangle() takes it.
std::string rectangle_text(const Rectangle& r) { return fmt::format("{}:{}-{}:{}", r.x0, r.y0, r.x1, r.y1); }

const char* result_name(CompareResult result) {
  switch (result) {
    case CompareResult::kSame: return "same";
    case CompareResult::kDiffer: return "differ";
    case CompareResult::kCannotCompare: return "cannot-compare";
  }
  return "result out of range";
}

}  // namespace

std::optional<Rectangle> parse_rectangle(std::string_view text) {
  Rectangle r;
  const char* p = text.data();
  const char* const end = p + text.size();
  const auto number = [&](std::uint32_t& value) {
    const auto [next, error] = std::from_chars(p, end, value);
    if (error != std::errc{}) return false;
    p = next;
    return true;
  };
  const auto separator = [&](char c) { return p != end && *p++ == c; };
  const bool parsed = number(r.x0) && separator(':') && number(r.y0) && separator('-') && number(r.x1) &&
                      separator(':') && number(r.y1) && p == end;
  if (!parsed || r.x1 < r.x0 || r.y1 < r.y0) return std::nullopt;
  return r;
}

int exit_code(CompareResult result) {
  switch (result) {
    case CompareResult::kSame: return exit_status(ExitCode::kOk);
    case CompareResult::kDiffer: return exit_status(ExitCode::kDifference);
    case CompareResult::kCannotCompare: break;
  }
  return exit_status(ExitCode::kUsage);
}

CompareReport compare_images(const Image& expected, const Image& actual, const CompareOptions& options) {
  if (expected.width != actual.width || expected.height != actual.height)
    return cannot_compare(fmt::format("sizes differ: expected {}x{}, actual {}x{}; draw both at one size",
                                      expected.width, expected.height, actual.width, actual.height));
  for (const Rectangle& r : options.ignore)
    if (r.x0 >= expected.width || r.y0 >= expected.height)
      return cannot_compare(
          fmt::format("the ignored rectangle {} lies outside the picture of {}x{}; correct it or leave it out",
                      rectangle_text(r), expected.width, expected.height));
  CompareReport report;
  for (std::uint32_t y = 0; y < expected.height; ++y) {
    for (std::uint32_t x = 0; x < expected.width; ++x) {
      if (!options.ignore.empty() && is_ignored(x, y, options)) continue;
      ++report.pixels_compared;
      const std::uint32_t e = expected.at(x, y) & 0xFFFFFF, a = actual.at(x, y) & 0xFFFFFF;
      if (e == a) continue;
      const std::uint32_t difference = channel_difference(e, a);
      report.largest_difference = std::max(report.largest_difference, difference);
      if (difference > options.max_diff) note_difference(report, {x, y, e, a});
    }
  }
  if (report.pixels_compared == 0)
    return cannot_compare("no pixel is left outside the ignored rectangles; ignore less");
  if (report.pixels_differing > options.max_pixels) report.result = CompareResult::kDiffer;
  return report;
}

CompareReport compare_png_files(const std::filesystem::path& expected_path, const std::filesystem::path& actual_path,
                                const CompareOptions& options,
                                const std::optional<std::filesystem::path>& difference_picture) {
  Image expected, actual;
  try {
    expected = read_png(expected_path);
    actual = read_png(actual_path);
  } catch (const Error& error) {
    return cannot_compare(error.what());
  }
  CompareReport report = compare_images(expected, actual, options);
  if (report.result == CompareResult::kCannotCompare)
    report.reason = fmt::format("{} and {}: {}", expected_path.string(), actual_path.string(), report.reason);
  else if (difference_picture) write_png(*difference_picture, difference_image(expected, actual, options));
  return report;
}

Image difference_image(const Image& expected, const Image& actual, const CompareOptions& options) {
  Image picture(expected.width, expected.height);
  for (std::uint32_t y = 0; y < expected.height; ++y) {
    for (std::uint32_t x = 0; x < expected.width; ++x) {
      const std::uint32_t e = expected.at(x, y);
      const std::uint32_t grey = ((e >> 16 & 0xFF) * 2 + (e >> 8 & 0xFF) * 5 + (e & 0xFF)) / 8 / 3;  // luma / 3
      const std::uint32_t difference = channel_difference(e, actual.at(x, y));
      std::uint32_t shown = grey << 16 | grey << 8 | grey;
      if (is_ignored(x, y, options))
        shown = grey << 16 | grey << 8 | (grey + 80);
      else if (difference > options.max_diff)
        shown = (127 + (difference + 1) / 2) << 16;
      else if (difference > 0)
        shown = 0x00008000;
      picture.at(x, y) = shown;
    }
  }
  return picture;
}

std::string report_text(const CompareReport& report) {
  if (report.result == CompareResult::kCannotCompare) return fmt::format("cannot compare: {}\n", report.reason);
  std::string text;
  if (report.result == CompareResult::kSame && report.largest_difference == 0) return "same: every pixel is equal\n";
  text = fmt::format("{}: {} of {} pixels differ, largest channel difference {}\n",
                     report.result == CompareResult::kSame ? "same within tolerance" : "differ",
                     report.pixels_differing, report.pixels_compared, report.largest_difference);
  if (report.first)
    text += fmt::format("first at x={} y={}: expected {}, actual {}\n", report.first->x, report.first->y,
                        colour(report.first->expected), colour(report.first->actual));
  if (report.bounds) text += fmt::format("all within {}\n", rectangle_text(*report.bounds));
  return text;
}

std::string report_json(const CompareReport& report) {
  nlohmann::ordered_json json;
  json["result"] = result_name(report.result);
  json["reason"] = report.reason.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(report.reason);
  json["pixels_compared"] = report.pixels_compared;
  json["pixels_differing"] = report.pixels_differing;
  json["largest_difference"] = report.largest_difference;
  json["first"] = nullptr;
  if (report.first)
    json["first"] = {{"x", report.first->x},
                     {"y", report.first->y},
                     {"expected", colour(report.first->expected)},
                     {"actual", colour(report.first->actual)}};
  json["bounds"] = nullptr;
  if (report.bounds)
    json["bounds"] = {
        {"x0", report.bounds->x0}, {"y0", report.bounds->y0}, {"x1", report.bounds->x1}, {"y1", report.bounds->y1}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace usuzumi::sim
