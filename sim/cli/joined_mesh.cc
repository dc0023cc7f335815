#include "sim/cli/joined_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <string>
#include <unordered_map>
#include <utility>

#include "firmware/drawing_data/drawing_data.h"
#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"
#include "sim/pack/load_model.h"
#include "sim/pack/rom_report.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

struct Corner {
  Vec3 position;
  Rgba8 colour;
  TexCoord texture_coordinate;
  float edge_value = 0;
};

/// The faces of one look.
class Bucket {
 public:
  /// `keyed`: what of a corner keeps it apart from others at its place.
  std::uint32_t vertex(Corner c, const JoinOptions& keyed) {
    c.position = {c.position.x + 0.0f, c.position.y + 0.0f, c.position.z + 0.0f};  // -0 becomes 0
    const auto word = [](float f) { return std::bit_cast<std::uint32_t>(f + 0.0f); };
    Key key{word(c.position.x), word(c.position.y), word(c.position.z)};
    if (keyed.colours) key[3] = c.colour.bits;
    if (keyed.textures) key[4] = word(c.texture_coordinate.s), key[5] = word(c.texture_coordinate.t);
    const auto [found, fresh] = numbers_.try_emplace(key, static_cast<std::uint32_t>(corners.size()));
    if (fresh) corners.push_back(c);
    float& value = corners[found->second].edge_value;
    const bool locked = std::min(value, c.edge_value) == firmware::kLockedEdgeValue;
    value = locked ? firmware::kLockedEdgeValue : std::max(value, c.edge_value);
    return found->second;
  }

  void face(const std::array<Corner, 3>& c, const JoinOptions& keyed) {
    if (c[0].position == c[1].position || c[1].position == c[2].position || c[2].position == c[0].position) return;
    for (const Corner& corner : c) indices.push_back(vertex(corner, keyed));
  }

  std::vector<Corner> corners;
  std::vector<std::uint32_t> indices;

 private:
  using Key = std::array<std::uint32_t, 6>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t h = 0;
      for (std::uint32_t x : key) h = (h ^ x) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
      return static_cast<std::size_t>(h);
    }
  };
  std::unordered_map<Key, std::uint32_t, Hash> numbers_;
};

class Joiner {
 public:
  explicit Joiner(const JoinOptions& options) : options_(options) {}

  /// Where the faces of this look go. Without textures all look alike.
  Bucket& bucket(Look look) {
    if (!options_.textures) look = {};
    const auto found = std::find(looks_.begin(), looks_.end(), look);
    const auto at = static_cast<std::size_t>(found - looks_.begin());
    if (found == looks_.end()) {
      looks_.push_back(look);
      buckets_.emplace_back();
    }
    return buckets_[at];
  }
  void face(Bucket& bucket, const std::array<Corner, 3>& corners) { bucket.face(corners, options_); }

  JoinedMesh finish(std::vector<Picture> textures) const {
    JoinedMesh out;
    out.textures = std::move(textures);
    const bool textured =
        std::any_of(looks_.begin(), looks_.end(), [](const Look& look) { return look.texture.has_value(); });
    bool valued = false;
    for (const Bucket& b : buckets_)
      for (const Corner& c : b.corners) valued = valued || c.edge_value != 0;
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(out.positions.size());
      for (const Corner& c : buckets_[i].corners) {
        out.positions.push_back(c.position);
        if (options_.colours) out.colours.push_back(c.colour);
        if (textured) out.texture_coordinates.push_back(c.texture_coordinate);
        if (valued) out.edge_values.push_back(c.edge_value);
      }
      for (std::uint32_t v : buckets_[i].indices) out.indices.push_back(first + v);
      if (!textured || buckets_[i].indices.empty()) continue;
      out.groups.push_back(
          {static_cast<std::uint32_t>(out.indices.size() / 3), static_cast<std::uint32_t>(out.positions.size())});
      out.looks.push_back(looks_[i]);
    }
    return out;
  }

 private:
  JoinOptions options_;
  std::vector<Look> looks_;
  std::vector<Bucket> buckets_;
};

