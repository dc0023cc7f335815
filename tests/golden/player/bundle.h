// The bundle: one file with everything that the golden cases need and none of their answers. A board reads it in place,
// from ROM.
//
// Little-endian 32-bit words. Offsets are bytes from the bundle's first byte; the bundle and every block in it begin at
// multiples of 4. A Header, its cases one CaseRecord each, and the blocks they point to, in any order. A case is a
// scene, which begins at command lists, or a run, which begins at drawing data and boots the whole device.
//
// A scene's lists are executed where they lie. Their addresses are those of SceneBus: vertices and indices from
// kDataBase on, VRAM from kVramBase on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/solids/solid_choice.h"
#include "firmware/thinning/policy.h"
#include "hal/bus.h"
#include "hal/command_list.h"
#include "hal/status.h"
#include "hal/vec.h"

namespace usuzumi::golden {

namespace bundle {

inline constexpr std::uint32_t kMagic = 0x42475A55;  // "UZGB"
inline constexpr std::uint32_t kVersion = 3;
inline constexpr BusAddress kDataBase = 0x10000000, kVramBase = 0x20000000;
/// Longest texts, in bytes.
inline constexpr std::uint32_t kNameMax = 48, kBoardMax = 32, kReasonMax = 120;

struct Block {
  std::uint32_t offset, bytes;
};
struct Header {
  std::uint32_t magic, version;
  std::uint32_t bytes;       // of the whole bundle
  std::uint32_t crc32;       // of all that follows the header
  std::uint32_t case_count;  // CaseRecords, from behind the header on
};
struct CaseRecord {
  Block name;        // as in the manifest
  Block exclusions;  // an ExclusionRecord for every board that the case is too big for
  std::uint32_t kind;
  Block details;  // a SceneRecord or a RunRecord
};
enum class Kind : std::uint32_t { kScene = 1, kRun = 2 };
struct ExclusionRecord {
  Block board, reason;
};

/// Rows of `row_bytes`, `stride_bytes` apart, from `offset` in VRAM on. All zero where there is no such plane.
struct PlaneRecord {
  std::uint32_t offset, stride_bytes, row_bytes;
};
struct SceneRecord {
  std::uint32_t width, height;     // pixels
  std::uint32_t pixel_format;      // command::PixelFormat
  std::uint32_t background_pixel;  // what every pixel holds before the first list, as the format has it
  std::uint32_t vram_bytes;
  PlaneRecord colour, depth;
  Block data;   // at kDataBase
  Block lists;  // of Blocks: command lists, in order
};

struct PolicyRecord {
  std::uint32_t kind;  // firmware::PolicyKind
  std::uint32_t area_threshold_px;  // the bits of a single
  std::uint32_t random_millionths, seed;
  Block chosen;  // mesh numbers
};
struct RunRecord {
  std::uint32_t width, height;               // pixels
  std::uint32_t pixel_format, depth_format;  // of hal/command_list.h
  std::uint32_t ram_bytes;                   // the firmware's work area has exactly so many
  std::uint32_t background;                  // Rgba8
  std::uint32_t thinning_enabled, placement;  // firmware::ThinningSettings
  std::uint32_t quota_kind, quota;
  PolicyRecord delete_policy, collapse_policy;
  std::uint32_t layer_mode;  // firmware::LayerMode
  Block quotas;              // one a frame, of millionths, in place of the quota above; or empty
  Block boot_layers;         // words, DeviceConfig::boot_layers_millionths
  Block thresholds;          // three singles a frame, SolidSettings::thresholds; or empty
  Block angles;  // doubles, low word first, radians: the camera's elevation, then its azimuth for each frame
  Block rom;     // drawing data
};

}  // namespace bundle

/// A scene as checked: spans point into the bundle, planes lie within vram_bytes.
struct SceneCase {
  std::uint32_t width = 0, height = 0;
  command::PixelFormat pixel_format = command::PixelFormat::kXrgb8888;
  std::uint32_t background_pixel = 0;
  std::uint32_t vram_bytes = 0;
  bundle::PlaneRecord colour{}, depth{};
  std::span<const std::byte> data;
  std::uint32_t list_count = 0;
};

/// A run as checked. The drawing data is not: that is the firmware's to do.
struct RunCase {
  std::uint32_t width = 0, height = 0;
  command::PixelFormat pixel_format = command::PixelFormat::kXrgb8888;
  command::DepthFormat depth_format = command::DepthFormat::kNone;
  std::uint32_t ram_bytes = 0;
  Rgba8 background{};
  firmware::ThinningSettings thinning;
  double elevation_rad = 0;
  std::uint32_t frame_count = 0;
  std::span<const std::uint32_t> quotas_millionths;  // frame_count, or none
  std::span<const std::uint32_t> boot_layers_millionths;
  std::span<const firmware::Thresholds> thresholds;  // frame_count, or none
  std::span<const std::byte> rom;
};

class Bundle {
 public:
  Bundle() = default;
  /// Checks header, length and CRC-32. kDataLoss for what is cut short, damaged or no bundle, kUnsupported for another
  /// version; `where` is the byte.
  static Result<Bundle> open(std::span<const std::byte> bytes);

  std::uint32_t case_count() const { return case_count_; }

  /// What all cases have. n < case_count(), and below for cases that one of these was asked for. kDataLoss with the
  /// byte of the record or block at fault.
  struct Heading {
    std::string_view name;
    bundle::Kind kind = bundle::Kind::kScene;
  };
  Result<Heading> heading(std::uint32_t n) const;
  /// Why the case is not for the board; empty where it is.
  Result<std::string_view> exclusion(std::uint32_t n, std::string_view board) const;
  Result<SceneCase> scene(std::uint32_t n) const;
  /// i < SceneCase::list_count.
  Result<std::span<const std::uint32_t>> list(std::uint32_t n, std::uint32_t i) const;
  Result<RunCase> run(std::uint32_t n) const;
  /// frame < RunCase::frame_count; only after run().
  double azimuth_rad(std::uint32_t n, std::uint32_t frame) const;

 private:
  bundle::CaseRecord record(std::uint32_t n) const;

  std::span<const std::byte> bytes_;
  std::uint32_t case_count_ = 0;
};

}  // namespace usuzumi::golden
