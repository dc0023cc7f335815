// A 3D model in the host's memory, whatever file it came from: what pack writes into ROM and what thin works on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "firmware/drawing_data/format.h"
#include "firmware/simplify/simplify.h"
#include "firmware/solids/solid_format.h"
#include "hal/command_list.h"
#include "hal/vec.h"

namespace usuzumi::sim {

struct FaceQuota {
  firmware::format::QuotaKind kind = firmware::format::QuotaKind::kNone;
  std::uint32_t value = 0;  // faces, or millionths of the mesh's own faces
  friend bool operator==(const FaceQuota&, const FaceQuota&) = default;
};

/// The settings of a thinning method that an author gives; the others are the firmware's defaults. Names and bounds
/// have been checked (method_settings.h), whether they belong to the mesh's method has not.
struct MethodSettings {
  std::string preset;                    // of vertex deletion; "" without
  std::map<std::string, double> values;  // by name; choices (placement, boundary_answer) by number
  friend bool operator==(const MethodSettings&, const MethodSettings&) = default;
};

/// A value for the edges at some of a mesh's vertices, or a lock on them.
struct EdgeRegion {
  std::string group, material;  // one of them: the vertices of a group, or of a material's faces
  float value = 0;              // >= 0, or firmware::kLockedEdgeValue
  friend bool operator==(const EdgeRegion&, const EdgeRegion&) = default;
};

/// What an author may say about a mesh; each is absent unless somebody said it.
struct Tags {
  std::optional<std::uint32_t> level;  // 0..5, 0 = unset in so many words
  std::optional<FaceQuota> quota;
  std::optional<float> area_threshold_px;  // >= 0
  std::optional<bool> telltale;
  std::optional<firmware::Method> method{};
  std::optional<MethodSettings> settings{};
  std::optional<std::vector<EdgeRegion>> regions{};  // where two touch a vertex the later counts
  std::optional<std::vector<std::uint32_t>> layers{};  // millionths of the faces, falling from 1,000,000; 2 to 16

  bool any() const {
    return level || quota || area_threshold_px || telltale || method || settings || regions || layers;
  }
  friend bool operator==(const Tags&, const Tags&) = default;
};

/// Each of `over`'s tags, and those of `under` where `over` says nothing.
Tags merge_tags(const Tags& over, const Tags& under);

/// An image, display-referred (sRGB) as files hold it; alpha is not multiplied into the colours.
struct Picture {
  std::string name;  // of the file, or of the image inside the model file
  std::uint32_t width = 0, height = 0;
  std::vector<Rgba8> texels;  // width * height, top row first

  friend bool operator==(const Picture&, const Picture&) = default;
};

/// How the faces of a mesh look, but for the base colour. Only what drawing data need: an untextured opaque mesh has
/// none.
struct Material {
  std::optional<std::uint32_t> texture;  // number in Model::textures
  command::TextureFilter filter = command::TextureFilter::kBilinear;
  command::TextureWrap wrap_s = command::TextureWrap::kRepeat, wrap_t = command::TextureWrap::kRepeat;
  firmware::format::AlphaMode alpha_mode = firmware::format::AlphaMode::kOpaque;
  std::uint32_t alpha_reference = 128;  // 0..255, of AlphaMode::kMask

  friend bool operator==(const Material&, const Material&) = default;
};

/// Vertices that the file puts together under a name (glTF: a scalar attribute _NAME above 0.5).
struct VertexGroup {
  std::string name;
  std::vector<std::uint8_t> members;  // as many as positions; 1: in the group
};

/// One of several materials on a mesh whose primitives were joined: faces and vertices from the ends of the part before
/// to these. Parts share no vertex.
struct MeshPart {
  std::uint32_t face_end = 0, vertex_end = 0;
  std::optional<std::uint32_t> material;  // number in Model::materials
  Rgba8 base_colour{};
  std::string material_name;
};

/// One primitive of the source file, in world coordinates: a mesh of the device.
struct Mesh {
  std::string name;       // unique in the model: mesh_name, with #2, #3 … from the second of that name on
  std::string mesh_name;  // as in the file: the mesh's name, else the node's, else the file's stem
  std::string node_name;  // of the node that places it; may be empty
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;                    // as many as positions, or empty
  std::vector<Rgba8> colours;                   // as many as positions, or empty; display-referred (sRGB)
  std::vector<TexCoord> texture_coordinates{};  // as many as positions, or empty
  std::vector<std::uint32_t> indices;           // three per face, counter-clockwise as seen from outside
  Rgba8 base_colour{};                          // where there are no vertex colours; display-referred (sRGB)
  bool two_sided = false;
  std::optional<std::uint32_t> material{};  // number in Model::materials
  std::string material_name{};              // as in the file; may be empty
  std::vector<VertexGroup> vertex_groups{};
  std::vector<float> edge_values{};  // as many as positions, or empty; set from Tags::regions
  std::vector<MeshPart> parts{};     // empty: `material` and `base_colour` are the whole mesh's
  std::vector<std::byte> layer_chain{};  // of this order of vertices and faces (layer_chains.h), or empty
  std::uint32_t placement = 0;       // the same for the primitives that one node places as one mesh of the file
  Tags tags;                         // from the file itself, node over mesh

  std::uint32_t face_count() const { return static_cast<std::uint32_t>(indices.size() / 3); }
};

/// A basic solid (firmware/solids/solid_format.h).
struct Solid {
  std::string name;
  firmware::format::SolidKind kind{};
  std::array<float, firmware::format::kMaxSolidSizes> size{};
  std::array<float, 12> to_model{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // row-major 3 x 4
  Rgba8 colour{};
};

struct Model {
  std::vector<Mesh> meshes;
  std::vector<std::string> notes;         // what the user should know, a line each: what was left out, what was made up
  std::vector<std::string> part_files{};  // beside the model file, read as parts of it: buffers and images
  std::vector<Picture> textures{};
  std::vector<Material> materials{};
  std::vector<Solid> solids{};
  std::vector<Vec3> view_candidates{};  // of solids, unit length; none: the default ones
  firmware::format::SolidDetail solid_detail{};
};

}  // namespace usuzumi::sim
