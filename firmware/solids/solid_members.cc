#include "firmware/solids/solid_members.h"

namespace usuzumi::firmware {
namespace {

/// Members 0 and 1 of solids that have no curved surface are the same.
bool is_curved(format::SolidKind kind) { return kind <= format::SolidKind::kFrustumCone; }

/// What a walk over a shape comes to.
class Counter final : public ShapeSink {
 public:
  void vertex(Vec3, Vec3) override { ++vertices; }
  void face(const std::uint32_t*, std::uint32_t count) override {
    ++faces;
    corners += count;
    indices += 3 * (count - 2);
  }
  std::uint32_t vertices = 0, faces = 0, corners = 0, indices = 0;
};

Counter counted(const format::Solid& solid, std::uint32_t member, const format::SolidDetail& detail) {
  Counter counter;
  tell_shape(solid.kind, solid.size, detail_of(solid.kind, member, detail), counter);
  return counter;
}

/// Sides of a section's circle: as many as member 2 has.
std::uint32_t section_sides(format::SolidKind kind, const format::SolidDetail& detail) {
  const std::uint32_t around = detail_of(kind, 2, detail).around;
  return around > 4 ? around : 4;
}

constexpr Vec3 kSides[kSectionCount] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

}  // namespace

/// Appends to the streams of SolidMembers, which have room.
class MemberWriter {
 public:
  MemberWriter(SolidMembers& to, std::span<Vec3> scratch) : to_(to), scratch_(scratch) {}

  void write(std::uint32_t n) {
    const format::Solid& solid = to_.view_.solids[n];
    placement_ = SolidPlacement::of(solid);
    mirrored_ = placement_.determinant() < 0;
    SolidMembers::Members& members = to_.members_[n];
    members = {};
    write_smooth(solid, 0, members);
    if (is_curved(solid.kind)) write_smooth(solid, 1, members);
    else members.of[1] = members.of[0];
    write_flat(solid, members);
    for (std::uint32_t side = 0; side < kSectionCount; ++side) write_section(solid, side, members.section[side]);
  }

 private:
  std::uint32_t add_vertex(Vec3 place, Vec3 normal) {
    to_.positions_[vertices_] = placement_.point(place);
    to_.normals_[vertices_] = pack_normal(placement_.normal(normal));
    return vertices_++;
  }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    to_.indices_[indices_++] = static_cast<std::uint16_t>(a);
    to_.indices_[indices_++] = static_cast<std::uint16_t>(mirrored_ ? c : b);
    to_.indices_[indices_++] = static_cast<std::uint16_t>(mirrored_ ? b : c);
  }

  class Smooth final : public ShapeSink {
   public:
    explicit Smooth(MemberWriter& writer) : writer_(writer) {}
    void vertex(Vec3 place, Vec3 normal) override { writer_.add_vertex(place, normal); }
    void face(const std::uint32_t* corners, std::uint32_t count) override {
      for (std::uint32_t i = 1; i + 1 < count; ++i) writer_.add_triangle(corners[0], corners[i], corners[i + 1]);
      ++faces;
    }
    std::uint32_t faces = 0;

   private:
    MemberWriter& writer_;
  };

  void write_smooth(const format::Solid& solid, std::uint32_t member, SolidMembers::Members& members) {
    DrawnMember& out = members.of[member];
    out.first_vertex = vertices_;
    out.first_index = indices_;
    Smooth smooth(*this);
    tell_shape(solid.kind, solid.size, detail_of(solid.kind, member, to_.view_.detail), smooth);
    out.vertex_count = vertices_ - out.first_vertex;
    out.index_count = indices_ - out.first_index;
    out.faces = smooth.faces;
  }