/// Level 0 as a picture: for looking at elsewhere.
Picture picture_of(const firmware::TextureView& texture) {
  Picture out{std::string(texture.name), texture.width, texture.height, {}};
  const std::size_t size = command::bytes_per_texel(texture.format);
  const std::size_t stride = (texture.width * size + 3) / 4 * 4;
  const auto widened = [](std::uint32_t v, std::uint32_t bits) { return v << (8 - bits) | v >> (2 * bits - 8); };
  for (std::uint32_t y = 0; y < texture.height; ++y)
    for (std::uint32_t x = 0; x < texture.width; ++x) {
      std::uint32_t t = 0;
      std::memcpy(&t, texture.texels.data() + y * stride + x * size, size);
      if (size == 2) out.texels.push_back(rgba8(widened(t >> 11, 5), widened(t >> 5 & 63, 6), widened(t & 31, 5)));
      else out.texels.push_back(rgba8(t >> 16 & 255, t >> 8 & 255, t & 255, t >> 24));
    }
  return out;
}

JoinedMesh join_rom(const std::vector<std::byte>& rom, const fs::path& path, const JoinOptions& options) {
  const Progress progress("reading " + path.string());
  const auto data = firmware::DrawingData::open(rom);
  if (!data.ok()) throw Error(ExitCode::kBadInput, unsound_line(rom, path.string(), data.status()));
  Joiner joiner(options);
  data->for_each_mesh([&](const firmware::MeshView& mesh) {
    std::uint32_t f = 0;
    for (std::uint32_t g = 0; g < mesh.group_count(); ++g) {
      const firmware::format::FaceGroup group = mesh.group(g);
      const Rgba8 base{group.base_colour};
      const firmware::MaterialView material = data->material(group.material);
      Look look{std::nullopt, base};
      if (material.texture.present()) look.texture = material.texture.number;
      Bucket& bucket = joiner.bucket(look);
      for (; f < group.face_end; ++f) {
        std::uint32_t v[3];
        mesh.face(f, v);
        std::array<Corner, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
          corners[k] = {mesh.positions[v[k]], mesh.colours.empty() ? base : mesh.colours[v[k]],
                        mesh.texture_coordinates.empty() ? TexCoord{} : mesh.texture_coordinates[v[k]],
                        mesh.edge_values.empty() ? 0.0f : mesh.edge_values[v[k]]};
        joiner.face(bucket, corners);
      }
    }
  });
  std::vector<Picture> textures;
  for (std::uint32_t t = 0; options.textures && t < data->texture_count(); ++t)
    textures.push_back(picture_of(data->texture(t)));
  JoinedMesh joined = joiner.finish(std::move(textures));
  if (const std::size_t solids = data->solids().solids.size(); solids > 0)
    joined.notes.push_back(fmt::format("{}: its {} solids are left out: what they are drawn by is made by the device",
                                       path.string(), solids));
  return joined;
}

JoinedMesh join_model(const Model& model, const JoinOptions& options) {
  const Progress progress("joining the meshes");
  Joiner joiner(options);
  for (const Mesh& mesh : model.meshes) {
    Look look{std::nullopt, mesh.base_colour};
    if (mesh.material) look.texture = model.materials[*mesh.material].texture;
    Bucket& bucket = joiner.bucket(look);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      std::array<Corner, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = mesh.indices[3 * f + k];
        corners[k] = {mesh.positions[i], mesh.colours.empty() ? mesh.base_colour : mesh.colours[i],
                      mesh.texture_coordinates.empty() ? TexCoord{} : mesh.texture_coordinates[i], 0};
      }
      joiner.face(bucket, corners);
    }
  }
  return joiner.finish(options.textures ? model.textures : std::vector<Picture>{});
}

/// A container says so itself, whatever it is called; bare drawing data can only be told by the name.
bool is_rom(const fs::path& path) {
  std::uint32_t magic = 0;
  std::error_code none;
  if (fs::is_regular_file(path, none))
    std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(&magic), sizeof magic);
  const std::string extension = lower_extension(path);
  return magic == firmware::format::kMagic || extension == ".rom" || extension == ".bin";
}

}  // namespace

JoinedMesh load_joined(const fs::path& path, const JoinOptions& options) {
  JoinedMesh joined;
  if (is_rom(path)) {
    joined = join_rom(read_file(path), path, options);
  } else if (is_model_file_name(path)) {
    const Model model = load_model(path);
    joined = join_model(model, options);
    joined.files.assign(model.part_files.begin(), model.part_files.end());
    if (options.textures) joined.notes = model.notes;
  } else {
    throw Error(ExitCode::kBadInput,
                fmt::format("{}: neither a ROM image nor a model; the models read here are {}, bare "
                            "drawing data are called .rom or .bin",
                            path.string(), kModelExtensions));
  }
  joined.files.push_back(path);
  return joined;
}

}  // namespace usuzumi::sim
