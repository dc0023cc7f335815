#include "firmware/simplify/weld.h"

#include <bit>

namespace usuzumi::firmware {
namespace {

constexpr std::uint32_t kFree = 0xFFFFFFFFu;

// -0 and 0 compare equal, so they must hash alike; adding +0 turns -0 into +0.
std::uint32_t bits_of(float f) { return std::bit_cast<std::uint32_t>(f + 0.0f); }

// Multiply and fold, so that the low bits depend on all the bits of the key. The constants are arbitrary odd numbers.
std::uint32_t mixed(std::uint32_t hash, std::uint32_t bits) {
  hash = (hash ^ bits) * 0x9E3779B1u;
  return hash ^ (hash >> 15);
}

std::uint32_t hash_position(Vec3 p) {
  return mixed(mixed(mixed(0x2545F491u, bits_of(p.x)), bits_of(p.y)), bits_of(p.z));
}

// Groups are few: as many as one mesh has materials.
std::uint32_t group_of(std::span<const MaterialGroup> groups, std::uint32_t wedge) {
  std::uint32_t g = 0;
  while (g + 1 < groups.size() && wedge >= groups[g].vertex_end) ++g;
  return g;
}

// Finds every entry's first equal. `hash` and `equal` see wedge numbers.
template <class Hash, class Equal>
bool find_first_equals(std::uint32_t count, std::span<std::uint32_t> table, std::span<std::uint32_t> first, Hash hash,
                       Equal equal) {
  for (std::uint32_t& slot : table) slot = kFree;
  const std::uint32_t mask = static_cast<std::uint32_t>(table.size() - 1);
  bool repeats = false;
  for (std::uint32_t w = 0; w < count; ++w) {
    std::uint32_t slot = hash(w) & mask;
    while (table[slot] != kFree && !equal(table[slot], w)) slot = (slot + 1) & mask;
    if (table[slot] == kFree) table[slot] = w;
    first[w] = table[slot];
    repeats = repeats || table[slot] != w;
  }
  return repeats;
}

}  // namespace

bool weld(WorkingMesh& mesh, std::span<std::uint32_t> vertex_of_wedge, std::span<std::uint32_t> table) {
  const Vec3* positions = mesh.positions.data();
  const PackedNormal* normals = mesh.normals.empty() ? nullptr : mesh.normals.data();
  const Rgba8* colours = mesh.colours.empty() ? nullptr : mesh.colours.data();
  const TexCoord* coordinates = mesh.texture_coordinates.empty() ? nullptr : mesh.texture_coordinates.data();
  const std::span<const MaterialGroup> groups = mesh.groups;
  const bool has_attributes =
      normals != nullptr || colours != nullptr || coordinates != nullptr || groups.size() > 1;
  auto position_hash = [=](std::uint32_t w) { return hash_position(positions[w]); };
  auto same_position = [=](std::uint32_t a, std::uint32_t b) { return positions[a] == positions[b]; };

  const std::uint32_t count = mesh.vertex_count;
  if (!find_first_equals(count, table, vertex_of_wedge, position_hash, same_position)) return false;
  if (has_attributes) {
    auto wedge_hash = [=](std::uint32_t w) {
      std::uint32_t hash = hash_position(positions[w]);
      if (groups.size() > 1) hash = mixed(hash, group_of(groups, w));
      if (normals != nullptr) hash = mixed(hash, normals[w].bits);
      if (colours != nullptr) hash = mixed(hash, colours[w].bits);
      if (coordinates != nullptr) hash = mixed(mixed(hash, bits_of(coordinates[w].s)), bits_of(coordinates[w].t));
      return hash;
    };
    auto same_wedge = [=](std::uint32_t a, std::uint32_t b) {
      return positions[a] == positions[b] && (groups.size() < 2 || group_of(groups, a) == group_of(groups, b)) &&
             (normals == nullptr || normals[a] == normals[b]) &&
             (colours == nullptr || colours[a] == colours[b]) &&
             (coordinates == nullptr || coordinates[a] == coordinates[b]);
    };
    find_first_equals(count, table, vertex_of_wedge, wedge_hash, same_wedge);
  }
  for (std::size_t i = 0; i < std::size_t{mesh.face_count} * 3; ++i) mesh.indices[i] = vertex_of_wedge[mesh.indices[i]];
  if (!has_attributes) return false;

  find_first_equals(count, table, vertex_of_wedge, position_hash, same_position);
  for (std::size_t i = 0; i < std::size_t{mesh.face_count} * 3; ++i) {
    // A wedge that differs from its vertex only in attributes; one that repeats another is no longer named.
    if (vertex_of_wedge[mesh.indices[i]] != mesh.indices[i]) return true;
  }
  return false;
}

void find_texture_places(const WorkingMesh& mesh, std::span<std::uint32_t> first, std::span<std::uint32_t> table) {
  const Vec3* positions = mesh.positions.data();
  const TexCoord* coordinates = mesh.texture_coordinates.data();
  const std::span<const MaterialGroup> groups = mesh.groups;
  auto hash = [=](std::uint32_t w) {
    const std::uint32_t of_position = hash_position(positions[w]);
    return mixed(mixed(of_position, bits_of(coordinates[w].s)), bits_of(coordinates[w].t));
  };
  auto same = [=](std::uint32_t a, std::uint32_t b) {
    return positions[a] == positions[b] && coordinates[a] == coordinates[b] &&
           (groups.size() < 2 || group_of(groups, a) == group_of(groups, b));
  };
  find_first_equals(mesh.vertex_count, table, first, hash, same);
}

}  // namespace usuzumi::firmware