  class Flat final : public ShapeSink {
   public:
    Flat(MemberWriter& writer, std::uint32_t first_vertex) : writer_(writer), first_vertex_(first_vertex) {}
    void vertex(Vec3 place, Vec3) override { writer_.scratch_[count_++] = place; }
    void face(const std::uint32_t* corners, std::uint32_t count) override {
      const auto at = [&](std::uint32_t i) { return writer_.scratch_[corners[i]]; };
      const Vec3 normal = normalized(cross(at(1) - at(0), at(2) - at(0)));
      SolidMembers& to = writer_.to_;
      to.low_faces_[writer_.low_faces_++] = {candidates_that_see(normal, to.view_.candidates),
                                             static_cast<std::uint16_t>(writer_.vertices_ - first_vertex_),
                                             static_cast<std::uint16_t>(count)};
      for (std::uint32_t i = 0; i < count; ++i) writer_.add_vertex(at(i), normal);
      indices += 3 * (count - 2);
    }
    std::uint32_t indices = 0;

   private:
    MemberWriter& writer_;
    std::uint32_t first_vertex_, count_ = 0;
  };

  void write_flat(const format::Solid& solid, SolidMembers::Members& members) {
    DrawnMember& out = members.of[2];
    out.first_vertex = vertices_;
    out.first_index = indices_;
    members.first_low_face = low_faces_;
    Flat flat(*this, vertices_);
    tell_shape(solid.kind, solid.size, detail_of(solid.kind, 2, to_.view_.detail), flat);
    indices_ += flat.indices;  // room; gather() fills it
    out.vertex_count = vertices_ - out.first_vertex;
    out.faces = members.low_face_count = low_faces_ - members.first_low_face;
  }

  void write_section(const format::Solid& solid, std::uint32_t side, DrawnMember& out) {
    Vec3 places[format::kMaxAround];
    const std::uint32_t count =
        tell_section(solid.kind, solid.size, section_sides(solid.kind, to_.view_.detail), side, places);
    out = {vertices_, count, indices_, 3 * (count - 2), 1};
    for (std::uint32_t i = 0; i < count; ++i) add_vertex(places[i], kSides[side]);
    for (std::uint32_t i = 1; i + 1 < count; ++i) add_triangle(0, i, i + 1);
  }

  SolidMembers& to_;
  std::span<Vec3> scratch_;
  SolidPlacement placement_;
  bool mirrored_ = false;
  std::uint32_t vertices_ = 0, indices_ = 0, low_faces_ = 0;
};

/// Of all solids of one kind, which differ in size alone, the first is counted.
SolidMembers::Sizes SolidMembers::sizes_of(const SolidsView& solids) {
  struct OfKind {
    std::uint32_t solids = 0;
    const format::Solid* first = nullptr;
  };
  OfKind kinds[format::kSolidKindCount];
  for (const format::Solid& solid : solids.solids) {
    OfKind& kind = kinds[static_cast<std::uint32_t>(solid.kind)];
    if (kind.solids++ == 0) kind.first = &solid;
  }
  Sizes sizes;
  for (const OfKind& kind : kinds) {
    if (kind.solids == 0) continue;
    const format::Solid& solid = *kind.first;
    const Counter low = counted(solid, 2, solids.detail);
    std::uint64_t vertices = low.corners, indices = low.indices;
    for (std::uint32_t member = 0; member < (is_curved(solid.kind) ? 2u : 1u); ++member) {
      const Counter counter = counted(solid, member, solids.detail);
      vertices += counter.vertices;
      indices += counter.indices;
    }
    for (std::uint32_t side = 0; side < kSectionCount; ++side) {
      Vec3 places[format::kMaxAround];
      const std::uint32_t count =
          tell_section(solid.kind, solid.size, section_sides(solid.kind, solids.detail), side, places);
      vertices += count;
      indices += 3 * std::uint64_t{count - 2};
    }
    sizes.vertices += kind.solids * vertices;
    sizes.indices += kind.solids * indices;
    sizes.low_faces += std::uint64_t{kind.solids} * low.faces;
    if (low.vertices > sizes.scratch_vertices) sizes.scratch_vertices = low.vertices;
  }
  sizes.kept_bytes = sizes.vertices * (sizeof(Vec3) + sizeof(PackedNormal)) + (sizes.indices * 2 + 3) / 4 * 4 +
                     sizes.low_faces * sizeof(LowFace) + solids.solids.size() * sizeof(Members);
  return sizes;
}

