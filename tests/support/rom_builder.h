// Builds drawing data for tests word by word, independently of the packer: what the format page says, and nothing else.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "firmware/drawing_data/format.h"
#include "hal/crc32.h"
#include "hal/vec.h"

namespace usuzumi::testing {

/// ROM bytes that begin at a multiple of 4.
class RomImage {
 public:
  void word(std::uint32_t value) { words_.push_back(value); }
  void number(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    word(bits);
  }
  /// ROM made elsewhere, whole words of it.
  static RomImage of(std::span<const std::byte> bytes) {
    RomImage rom;
    rom.words_.resize(bytes.size() / 4);
    std::memcpy(rom.words_.data(), bytes.data(), 4 * rom.words_.size());
    return rom;
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(4 * words_.size()); }
  std::uint32_t& operator[](std::size_t byte_offset) { return words_[byte_offset / 4]; }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(words_)); }
  std::span<std::byte> writable() { return std::as_writable_bytes(std::span(words_)); }

 private:
  std::vector<std::uint32_t> words_;
};

struct TestMesh {
  std::uint32_t level = 1;
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;  // empty: the topology below
  firmware::format::Topology topology = firmware::format::Topology::kStrip;
  std::vector<PackedNormal> normals;
  std::vector<Rgba8> colours;
  Rgba8 base_colour{};
  std::string name;
  firmware::format::QuotaKind quota_kind = firmware::format::QuotaKind::kNone;
  std::uint32_t quota = 0;
  float area_threshold_px = -1;
  std::uint32_t flags = 0;
  std::vector<TexCoord> texture_coordinates;
  std::uint32_t material = firmware::format::kAbsent;
  firmware::format::Method method = firmware::format::Method::kQem;
  std::vector<std::uint32_t> method_settings;  // 10 words, or none
  std::vector<float> edge_values;
  std::vector<std::uint32_t> layers;           // its chain, or none
  std::vector<firmware::format::FaceGroup> groups;  // in place of `material`
};

/// What is drawn with: `material` of a TestMesh is a number in `materials`.
struct TestTexture {
  std::uint32_t format = 3, width = 1, height = 1, level_count = 1;
  std::vector<std::uint32_t> texels;  // words, laid out as the format says
  std::string name;
};
struct TestAppearance {
  std::vector<firmware::format::Material> materials;
  std::vector<TestTexture> textures;
};

inline void append_records(RomImage& rom, const std::vector<TestMesh>& meshes,
                           std::vector<std::uint32_t>* offsets = nullptr) {
  rom.word(static_cast<std::uint32_t>(meshes.size()));
  for (const TestMesh& mesh : meshes) {
    if (offsets != nullptr) offsets->push_back(rom.size());
    rom.word(static_cast<std::uint32_t>(mesh.positions.size()));
    rom.word(mesh.level);
    for (const Vec3& p : mesh.positions) {
      rom.number(p.x);
      rom.number(p.y);
      rom.number(p.z);
    }
  }
}

inline RomImage bare_rom(const std::vector<TestMesh>& meshes) {
  RomImage rom;
  append_records(rom, meshes);
  return rom;
}

/// Puts the header's CRC right after a test has changed a word.
inline void seal(RomImage& rom) { rom[20] = crc32(kCrc32Start, rom.bytes().subspan(24)); }

/// Grows the sections of a container; what no mesh has makes no section, but for those that every container here has.
class ContainerBuilder {
 public:
  explicit ContainerBuilder(std::uint32_t sections) {
    using namespace firmware::format;
    for (std::uint32_t w : {kMagic, kByteOrderMark, 0x00010000u, 0u, 0u, 0u, sections, 0u}) rom.word(w);
    for (std::uint32_t i = 0; i < 4 * sections; ++i) rom.word(0);
  }

