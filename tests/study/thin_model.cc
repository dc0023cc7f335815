#include "tests/study/thin_model.h"

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "hal/arena.h"

namespace usuzumi::study {
namespace {

std::vector<PackedNormal> packed(const std::vector<Vec3>& normals) {
  std::vector<PackedNormal> out;
  for (const Vec3 n : normals) out.push_back(pack_normal(n));
  return out;
}

template <class T>
void shorten(std::vector<T>& stream, std::uint32_t count) {
  if (!stream.empty()) stream.resize(count);
}

// Thins one mesh in place; returns what its vertices were.
std::vector<std::uint32_t> thin(sim::Mesh& mesh, firmware::Method method, std::uint32_t target) {
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<PackedNormal> normals = packed(mesh.normals);
  std::vector<firmware::MaterialGroup> groups;
  for (const sim::MeshPart& part : mesh.parts) groups.push_back({part.face_end, part.vertex_end});
  std::vector<std::uint32_t> sources(vertices);
  firmware::WorkingMesh working{.positions = mesh.positions,
                                .normals = normals,
                                .colours = mesh.colours,
                                .texture_coordinates = mesh.texture_coordinates,
                                .edge_values = mesh.edge_values,
                                .groups = groups,
                                .indices = mesh.indices,
                                .vertex_count = vertices,
                                .face_count = mesh.face_count(),
                                .source_vertices = sources};
  std::vector<std::byte> memory(firmware::simplify_scratch_bytes(method, vertices, mesh.face_count(),
                                                                 !mesh.texture_coordinates.empty()));
  Arena scratch(memory);
  const auto outcome = firmware::simplify(working, {.target_faces = target, .method = method}, scratch);
  if (!outcome.ok()) throw std::runtime_error(outcome.status().message);
  for (std::size_t v = 0; v < mesh.normals.size() && v < working.vertex_count; ++v)
    mesh.normals[v] = normalized(unpack(normals[v]));
  shorten(mesh.positions, working.vertex_count);
  shorten(mesh.normals, working.vertex_count);
  shorten(mesh.colours, working.vertex_count);
  shorten(mesh.texture_coordinates, working.vertex_count);
  shorten(mesh.edge_values, working.vertex_count);
  mesh.indices.resize(std::size_t{working.face_count} * 3);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    mesh.parts[g].face_end = groups[g].face_end;
    mesh.parts[g].vertex_end = groups[g].vertex_end;
  }
  mesh.vertex_groups.clear();
  sources.resize(working.vertex_count);
  return sources;
}

using Paints = std::vector<std::vector<std::uint32_t>>;  // by mesh and vertex of the model as given

Paints images_of(const sim::Model& model) {
  Paints paints;
  std::uint32_t image = 0;
  for (const sim::Mesh& mesh : model.meshes) {
    std::vector<std::uint32_t> paint(mesh.positions.size(), ++image);
    std::size_t v = 0;
    for (const sim::MeshPart& part : mesh.parts) {
      for (; v < part.vertex_end; ++v) paint[v] = image;
      ++image;
    }
    paints.push_back(std::move(paint));
  }
  return paints;
}

Paints parts_of(const sim::Model& model) {
  Paints paints;
  std::uint32_t part = 0;
  for (const sim::Mesh& mesh : model.meshes) {
    std::map<std::array<float, 3>, std::uint32_t> at_place;
    std::vector<std::uint32_t> parent(mesh.positions.size());
    for (std::uint32_t v = 0; v < parent.size(); ++v) {
      const Vec3 p = mesh.positions[v];
      parent[v] = at_place.try_emplace({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}, v).first->second;  // -0 becomes 0
    }
    const auto root = [&](std::uint32_t v) {
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
      parent[root(mesh.indices[i])] = root(mesh.indices[i / 3 * 3]);
    std::vector<std::uint32_t> paint;
    for (std::uint32_t v = 0; v < parent.size(); ++v) paint.push_back(part + root(v));
    part += static_cast<std::uint32_t>(parent.size());
    paints.push_back(std::move(paint));
  }
  return paints;
}

}  // namespace

ThinnedModel thin_model(const sim::Model& model, firmware::Method method, double share) {
  ThinnedModel thinned{.model = model, .sources = {}};
  for (sim::Mesh& mesh : thinned.model.meshes) {
    const auto target = static_cast<std::uint32_t>(std::lround(mesh.face_count() * share));
    thinned.sources.push_back(thin(mesh, method, target));
    thinned.target_faces += target;
    thinned.faces += mesh.face_count();
  }
  return thinned;
}

ThinnedModel unthinned(const sim::Model& model) {
  ThinnedModel same{.model = model, .sources = {}};
  for (const sim::Mesh& mesh : model.meshes) {
    same.sources.emplace_back(mesh.positions.size());
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) same.sources.back()[v] = v;
    same.faces += mesh.face_count();
  }
  same.target_faces = same.faces;
  return same;
}

testing::Mesh surface_of(const sim::Model& original, const ThinnedModel& thinned, Paint paint) {
  const Paints paints = paint == Paint::kImages ? images_of(original) : parts_of(original);
  testing::Mesh surface;
  for (std::size_t m = 0; m < thinned.model.meshes.size(); ++m) {
    const sim::Mesh& mesh = thinned.model.meshes[m];
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    surface.positions.insert(surface.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      surface.texture_coordinates.push_back(mesh.texture_coordinates.empty() ? TexCoord{}
                                                                             : mesh.texture_coordinates[v]);
      surface.colours.push_back({paints[m][thinned.sources[m][v]]});
    }
    for (const std::uint32_t v : mesh.indices) surface.indices.push_back(first + v);
  }
  return surface;
}

}  // namespace usuzumi::study
