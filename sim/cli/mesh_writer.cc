#include "sim/cli/mesh_writer.h"

#include <fmt/format.h>

#include <cstring>
#include <iterator>
#include <set>
#include <string>

#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"
#include "sim/image/png.h"

namespace usuzumi::sim {

namespace fs = std::filesystem;

namespace {

template <class T>
void append_raw(std::string& out, const T& value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

/// t as both formats have it: from the image's bottom up.
float upward(float t) { return 1 - t; }

/// "car-2.png" of "out/car.obj" and texture 1.
fs::path texture_file(const fs::path& path, std::uint32_t texture) {
  return path.parent_path() / fmt::format("{}-{}.png", path.stem().string(), texture + 1);
}
fs::path material_file(const fs::path& path) { return fs::path(path).replace_extension(".mtl"); }

/// Numbers of the textures in use, rising.
std::set<std::uint32_t> used_textures(std::span<const Look> looks) {
  std::set<std::uint32_t> used;
  for (const Look& look : looks)
    if (look.texture) used.insert(*look.texture);
  return used;
}

void write_texture(const fs::path& path, const Picture& picture) {
  Image image(picture.width, picture.height);
  for (std::size_t i = 0; i < picture.texels.size(); ++i) {
    const Rgba8 c = picture.texels[i];
    image.xrgb[i] = c.r() << 16 | c.g() << 8 | c.b();
  }
  write_png(path, image);
}

std::string ply_text(const fs::path& path, const MeshToWrite& mesh) {
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  for (std::uint32_t texture : used_textures(mesh.looks))
    out += fmt::format("comment TextureFile {}\n", texture_file(path, texture).filename().string());
  out += fmt::format(
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}{}"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.texture_coordinates.empty() ? "" : "property float s\nproperty float t\n",
      mesh.colours.empty() ? ""
                           : "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n",
      mesh.indices.size() / 3);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    append_raw(out, mesh.positions[v]);
    if (!mesh.texture_coordinates.empty())
      append_raw(out, TexCoord{mesh.texture_coordinates[v].s, upward(mesh.texture_coordinates[v].t)});
    if (!mesh.colours.empty()) append_raw(out, mesh.colours[v].bits);
  }
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    out.push_back(3);
    for (std::size_t k = 0; k < 3; ++k) append_raw(out, mesh.indices[i + k]);
  }
  return out;
}

std::string obj_text(const fs::path& path, const MeshToWrite& mesh) {
  std::string out;
  auto end = std::back_inserter(out);
  if (!mesh.looks.empty()) fmt::format_to(end, "mtllib {}\n", material_file(path).filename().string());
  for (const Vec3& p : mesh.positions) fmt::format_to(end, "v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
  for (const TexCoord& c : mesh.texture_coordinates) fmt::format_to(end, "vt {:.9g} {:.9g}\n", c.s, upward(c.t));
  std::size_t group = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto a = mesh.indices[i] + 1, b = mesh.indices[i + 1] + 1, c = mesh.indices[i + 2] + 1;
    if (mesh.texture_coordinates.empty()) {
      fmt::format_to(end, "f {} {} {}\n", a, b, c);
      continue;
    }
    const bool first = i == 0;
    const std::size_t before = group;
    while (group + 1 < mesh.groups.size() && i / 3 >= mesh.groups[group].face_end) ++group;
    if (first || group != before) fmt::format_to(end, "usemtl look-{}\n", group + 1);
    fmt::format_to(end, "f {0}/{0} {1}/{1} {2}/{2}\n", a, b, c);
  }
  return out;
}

std::string mtl_text(const fs::path& path, std::span<const Look> looks) {
  std::string out;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const Rgba8 c = looks[i].base_colour;
    out += fmt::format("newmtl look-{}\nKd {:.6g} {:.6g} {:.6g}\n", i + 1, c.r() / 255.0, c.g() / 255.0, c.b() / 255.0);
    if (looks[i].texture) out += fmt::format("map_Kd {}\n", texture_file(path, *looks[i].texture).filename().string());
  }
  return out;
}

}  // namespace

std::vector<fs::path> files_beside(const fs::path& path, std::span<const Look> looks) {
  std::vector<fs::path> files;
  for (std::uint32_t texture : used_textures(looks)) files.push_back(texture_file(path, texture));
  if (!looks.empty() && !keeps_colours(path)) files.push_back(material_file(path));
  return files;
}

bool is_mesh_file_name(const std::filesystem::path& path) {
  return keeps_colours(path) || lower_extension(path) == ".obj";
}

bool keeps_colours(const std::filesystem::path& path) { return lower_extension(path) == ".ply"; }

void write_mesh(const std::filesystem::path& path, const MeshToWrite& mesh) {
  if (!is_mesh_file_name(path))
    throw Error(ExitCode::kUsage,
                fmt::format("{}: meshes are written as .ply or .obj; choose one of these extensions", path.string()));
  const Progress progress("writing " + path.string());
  // The mesh last: it names the others.
  for (std::uint32_t texture : used_textures(mesh.looks))
    write_texture(texture_file(path, texture), mesh.textures[texture]);
  if (!mesh.looks.empty() && !keeps_colours(path))
    write_file_atomically(material_file(path), mtl_text(path, mesh.looks));
  write_file_atomically(path, keeps_colours(path) ? ply_text(path, mesh) : obj_text(path, mesh));
}

}  // namespace usuzumi::sim
