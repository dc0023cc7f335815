// The thinned copy of the drawing data in RAM: what the 3D engine is told to draw (JP2015-22462A [0024], fig. 6).
//
// Memory is one run of blocks, one per mesh that is present, in the order in which they were built:
//     positions (12 bytes a vertex) | normals (4) | colours (4) | texture coordinates (8)
//     | indices (2 or 4 bytes each, padded to 4) | group words (4 each, see group_words() and live_faces())
// What a mesh has not is left out; so are vertices that stay in ROM, see CopyMesh::vertices_in_rom. A block that is
// dropped leaves a gap; compact() slides the later blocks down, so the free part is always one piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/arena.h"
#include "hal/command_list.h"
#include "hal/status.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

inline constexpr std::uint32_t kNoStream = 0xFFFFFFFF;

/// One mesh of the copy. Offsets count from its block's first byte; kNoStream where the block has no such stream.
/// Material and base colour are those of the drawing data.
struct CopyMesh {
  command::Topology topology = command::Topology::kTriangles;
  command::IndexFormat index_format = command::IndexFormat::kNone;
  std::uint32_t vertex_count = 0;
  std::uint32_t index_count = 0;
  std::uint32_t normal_offset = kNoStream;
  std::uint32_t colour_offset = kNoStream;
  std::uint32_t texture_coordinate_offset = kNoStream;
  std::uint32_t index_offset = kNoStream;
  bool two_sided = true;
  bool vertices_in_rom = false;  // vertices are those of the mesh in ROM, which the engine reads there; of its streams
                                 // the block has at most normals, where ROM has none
  bool has_group_words = false;  // behind its indices; see RamCopy::group_words()
  bool layered = false;          // indices are the slots of a chain of layers, of each group the first are drawn; see
                                 // RamCopy::live_faces()
  std::uint32_t faces = 0;  // that draw something: without the joins of a strip
};
static_assert(sizeof(CopyMesh) == 40, "every mesh of the drawing data takes as much of the RAM");

class RamCopy {
 public:
  static constexpr std::uint32_t kTableBytes = 64;  // a mesh's share of the table, at most

  RamCopy() = default;
  /// Takes a table of `mesh_max` entries and all that is left of `ram`. kResourceExhausted when the table does not fit.
  /// `rom_on_bus`: the engine reads the drawing data where they lie, so that vertices may be left there.
  Status begin(std::uint32_t mesh_max, Arena& ram, bool rom_on_bus = false);
  bool rom_on_bus() const { return rom_on_bus_; }

  /// Meshes of the drawing data; the copy's own count of meshes is new_mesh_max().
  std::uint32_t mesh_max() const { return static_cast<std::uint32_t>(slots_.size()); }
  std::uint32_t new_mesh_max() const { return present_; }
  std::uint64_t faces() const;

  bool present(std::uint32_t n) const { return slots_[n].present; }
  /// Only while present(n).
  const CopyMesh& mesh(std::uint32_t n) const { return slots_[n].mesh; }
  const std::byte* block(std::uint32_t n) const { return memory_.data() + slots_[n].offset; }
  std::uint32_t block_bytes(std::uint32_t n) const { return slots_[n].bytes; }
  /// Of a thinned mesh of several materials: where each group's faces end in the copy. Of a point or a line in such a
  /// mesh's place: the group that its vertex is of. Empty else; a whole mesh's groups are those of the drawing data.
  std::span<const std::uint32_t> group_words(std::uint32_t n) const;

  /// Of a layered mesh, whose block is moved along its chain where it lies (layered_mesh.h).
  std::span<std::byte> block_memory(std::uint32_t n) { return memory_.subspan(slots_[n].offset, slots_[n].bytes); }
  /// How many of each group's slots are drawn.
  std::span<std::uint32_t> live_faces(std::uint32_t n);
  void set_faces(std::uint32_t n, std::uint32_t faces) { slots_[n].mesh.faces = faces; }

  /// The free memory behind the last block, to build the next one in.
  std::span<std::byte> free_memory() const { return memory_.subspan(used_); }
  /// Makes the first `bytes` of free_memory() the block of mesh n, absent until now.
  void add(std::uint32_t n, const CopyMesh& mesh, std::uint32_t bytes);
  /// Forgets mesh n; its memory is free after compact().
  void drop(std::uint32_t n);
  void compact();
  /// Builders report the most of free_memory() that they touched.
  void note_use(std::size_t bytes_of_free_memory);

  /// Every block inside the memory and apart from the others, its streams inside it, and the counts consistent. Looks
  /// at each mesh, not at what its block holds.
  bool blocks_sound() const;
  /// Every index of mesh n, present in a sound block, below its vertex count.
  bool indices_sound(std::uint32_t n) const;
  /// Both, of every mesh: what must hold before the engine is told of the copy.
  bool sound() const;

  std::size_t used_bytes() const { return used_; }
  std::size_t peak_bytes() const { return peak_; }
  std::size_t capacity_bytes() const { return memory_.size(); }

 private:
  struct Slot {
    CopyMesh mesh;
    std::uint32_t offset = 0, bytes = 0;
    std::uint32_t next = 0;  // the mesh whose block follows in memory; mesh_max() ends the chain
    bool present = false;
  };
  static_assert(sizeof(Slot) <= kTableBytes);

  /// Where group words begin in the block; its end where there are none.
  std::uint32_t group_words_offset(std::uint32_t n) const;

  std::span<std::byte> memory_;
  std::span<Slot> slots_;
  std::uint32_t first_ = 0, last_ = 0;  // chain of blocks in memory order
  std::uint32_t present_ = 0;
  std::size_t used_ = 0, peak_ = 0;
  bool rom_on_bus_ = false;
  bool gaps_ = false;  // something was dropped since the last compact()
};

}  // namespace usuzumi::firmware
