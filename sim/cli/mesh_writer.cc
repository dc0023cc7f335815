#include "sim/cli/mesh_writer.h"

#include <fmt/format.h>

#include <cstring>
#include <string>

#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"

namespace usuzumi::sim {
namespace {

template <class T>
void append_raw(std::string& out, const T& value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

std::string ply_text(const MeshToWrite& mesh) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
      "z\n{}"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(),
      mesh.colours.empty() ? ""
                           : "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n",
      mesh.indices.size() / 3);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    append_raw(out, mesh.positions[v]);
    if (!mesh.colours.empty()) append_raw(out, mesh.colours[v].bits);
  }
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    out.push_back(3);
    for (std::size_t k = 0; k < 3; ++k) append_raw(out, mesh.indices[i + k]);
  }
  return out;
}

std::string obj_text(const MeshToWrite& mesh) {
  std::string out;
  auto end = std::back_inserter(out);
  for (const Vec3& p : mesh.positions) fmt::format_to(end, "v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    fmt::format_to(end, "f {} {} {}\n", mesh.indices[i] + 1, mesh.indices[i + 1] + 1, mesh.indices[i + 2] + 1);
  return out;
}

}  // namespace

bool is_mesh_file_name(const std::filesystem::path& path) {
  return keeps_colours(path) || lower_extension(path) == ".obj";
}

bool keeps_colours(const std::filesystem::path& path) { return lower_extension(path) == ".ply"; }

void write_mesh(const std::filesystem::path& path, const MeshToWrite& mesh) {
  if (!is_mesh_file_name(path))
    throw Error(ExitCode::kUsage,
                fmt::format("{}: meshes are written as .ply or .obj; choose one of these extensions", path.string()));
  const Progress progress("writing " + path.string());
  write_file_atomically(path, keeps_colours(path) ? ply_text(mesh) : obj_text(mesh));
}

}  // namespace usuzumi::sim
