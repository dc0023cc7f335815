// The members of all solids, made once at boot in RAM: vertices and faces in the model's coordinates.
//
// Members 0 and 1 are shaded smooth and share vertices; member 2 is flat, each face with vertices of its own and the
// candidates that see it; member 3 is six sections, one for each axis candidate. The paper leaves open how to save
// memory: solids of flat faces have one member for 0 and 1, and each section only the vertices of its outline.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/solids/solid_choice.h"
#include "firmware/solids/solid_format.h"
#include "firmware/solids/solid_shape.h"
#include "firmware/solids/solids_view.h"
#include "hal/arena.h"
#include "hal/status.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// What one solid is drawn from. Indices count from its first vertex.
struct DrawnMember {
  std::uint32_t first_vertex = 0, vertex_count = 0;  // in SolidMembers' streams
  std::uint32_t first_index = 0, index_count = 0;    // in SolidMembers::indices()
  std::uint32_t faces = 0;                           // as the paper counts: a quad is one, a base is one
};

class SolidMembers {
 public:
  /// Makes everything. kResourceExhausted, `where` the bytes it takes, those of its working space too, where `ram` has
  /// no room: nothing is kept then.
  Status begin(const SolidsView& solids, Arena& ram);
  /// Bytes that begin() keeps; 0 for no solids.
  static std::uint64_t bytes(const SolidsView& solids);

  std::uint32_t count() const { return static_cast<std::uint32_t>(view_.solids.size()); }
  const format::Solid& solid(std::uint32_t n) const { return view_.solids[n]; }
  const SolidsView& view() const { return view_; }

  /// What to draw of solid n. For member 2, the faces that the candidate nearest to the viewer sees are gathered first;
  /// for member 3 the section of the nearest axis candidate is taken. `to_viewer`: from the solid's origin.
  DrawnMember choose(std::uint32_t n, Member member, Vec3 to_viewer);
  /// Faces that member 0, 1 or 2 of solid n has, hidden ones included; 1 of member 3.
  std::uint32_t face_count(std::uint32_t n, Member member) const;

  std::span<const Vec3> positions() const { return positions_; }
  std::span<const PackedNormal> normals() const { return normals_; }
  std::span<const std::uint16_t> indices() const { return indices_; }

 private:
  friend class MemberWriter;

  struct LowFace {
    std::uint32_t seen_by = 0;  // candidates, bit by bit
    std::uint16_t first_vertex = 0, corner_count = 0;
  };
  struct Members {
    DrawnMember of[format::kFacedMembers];    // of member 2 the vertices, and room for the indices of all its faces
    std::uint32_t first_low_face = 0, low_face_count = 0;
    DrawnMember section[kSectionCount];
    std::uint32_t gathered = kNoCandidate;    // the candidate whose faces the indices of member 2 hold
    std::uint32_t gathered_indices = 0, gathered_faces = 0;
  };
  static constexpr std::uint32_t kNoCandidate = 0xFFFFFFFFu;
  struct Sizes {
    std::uint64_t vertices = 0, indices = 0, low_faces = 0, scratch_vertices = 0, kept_bytes = 0;
  };
  static Sizes sizes_of(const SolidsView& solids);
  void gather(Members& members, std::uint32_t candidate);

  SolidsView view_;
  std::span<Vec3> positions_;
  std::span<PackedNormal> normals_;
  std::span<std::uint16_t> indices_;
  std::span<LowFace> low_faces_;
  std::span<Members> members_;
};

}  // namespace usuzumi::firmware