std::uint64_t SolidMembers::bytes(const SolidsView& solids) { return sizes_of(solids).kept_bytes; }

Status SolidMembers::begin(const SolidsView& solids, Arena& ram) {
  view_ = {};
  if (solids.solids.empty()) return ok_status();
  const Sizes s = sizes_of(solids);
  const std::uint64_t needed = s.kept_bytes + s.scratch_vertices * sizeof(Vec3);
  const std::size_t mark = ram.used();
  const auto refused = [&] {
    ram.rewind(mark);
    return Status{StatusCode::kResourceExhausted, "RAM has no room for the members of the solids; bytes they take",
                  needed > 0xFFFFFFFFu ? 0xFFFFFFFFu : static_cast<std::uint32_t>(needed)};
  };
  if (needed > ram.available()) return refused();
  const auto take = [&]<class T>(std::uint64_t count, std::span<T>& to, std::size_t alignment) {
    to = ram.allocate<T>(static_cast<std::size_t>(count), alignment);
    return to.size() == count;
  };
  if (!take(s.vertices, positions_, 4) || !take(s.vertices, normals_, 4) ||
      !take((s.indices + 1) / 2 * 2, indices_, 4) || !take(s.low_faces, low_faces_, 4) ||
      !take(solids.solids.size(), members_, 4))
    return refused();
  const ScratchScope scope(ram);
  std::span<Vec3> scratch;
  if (!take(s.scratch_vertices, scratch, 4)) return refused();
  view_ = solids;
  MemberWriter writer(*this, scratch);
  for (std::uint32_t n = 0; n < count(); ++n) writer.write(n);
  return ok_status();
}

void SolidMembers::gather(Members& members, std::uint32_t candidate) {
  const format::Solid& solid = view_.solids[static_cast<std::size_t>(&members - members_.data())];
  const bool mirrored = SolidPlacement::of(solid).determinant() < 0;
  std::uint16_t* out = indices_.data() + members.of[2].first_index;
  members.gathered = candidate;
  members.gathered_indices = members.gathered_faces = 0;
  for (const LowFace& face : low_faces_.subspan(members.first_low_face, members.low_face_count)) {
    if ((face.seen_by >> candidate & 1) == 0) continue;
    ++members.gathered_faces;
    for (std::uint32_t i = 1; i + 1 < face.corner_count; ++i) {
      const auto at = [&](std::uint32_t corner) { return static_cast<std::uint16_t>(face.first_vertex + corner); };
      out[members.gathered_indices++] = at(0);
      out[members.gathered_indices++] = at(mirrored ? i + 1 : i);
      out[members.gathered_indices++] = at(mirrored ? i : i + 1);
    }
  }
}

DrawnMember SolidMembers::choose(std::uint32_t n, Member member, Vec3 to_viewer) {
  Members& members = members_[n];
  if (member == Member::kHigh || member == Member::kMedium) return members.of[static_cast<std::uint32_t>(member)];
  const SolidPlacement placement = SolidPlacement::of(view_.solids[n]);
  if (member == Member::kRough) return members.section[nearest_candidate(to_viewer, placement, kSides)];
  const std::uint32_t candidate = nearest_candidate(to_viewer, placement, view_.candidates);
  if (members.gathered != candidate) gather(members, candidate);
  DrawnMember drawn = members.of[2];
  drawn.index_count = members.gathered_indices;
  drawn.faces = members.gathered_faces;
  return drawn;
}

std::uint32_t SolidMembers::face_count(std::uint32_t n, Member member) const {
  return member == Member::kRough ? 1 : members_[n].of[static_cast<std::uint32_t>(member)].faces;
}

}  // namespace usuzumi::firmware
