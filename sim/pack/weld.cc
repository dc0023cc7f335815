#include "sim/pack/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace usuzumi::sim {
namespace {

template <std::size_t N>
struct WordsHash {
  std::size_t operator()(const std::array<std::uint32_t, N>& words) const {
    std::uint64_t h = 0x9E3779B97F4A7C15u;
    for (std::uint32_t w : words) {
      h = (h ^ w) * 0xFF51AFD7ED558CCDu;
      h ^= h >> 32;
    }
    return h;
  }
};
template <std::size_t N>
using WordsMap = std::unordered_map<std::array<std::uint32_t, N>, std::uint32_t, WordsHash<N>>;

/// The bits that stand for a coordinate: adding 0 turns -0 into 0.
std::uint32_t bits(float c) { return std::bit_cast<std::uint32_t>(c + 0.0f); }

}  // namespace

void drop_rounding_noise(Mesh& mesh) {
  float largest = 0;
  for (const Vec3& p : mesh.positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const float noise = largest * 0x1p-30f;
  const auto rid = [noise](float c) { return std::abs(c) <= noise ? 0.0f : c; };
  for (Vec3& p : mesh.positions) p = {rid(p.x), rid(p.y), rid(p.z)};
}

PositionIds number_positions(std::span<const Vec3> positions) {
  PositionIds ids;
  ids.of_vertex.reserve(positions.size());
  WordsMap<3> seen;
  seen.reserve(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const Vec3& p = positions[v];
    const auto [at, fresh] =
        seen.try_emplace({bits(p.x), bits(p.y), bits(p.z)}, static_cast<std::uint32_t>(ids.first_vertex.size()));
    if (fresh) ids.first_vertex.push_back(v);
    ids.of_vertex.push_back(at->second);
  }
  return ids;
}

void weld_vertices(Mesh& mesh) {
  WordsMap<7> seen;
  seen.reserve(mesh.positions.size());
  Mesh welded;
  welded.vertex_groups.resize(mesh.vertex_groups.size());
  for (std::uint32_t& index : mesh.indices) {
    const std::uint32_t v = index;
    const Vec3& p = mesh.positions[v];
    const std::uint32_t normal = mesh.normals.empty() ? 0 : pack_normal(mesh.normals[v]).bits;
    const std::uint32_t colour = mesh.colours.empty() ? 0 : mesh.colours[v].bits;
    const TexCoord t = mesh.texture_coordinates.empty() ? TexCoord{} : mesh.texture_coordinates[v];
    const auto [at, fresh] = seen.try_emplace({bits(p.x), bits(p.y), bits(p.z), normal, colour, bits(t.s), bits(t.t)},
                                              static_cast<std::uint32_t>(welded.positions.size()));
    index = at->second;
    if (fresh) {
      welded.positions.push_back(p);
      if (!mesh.normals.empty()) welded.normals.push_back(mesh.normals[v]);
      if (!mesh.colours.empty()) welded.colours.push_back(mesh.colours[v]);
      if (!mesh.texture_coordinates.empty()) welded.texture_coordinates.push_back(t);
    }
    for (std::size_t g = 0; g < mesh.vertex_groups.size(); ++g) {
      std::vector<std::uint8_t>& members = welded.vertex_groups[g].members;
      if (fresh) members.push_back(0);
      members[index] |= mesh.vertex_groups[g].members[v];
    }
  }
  mesh.positions = std::move(welded.positions);
  mesh.normals = std::move(welded.normals);
  mesh.colours = std::move(welded.colours);
  mesh.texture_coordinates = std::move(welded.texture_coordinates);
  for (std::size_t g = 0; g < mesh.vertex_groups.size(); ++g)
    mesh.vertex_groups[g].members = std::move(welded.vertex_groups[g].members);
}

std::uint32_t remove_faces_without_area(Mesh& mesh) {
  const PositionIds ids = number_positions(mesh.positions);
  std::size_t kept = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t a = ids.of_vertex[mesh.indices[i]], b = ids.of_vertex[mesh.indices[i + 1]],
                        c = ids.of_vertex[mesh.indices[i + 2]];
    if (a == b || b == c || c == a) continue;
    for (std::size_t k = 0; k < 3; ++k) mesh.indices[kept + k] = mesh.indices[i + k];
    kept += 3;
  }
  const auto removed = static_cast<std::uint32_t>((mesh.indices.size() - kept) / 3);
  mesh.indices.resize(kept);
  return removed;
}

}  // namespace usuzumi::sim
