// Drawing data in ROM, read in place: a checked view of either format.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/drawing_data/format.h"
#include "hal/status.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// Thinning level as stored; unset is treated as keep ([0022]).
enum class Level : std::uint32_t { kUnset = 0, kKeep = 1, kDelete = 2, kCollapse = 3, kPoint = 4, kLine = 5 };
inline constexpr std::uint32_t kLevelCount = 6;

/// One mesh as it lies in ROM. Spans point into the ROM; every index was checked.
struct MeshView {
  std::uint32_t number = 0;  // from 0; the patent counts from 1
  Level level = Level::kUnset;
  format::Topology topology = format::Topology::kStrip;
  std::span<const Vec3> positions;
  std::span<const PackedNormal> normals;   // empty or as many as positions
  std::span<const Rgba8> colours;          // empty or as many as positions
  std::span<const std::byte> indices;      // kIndexed: index_count * index_bytes
  std::uint32_t index_bytes = 0;
  std::uint32_t index_count = 0;
  Rgba8 base_colour{};
  format::QuotaKind quota_kind = format::QuotaKind::kNone;
  std::uint32_t quota = 0;
  float area_threshold_px = -1;
  std::uint32_t flags = 0;
  std::string_view name;                   // empty in bare data

  bool telltale() const { return (flags & format::kFlagTelltale) != 0; }
  bool two_sided() const { return (flags & format::kFlagTwoSided) != 0; }
  /// Faces as the topology counts them, the joins between the runs of a strip included.
  std::uint32_t face_count() const;
  /// Vertex numbers of face f < face_count(), wound as drawn: odd faces of a strip have their first two swapped.
  void face(std::uint32_t f, std::uint32_t out[3]) const;
  /// The same; false where two corners stand at one place. A join repeats a place, not a vertex number, in data without
  /// indices; such a face draws nothing, and whoever thins or counts faces leaves it out.
  bool proper_face(std::uint32_t f, std::uint32_t out[3]) const;
  /// Faces with their corners at three places. Looks at every face.
  std::uint32_t proper_face_count() const;
};

class DrawingData {
 public:
  DrawingData() = default;
  /// Checks all of `rom` (4-byte aligned): sizes, offsets, CRC-32, levels, indices, coordinates. Bare data is what
  /// does not begin with the container's magic and fills `rom` exactly.
  /// kDataLoss or kUnsupported with the byte offset in `where`.
  static Result<DrawingData> open(std::span<const std::byte> rom);

  bool bare() const { return bare_; }
  std::uint32_t mesh_max() const { return mesh_max_; }
  /// n < mesh_max(). Constant time in a container, linear in n in bare data.
  MeshView mesh(std::uint32_t n) const;
  /// Constant time in both formats: the caller kept where the n-th record begins, see first_record() and next_record().
  MeshView mesh_at(std::uint32_t n, std::uint32_t record_offset) const;
  std::uint32_t first_record() const { return first_record_; }
  std::uint32_t next_record(std::uint32_t record_offset) const;
  /// Calls `visit(MeshView)` for every mesh in order; linear in both formats.
  template <class Visit>
  void for_each_mesh(Visit&& visit) const {
    std::uint32_t record = first_record_;
    for (std::uint32_t n = 0; n < mesh_max_; ++n, record = next_record(record)) visit(mesh_at(n, record));
  }
  std::span<const std::byte> bytes() const { return rom_; }
  /// The board it was packed for; empty where it is for any, as bare data always are.
  std::string_view board() const { return board_; }

 private:
  std::span<const std::byte> rom_;
  std::string_view board_;
  bool bare_ = true;
  std::uint32_t mesh_max_ = 0;
  std::uint32_t first_record_ = 4;
  std::uint32_t descriptors_offset_ = 0;
};

}  // namespace usuzumi::firmware