  void section(firmware::format::SectionType type, const auto& write) {
    const std::uint32_t begin = rom.size();
    rom[32 + 16 * section_] = static_cast<std::uint32_t>(type);
    rom[36 + 16 * section_] = begin;
    write();
    rom[40 + 16 * section_++] = rom.size() - begin;
  }

  /// One stream per mesh in one section; where each begins.
  std::vector<std::uint32_t> streams(firmware::format::SectionType type, const std::vector<TestMesh>& meshes,
                                     const auto& write) {
    std::vector<std::uint32_t> offsets;
    section(type, [&] {
      for (const TestMesh& mesh : meshes) {
        offsets.push_back(rom.size());
        write(mesh);
      }
    });
    return offsets;
  }

  /// Offset of the text, padded with zeros.
  std::uint32_t text(std::string padded) {
    const std::uint32_t begin = rom.size();
    padded.resize((padded.size() + 3) / 4 * 4);
    for (std::size_t i = 0; i < padded.size(); i += 4) {
      std::uint32_t w;
      std::memcpy(&w, padded.data() + i, 4);
      rom.word(w);
    }
    return begin;
  }

  RomImage rom;

 private:
  std::uint32_t section_ = 0;
};

/// Where the container has each mesh's streams.
struct MeshOffsets {
  std::vector<std::uint32_t> records, indices, normals, colours, names, coordinates, settings, edge_values, groups,
      layers;
};

inline void append_descriptor(RomImage& rom, const TestMesh& mesh, const MeshOffsets& at, std::size_t n) {
  using namespace firmware::format;
  const bool indexed = !mesh.indices.empty();
  rom.word(at.records[n]);
  rom.word(static_cast<std::uint32_t>(indexed ? Topology::kIndexed : mesh.topology));
  rom.word(indexed ? at.indices[n] : kAbsent);
  rom.word(static_cast<std::uint32_t>(mesh.indices.size()));
  rom.word(indexed ? 4 : 0);
  rom.word(mesh.normals.empty() ? kAbsent : at.normals[n]);
  rom.word(mesh.colours.empty() ? kAbsent : at.colours[n]);
  rom.word(mesh.base_colour.bits);
  rom.word(static_cast<std::uint32_t>(mesh.quota_kind));
  rom.word(mesh.quota);
  rom.number(mesh.area_threshold_px);
  rom.word(static_cast<std::uint32_t>(mesh.method));
  rom.word(mesh.flags | (mesh.groups.empty() ? 0 : kFlagGroups));
  rom.word(mesh.name.empty() ? kAbsent : at.names[n]);
  rom.word(static_cast<std::uint32_t>(mesh.name.size()));
  rom.word(mesh.texture_coordinates.empty() ? kAbsent : at.coordinates[n]);
  rom.word(mesh.groups.empty() ? mesh.material : at.groups[n]);
  rom.word(mesh.method_settings.empty() ? 0 : at.settings[n]);
  rom.word(mesh.edge_values.empty() ? 0 : at.edge_values[n]);
  rom.word(mesh.layers.empty() ? 0 : at.layers[n]);
}

inline void append_appearance(ContainerBuilder& out, const TestAppearance& appearance,
                              const std::vector<std::uint32_t>& texture_names) {
  using namespace firmware::format;
  RomImage& rom = out.rom;
  std::vector<std::uint32_t> texels;
  out.section(SectionType::kTexels, [&] {
    for (const TestTexture& texture : appearance.textures) {
      texels.push_back(rom.size());
      for (std::uint32_t w : texture.texels) rom.word(w);
    }
  });
  out.section(SectionType::kTextures, [&] {
    for (std::size_t n = 0; n < appearance.textures.size(); ++n) {
      const TestTexture& t = appearance.textures[n];
      const auto name_bytes = static_cast<std::uint32_t>(t.name.size());
      for (std::uint32_t w : {texels[n], t.format, t.width, t.height, t.level_count}) rom.word(w);
      for (std::uint32_t w : {t.name.empty() ? kAbsent : texture_names[n], name_bytes, 0u}) rom.word(w);
    }
  });
  out.section(SectionType::kMaterials, [&] {
    for (const Material& m : appearance.materials)
      for (std::uint32_t w : {m.texture, m.filter, m.wrap_s, m.wrap_t, static_cast<std::uint32_t>(m.alpha_mode),
                              m.alpha_reference, m.reserved[0], m.reserved[1]})
        rom.word(w);
  });
}

