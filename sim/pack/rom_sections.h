// The container's sections while they grow.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "firmware/drawing_data/format.h"
#include "sim/pack/model.h"
#include "sim/pack/rom_bytes.h"
#include "sim/pack/rom_writer.h"

namespace usuzumi::sim {

/// mesh-max's records, one of which both formats have for each mesh.
void write_record(Bytes& out, std::uint32_t level, std::span<const Vec3> positions);
std::uint32_t level_of(const Mesh& mesh);

/// Every section's bytes; descriptors, textures and groups hold offsets within their section until placed.
class RomSections {
 public:
  RomSections(const Model& model, const RomOptions& options);

  /// In the order in which they are written, empty ones left out; MSHD is there always, and NAME, so that a nameless
  /// mesh's name still lies somewhere. Each has its offset from the file's start, the first at `begin`.
  struct Placed {
    firmware::format::SectionType type{};
    Bytes bytes;
    std::uint32_t offset = 0;
  };
  /// Spends the sections. `first_section` bytes lie before the first, `table_entry` more for each.
  std::vector<Placed> place(std::uint32_t first_section, std::uint32_t table_entry);

 private:
  void add_mesh(const Mesh& mesh);
  void add_faces(const Mesh& mesh, firmware::format::MeshDescriptor& d);
  void add_vertex_data(const Mesh& mesh, firmware::format::MeshDescriptor& d);
  void add_appearance(const Mesh& mesh, firmware::format::MeshDescriptor& d);
  void add_method(const Mesh& mesh, firmware::format::MeshDescriptor& d);
  void add_layers(const Mesh& mesh, firmware::format::MeshDescriptor& d);
  void add_material(const Material& material);
  void add_solids(const Model& model);
  void add_texture(const Picture& picture, const RomOptions& options);
  Bytes descriptor_bytes() const;
  Bytes texture_bytes(std::uint32_t texels_at, std::uint32_t names_at) const;

  Bytes records_, indices_, normals_, colours_, texture_coordinates_, materials_, texels_, methods_, edge_values_,
      groups_, layers_, solids_, names_, board_;
  std::vector<firmware::format::MeshDescriptor> meshes_;
  std::vector<firmware::format::Texture> textures_;
  std::vector<std::uint32_t> solid_names_;  // where their offsets stand in SOLD
  std::map<std::array<std::uint32_t, 10>, std::uint32_t> settings_;  // words -> where they lie in METH
};

}  // namespace usuzumi::sim
