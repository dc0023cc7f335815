#include "tests/golden/player/bundle.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "hal/crc32.h"

namespace usuzumi::golden {
namespace {

using namespace bundle;

constexpr std::uint32_t kMaxSize = 4096;  // pixels either way
constexpr std::uint32_t kDoubleBytes = 8;

Status data_loss(const char* message, std::uint32_t where) { return {StatusCode::kDataLoss, message, where}; }

template <class T>
T load(std::span<const std::byte> bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

bool inside(std::span<const std::byte> bytes, const Block& block) {
  return block.offset % 4 == 0 && block.offset <= bytes.size() && block.bytes <= bytes.size() - block.offset;
}

/// A record of type T that fills its block.
template <class T>
Result<T> record_in(std::span<const std::byte> bytes, const Block& block, const char* message) {
  if (!inside(bytes, block) || block.bytes != sizeof(T)) return data_loss(message, block.offset);
  return load<T>(bytes, block.offset);
}

Result<std::string_view> text_in(std::span<const std::byte> bytes, const Block& block, std::uint32_t most) {
  if (!inside(bytes, block) || block.bytes == 0 || block.bytes > most)
    return data_loss("bundle: a text is empty, too long or beyond the end, at byte", block.offset);
  return std::string_view(reinterpret_cast<const char*>(bytes.data() + block.offset), block.bytes);
}

template <class T>
bool is_table_of(std::span<const std::byte> bytes, const Block& block) {
  return inside(bytes, block) && block.bytes % sizeof(T) == 0;
}

bool plane_fits(const PlaneRecord& plane, std::uint32_t row_bytes, std::uint32_t height, std::uint32_t vram_bytes) {
  const std::uint64_t end = std::uint64_t{plane.offset} + std::uint64_t{plane.stride_bytes} * (height - 1) + row_bytes;
  return plane.row_bytes == row_bytes && plane.stride_bytes >= row_bytes && end <= vram_bytes;
}

bool size_ok(std::uint32_t width, std::uint32_t height) {
  return width >= 1 && height >= 1 && width <= kMaxSize && height <= kMaxSize;
}

template <class Enum>
bool in_range(std::uint32_t value, Enum last) {
  return value <= static_cast<std::uint32_t>(last);
}

std::span<const std::uint32_t> words_in(std::span<const std::byte> bytes, const Block& block) {
  return {reinterpret_cast<const std::uint32_t*>(bytes.data() + block.offset), block.bytes / sizeof(std::uint32_t)};
}

bool policy_in(std::span<const std::byte> bytes, const PolicyRecord& record, firmware::Policy& policy) {
  if (!in_range(record.kind, firmware::PolicyKind::kRandom) || !is_table_of<std::uint32_t>(bytes, record.chosen))
    return false;
  policy.kind = static_cast<firmware::PolicyKind>(record.kind);
  policy.area_threshold_px = std::bit_cast<float>(record.area_threshold_px);
  policy.random_millionths = record.random_millionths;
  policy.seed = record.seed;
  policy.chosen = words_in(bytes, record.chosen);
  return !std::isnan(policy.area_threshold_px);
}

bool settings_in(std::span<const std::byte> bytes, const RunRecord& record, firmware::ThinningSettings& settings) {
  if (record.thinning_enabled > 1 || !in_range(record.placement, firmware::Placement::kMidpoint) ||
      !in_range(record.quota_kind, firmware::format::QuotaKind::kMillionths) ||
      !in_range(record.layer_mode, firmware::LayerMode::kAutomatic))
    return false;
  settings.layers.mode = static_cast<firmware::LayerMode>(record.layer_mode);
  settings.enabled = record.thinning_enabled == 1;
  settings.placement = static_cast<firmware::Placement>(record.placement);
  settings.quota = {static_cast<firmware::format::QuotaKind>(record.quota_kind), record.quota};
  return policy_in(bytes, record.delete_policy, settings.delete_policy) &&
         policy_in(bytes, record.collapse_policy, settings.collapse_policy);
}

bool finite_angles(std::span<const std::byte> bytes, const Block& angles) {
  for (std::uint32_t at = 0; at < angles.bytes; at += kDoubleBytes)
    if (!std::isfinite(load<double>(bytes, std::size_t{angles.offset} + at))) return false;
  return true;
}

}  // namespace

Result<Bundle> Bundle::open(std::span<const std::byte> bytes) {
  if (bytes.data() == nullptr || reinterpret_cast<std::uintptr_t>(bytes.data()) % 4 != 0)
    return Status{StatusCode::kInvalidArgument, "bundle: must lie at a multiple of 4", 0};
  if (bytes.size() < sizeof(Header))
    return data_loss("bundle: shorter than its header; bytes", static_cast<std::uint32_t>(bytes.size()));
  const auto header = load<Header>(bytes, 0);
  if (header.magic != kMagic) return data_loss("bundle: this is no bundle of golden cases; first word", header.magic);
  if (header.version != kVersion)
    return Status{StatusCode::kUnsupported, "bundle: another version; record it again with this build", header.version};
  if (header.bytes < sizeof(Header) || header.bytes > bytes.size())
    return data_loss("bundle: cut short; it should have this many bytes", header.bytes);
  const auto all = bytes.first(header.bytes);  // ROM may go on behind it
  if (header.case_count > (all.size() - sizeof(Header)) / sizeof(CaseRecord))
    return data_loss("bundle: fewer cases than it says", header.case_count);
  if (crc32(kCrc32Start, all.subspan(sizeof(Header))) != header.crc32)
    return data_loss("bundle: damaged; its CRC-32 should be", header.crc32);
  Bundle opened;
  opened.bytes_ = all;
  opened.case_count_ = header.case_count;
  return opened;
}

CaseRecord Bundle::record(std::uint32_t n) const {
  return load<CaseRecord>(bytes_, sizeof(Header) + std::size_t{n} * sizeof(CaseRecord));
}

Result<Bundle::Heading> Bundle::heading(std::uint32_t n) const {
  const CaseRecord r = record(n);
  const auto name = text_in(bytes_, r.name, kNameMax);
  if (!name.ok()) return name.status();
  const auto kind = static_cast<Kind>(r.kind);
  if (kind != Kind::kScene && kind != Kind::kRun) return data_loss("bundle: neither scene nor run; case", n);
  return Heading{*name, kind};
}

Result<std::string_view> Bundle::exclusion(std::uint32_t n, std::string_view board) const {
  const Block table = record(n).exclusions;
  if (!is_table_of<ExclusionRecord>(bytes_, table))
    return data_loss("bundle: no table of boards at byte", table.offset);
  for (std::uint32_t at = 0; at < table.bytes; at += sizeof(ExclusionRecord)) {
    const auto excluded = load<ExclusionRecord>(bytes_, std::size_t{table.offset} + at);
    const auto name = text_in(bytes_, excluded.board, kBoardMax), reason = text_in(bytes_, excluded.reason, kReasonMax);
    if (!name.ok()) return name.status();
    if (!reason.ok()) return reason.status();
    if (*name == board) return *reason;
  }
  return std::string_view{};
}

Result<SceneCase> Bundle::scene(std::uint32_t n) const {
  const Block details = record(n).details;
  const auto found = record_in<SceneRecord>(bytes_, details, "bundle: no scene at byte");
  if (!found.ok()) return found.status();
  const SceneRecord& r = *found;
  const auto format = static_cast<command::PixelFormat>(r.pixel_format);
  if (!size_ok(r.width, r.height) || !in_range(r.pixel_format, command::PixelFormat::kXrgb8888))
    return data_loss("bundle: unknown format, or a size not of 1 to 4096 pixels, at byte", details.offset);
  const bool has_depth = r.depth.row_bytes > 0;
  if (!plane_fits(r.colour, r.width * command::bytes_per_pixel(format), r.height, r.vram_bytes) ||
      (has_depth && !plane_fits(r.depth, r.depth.row_bytes, r.height, r.vram_bytes)))
    return data_loss("bundle: a plane reaches beyond the scene's VRAM, at byte", details.offset);
  if (!inside(bytes_, r.data) || !is_table_of<Block>(bytes_, r.lists))
    return data_loss("bundle: vertices or lists beyond the end, at byte", details.offset);
  SceneCase scene{r.width, r.height, format, r.background_pixel, r.vram_bytes, r.colour, r.depth, {}, 0};
  scene.data = bytes_.subspan(r.data.offset, r.data.bytes);
  scene.list_count = r.lists.bytes / static_cast<std::uint32_t>(sizeof(Block));
  return scene;
}

Result<std::span<const std::uint32_t>> Bundle::list(std::uint32_t n, std::uint32_t i) const {
  const auto lists = load<SceneRecord>(bytes_, record(n).details.offset).lists;
  const auto words = load<Block>(bytes_, lists.offset + std::size_t{i} * sizeof(Block));
  if (words.bytes == 0 || !is_table_of<std::uint32_t>(bytes_, words))
    return data_loss("bundle: no command list at byte", words.offset);
  return std::span(reinterpret_cast<const std::uint32_t*>(bytes_.data() + words.offset), words.bytes / 4);
}

Result<RunCase> Bundle::run(std::uint32_t n) const {
  const Block details = record(n).details;
  const auto found = record_in<RunRecord>(bytes_, details, "bundle: no run at byte");
  if (!found.ok()) return found.status();
  const RunRecord& r = *found;
  if (!size_ok(r.width, r.height) || !in_range(r.pixel_format, command::PixelFormat::kXrgb8888) ||
      !in_range(r.depth_format, command::DepthFormat::kUnorm24))
    return data_loss("bundle: unknown format, or a size not of 1 to 4096 pixels, at byte", details.offset);
  RunCase run;
  if (!settings_in(bytes_, r, run.thinning)) return data_loss("bundle: undefined settings at byte", details.offset);
  if (!inside(bytes_, r.rom) || !inside(bytes_, r.angles) || r.angles.bytes % kDoubleBytes != 0 ||
      r.angles.bytes < 2 * kDoubleBytes || !finite_angles(bytes_, r.angles))
    return data_loss("bundle: no drawing data, or not two angles and more, at byte", details.offset);
  if (!is_table_of<std::uint32_t>(bytes_, r.quotas) || !is_table_of<std::uint32_t>(bytes_, r.boot_layers))
    return data_loss("bundle: quotas or layers beyond the end, at byte", details.offset);
  run.quotas_millionths = words_in(bytes_, r.quotas);
  run.boot_layers_millionths = words_in(bytes_, r.boot_layers);
  if (!is_table_of<firmware::Thresholds>(bytes_, r.thresholds))
    return data_loss("bundle: thresholds beyond the end, at byte", details.offset);
  run.thresholds = {reinterpret_cast<const firmware::Thresholds*>(bytes_.data() + r.thresholds.offset),
                    r.thresholds.bytes / sizeof(firmware::Thresholds)};
  run.width = r.width;
  run.height = r.height;
  run.pixel_format = static_cast<command::PixelFormat>(r.pixel_format);
  run.depth_format = static_cast<command::DepthFormat>(r.depth_format);
  run.ram_bytes = r.ram_bytes;
  run.background = {r.background};
  run.elevation_rad = load<double>(bytes_, r.angles.offset);
  run.frame_count = r.angles.bytes / kDoubleBytes - 1;
  if (!run.quotas_millionths.empty() && run.quotas_millionths.size() != run.frame_count)
    return data_loss("bundle: not a quota for every frame, at byte", details.offset);
  if (!run.thresholds.empty() && run.thresholds.size() != run.frame_count)
    return data_loss("bundle: not thresholds for every frame, at byte", details.offset);
  run.rom = bytes_.subspan(r.rom.offset, r.rom.bytes);
  return run;
}

double Bundle::azimuth_rad(std::uint32_t n, std::uint32_t frame) const {
  const auto angles = load<RunRecord>(bytes_, record(n).details.offset).angles;
  return load<double>(bytes_, angles.offset + std::size_t{kDoubleBytes} * (frame + 1));
}

}  // namespace usuzumi::golden
