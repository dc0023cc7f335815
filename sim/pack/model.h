// A 3D model in the host's memory, whatever file it came from: what pack writes into ROM and what thin works on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/drawing_data/format.h"
#include "hal/vec.h"

namespace usuzumi::sim {

struct FaceQuota {
  firmware::format::QuotaKind kind = firmware::format::QuotaKind::kNone;
  std::uint32_t value = 0;  // faces, or millionths of the mesh's own faces
  friend bool operator==(const FaceQuota&, const FaceQuota&) = default;
};

/// What an author may say about a mesh; each is absent unless somebody said it.
struct Tags {
  std::optional<std::uint32_t> level;  // 0..5, 0 = unset in so many words
  std::optional<FaceQuota> quota;
  std::optional<float> area_threshold_px;  // >= 0
  std::optional<bool> telltale;

  bool any() const { return level || quota || area_threshold_px || telltale; }
  friend bool operator==(const Tags&, const Tags&) = default;
};

/// Each of `over`'s tags, and those of `under` where `over` says nothing.
Tags merge_tags(const Tags& over, const Tags& under);

/// One primitive of the source file, in world coordinates: a mesh of the device.
struct Mesh {
  std::string name;       // unique in the model: mesh_name, with #2, #3 … from the second of that name on
  std::string mesh_name;  // as in the file: the mesh's name, else the node's, else the file's stem
  std::string node_name;  // of the node that places it; may be empty
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;           // as many as positions, or empty
  std::vector<Rgba8> colours;          // as many as positions, or empty; display-referred (sRGB)
  std::vector<std::uint32_t> indices;  // three per face, counter-clockwise as seen from outside
  Rgba8 base_colour{};                 // where there are no vertex colours; display-referred (sRGB)
  bool two_sided = false;
  Tags tags;  // from the file itself, node over mesh

  std::uint32_t face_count() const { return static_cast<std::uint32_t>(indices.size() / 3); }
};

struct Model {
  std::vector<Mesh> meshes;
  std::vector<std::string> notes;  // what the user should know, a line each: what was left out, what was made up
  std::vector<std::string> buffer_files{};  // beside the model file, read as parts of it
};

}  // namespace usuzumi::sim