inline RomImage container_rom(const std::vector<TestMesh>& meshes, const TestAppearance& appearance = {}) {
  using namespace firmware::format;
  const auto any = [&](auto member) {
    for (const TestMesh& mesh : meshes)
      if (!(mesh.*member).empty()) return true;
    return false;
  };
  const bool coordinates = any(&TestMesh::texture_coordinates), settings = any(&TestMesh::method_settings),
             edge_values = any(&TestMesh::edge_values), groups = any(&TestMesh::groups),
             layers = any(&TestMesh::layers),
             appearances = !appearance.materials.empty() || !appearance.textures.empty();
  ContainerBuilder out(6u + (coordinates ? 1u : 0u) + (settings ? 1u : 0u) + (edge_values ? 1u : 0u) +
                       (groups ? 1u : 0u) + (layers ? 1u : 0u) + (appearances ? 3u : 0u));
  RomImage& rom = out.rom;
  MeshOffsets at;
  out.section(SectionType::kRecords, [&] { append_records(rom, meshes, &at.records); });
  at.indices = out.streams(SectionType::kIndices, meshes, [&](const TestMesh& mesh) {
    for (std::uint32_t i : mesh.indices) rom.word(i);
  });
  at.normals = out.streams(SectionType::kNormals, meshes, [&](const TestMesh& mesh) {
    for (PackedNormal n : mesh.normals) rom.word(n.bits);
  });
  at.colours = out.streams(SectionType::kColours, meshes, [&](const TestMesh& mesh) {
    for (Rgba8 c : mesh.colours) rom.word(c.bits);
  });
  std::vector<std::uint32_t> texture_names;
  out.section(SectionType::kNames, [&] {
    for (const TestMesh& mesh : meshes) at.names.push_back(out.text(mesh.name));
    for (const TestTexture& texture : appearance.textures) texture_names.push_back(out.text(texture.name));
  });
  if (coordinates)
    at.coordinates = out.streams(SectionType::kTextureCoordinates, meshes, [&](const TestMesh& mesh) {
      for (TexCoord c : mesh.texture_coordinates) {
        rom.number(c.s);
        rom.number(c.t);
      }
    });
  if (settings)
    at.settings = out.streams(SectionType::kMethods, meshes, [&](const TestMesh& mesh) {
      for (std::uint32_t w : mesh.method_settings) rom.word(w);
    });
  if (edge_values)
    at.edge_values = out.streams(SectionType::kEdgeValues, meshes, [&](const TestMesh& mesh) {
      for (float value : mesh.edge_values) rom.number(value);
    });
  if (groups)
    at.groups = out.streams(SectionType::kGroups, meshes, [&](const TestMesh& mesh) {
      rom.word(static_cast<std::uint32_t>(mesh.groups.size()));
      for (const FaceGroup& g : mesh.groups)
        for (std::uint32_t w : {g.face_end, g.vertex_end, g.material, g.base_colour}) rom.word(w);
    });
  if (layers)
    at.layers = out.streams(SectionType::kLayers, meshes, [&](const TestMesh& mesh) {
      for (std::uint32_t w : mesh.layers) rom.word(w);
    });
  if (appearances) append_appearance(out, appearance, texture_names);
  out.section(SectionType::kMeshes, [&] {
    for (std::size_t n = 0; n < meshes.size(); ++n) append_descriptor(rom, meshes[n], at, n);
  });
  rom[16] = rom.size();
  seal(rom);
  return rom;
}

}  // namespace usuzumi::testing
