// What the tests of pack share: a folder that vanishes, small glTF files written word by word, the command run in
// process.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/drawing_data/drawing_data.h"
#include "sim/pack/model.h"

namespace usuzumi::testing {

using nlohmann::json;

/// A folder of its own for each test, removed at the end.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, std::string_view text) const;
  /// Names of all files in it, sorted.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

std::string base64(std::span<const std::byte> bytes);

/// A glTF 2.0 document that grows accessor by accessor; all data in one buffer inside the file.
class GltfBuilder {
 public:
  GltfBuilder();
  json document;  // tests change what they like before text()

  /// Returns the accessor's number. `component` is glTF's number: 5126 float, 5123 unsigned short …
  template <class T>
  int accessor(const std::vector<T>& values, int component, const std::string& type, std::size_t components) {
    return add_accessor(std::as_bytes(std::span(values)), component, type, values.size() / components);
  }
  int positions(const std::vector<float>& xyz) { return accessor(xyz, 5126, "VEC3", 3); }
  int indices(const std::vector<std::uint16_t>& order) { return accessor(order, 5123, "SCALAR", 1); }
  /// Bytes as a buffer view of their own; its number.
  int view(std::span<const std::byte> bytes);
  /// A mesh of one primitive; its number.
  int mesh(const json& primitive, const std::string& name = "");
  /// A node in the scene's root list; its number.
  int node(const json& node);
  std::string text() const;
  /// The same as binary glTF.
  std::string glb() const;

 private:
  int add_accessor(std::span<const std::byte> bytes, int component, const std::string& type, std::size_t count);
  std::vector<std::byte> buffer_;
};

/// One triangle (0 0 0) (1 0 0) (0 1 0), placed by one node named "Plate" as mesh "plate".
GltfBuilder one_triangle();

struct CommandResult {
  int exit_code = 0;
  std::string out, err;
};
/// `usuzumi ARGUMENTS` with the subcommands pack and inspect, in this process.
CommandResult run_usuzumi(const std::vector<std::string>& arguments);

/// A face as its corners' positions, beginning with the least, so that equal faces of equal winding are equal.
using FaceCorners = std::array<std::array<float, 3>, 3>;
FaceCorners face_corners(Vec3 a, Vec3 b, Vec3 c);
std::multiset<FaceCorners> faces_of(const sim::Mesh& mesh);
/// Without faces that repeat a corner.
std::multiset<FaceCorners> faces_of(const firmware::MeshView& mesh);

std::vector<std::byte> bytes_of_file(const std::string& path);

}  // namespace usuzumi::testing
