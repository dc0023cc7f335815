#include "tests/sim/pack/support.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iterator>

#include "sim/cli/inspect_command.h"
#include "sim/cli/pack_command.h"

namespace usuzumi::testing {

namespace fs = std::filesystem;

TempFolder::TempFolder() {
  std::string name = (fs::temp_directory_path() / "usuzumi-pack-XXXXXX").string();
  path_ = ::mkdtemp(name.data());
}

TempFolder::~TempFolder() {
  std::error_code none;
  fs::remove_all(path_, none);
}

std::string TempFolder::write(const std::string& name, std::string_view text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return (path_ / name).string();
}

std::vector<std::string> TempFolder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= bytes.size() - i ? kLetters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

GltfBuilder::GltfBuilder() {
  document =
      json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                             "accessors": [], "bufferViews": []})");
}

int GltfBuilder::view(std::span<const std::byte> bytes) {
  while (buffer_.size() % 4 != 0) buffer_.push_back(std::byte{0});
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}});
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  return static_cast<int>(document["bufferViews"].size()) - 1;
}

int GltfBuilder::add_accessor(std::span<const std::byte> bytes, int component, const std::string& type,
                              std::size_t count) {
  const int v = view(bytes);
  document["accessors"].push_back({{"bufferView", v}, {"componentType", component}, {"type", type}, {"count", count}});
  return static_cast<int>(document["accessors"].size()) - 1;
}

int GltfBuilder::mesh(const json& primitive, const std::string& name) {
  json mesh = {{"primitives", json::array({primitive})}};
  if (!name.empty()) mesh["name"] = name;
  document["meshes"].push_back(mesh);
  return static_cast<int>(document["meshes"].size()) - 1;
}

int GltfBuilder::node(const json& node) {
  document["nodes"].push_back(node);
  const int number = static_cast<int>(document["nodes"].size()) - 1;
  document["scenes"][0]["nodes"].push_back(number);
  return number;
}

std::string GltfBuilder::text() const {
  json complete = document;
  if (!complete.contains("buffers"))
    complete["buffers"] = json::array(
        {{{"byteLength", buffer_.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer_)}}});
  return complete.dump();
}

std::string GltfBuilder::glb() const {
  json complete = document;
  complete["buffers"] = json::array({{{"byteLength", buffer_.size()}}});
  std::string text = complete.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string binary(reinterpret_cast<const char*>(buffer_.data()), buffer_.size());
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string out;
  auto word = [&](std::size_t v) {
    for (unsigned i = 0; i < 4; ++i) out += static_cast<char>(v >> (8 * i) & 0xFF);
  };
  word(0x46546C67);
  word(2);
  word(12 + 8 + text.size() + 8 + binary.size());
  word(text.size());
  word(0x4E4F534A);
  out += text;
  word(binary.size());
  word(0x004E4942);
  out += binary;
  return out;
}

GltfBuilder one_triangle() {
  GltfBuilder b;
  const int p = b.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  b.node({{"name", "Plate"}, {"mesh", b.mesh({{"attributes", {{"POSITION", p}}}}, "plate")}});
  return b;
}

CommandResult run_usuzumi(const std::vector<std::string>& arguments) {
  CLI::App app;
  CommandResult result;
  app.require_subcommand(1);
  sim::add_pack_command(app, result.exit_code);
  sim::add_inspect_command(app, result.exit_code);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& e) {
    result.exit_code = app.exit(e) == 0 ? 0 : 2;
  }
  result.out = ::testing::internal::GetCapturedStdout();
  result.err = ::testing::internal::GetCapturedStderr();
  return result;
}

FaceCorners face_corners(Vec3 a, Vec3 b, Vec3 c) {
  FaceCorners corners{{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::multiset<FaceCorners> faces_of(const sim::Mesh& mesh) {
  std::multiset<FaceCorners> faces;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    faces.insert(face_corners(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                              mesh.positions[mesh.indices[i + 2]]));
  return faces;
}

std::multiset<FaceCorners> faces_of(const firmware::MeshView& mesh) {
  std::multiset<FaceCorners> faces;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::uint32_t v[3];
    mesh.face(f, v);
    const Vec3 a = mesh.positions[v[0]], b = mesh.positions[v[1]], c = mesh.positions[v[2]];
    if (!(a == b) && !(b == c) && !(c == a)) faces.insert(face_corners(a, b, c));
  }
  return faces;
}

std::vector<std::byte> bytes_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

}  // namespace usuzumi::testing
