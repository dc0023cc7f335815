// Drawing data in ROM, read in place: a checked view of either format.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/drawing_data/mesh_view.h"
#include "firmware/solids/solids_view.h"
#include "hal/status.h"

namespace usuzumi::firmware {

class DrawingData {
 public:
  DrawingData() = default;
  /// Checks all of `rom` (4-byte aligned): sizes, offsets, CRC-32, levels, indices, coordinates, textures. Bare data is
  /// what does not begin with the container's magic and fills `rom` exactly.
  /// kDataLoss or kUnsupported with the byte offset in `where`.
  static Result<DrawingData> open(std::span<const std::byte> rom);

  bool bare() const { return bare_; }
  /// 0 only where there are solids.
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
  /// 0 in bare data, as material_count() is.
  std::uint32_t texture_count() const { return texture_count_; }
  TextureView texture(std::uint32_t n) const;    // n < texture_count()
  std::uint32_t material_count() const { return material_count_; }
  MaterialView material(std::uint32_t n) const;  // n < material_count(), or kAbsent: the default
  /// Empty where there are none, as in bare data.
  const SolidsView& solids() const { return solids_; }
  std::string_view name_of(const format::Solid& solid) const { return text(solid.name_offset, solid.name_bytes); }
  std::span<const std::byte> bytes() const { return rom_; }
  /// The board it was packed for; empty where it is for any, as bare data always are.
  std::string_view board() const { return board_; }

 private:
  Status check_layers() const;
  std::string_view text(std::uint32_t offset, std::uint32_t bytes) const;

  std::span<const std::byte> rom_;
  std::string_view board_;
  bool bare_ = true;
  std::uint32_t mesh_max_ = 0;
  std::uint32_t first_record_ = 4;
  std::uint32_t descriptors_offset_ = 0;
  std::uint32_t layers_end_ = 0;  // of section LAYR
  std::uint32_t materials_offset_ = 0, material_count_ = 0;
  std::uint32_t textures_offset_ = 0, texture_count_ = 0;
  SolidsView solids_;
};

}  // namespace usuzumi::firmware
