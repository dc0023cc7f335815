#include "firmware/thinning/layered_mesh.h"

#include "firmware/drawing_data/mesh_layers.h"
#include "firmware/layers/middle_layer.h"
#include "firmware/thinning/block_writer.h"
#include "firmware/thinning/whole_mesh.h"

namespace usuzumi::firmware {
namespace {

/// Whether the engine reads the vertices in ROM: all of the store are there, and none moves.
bool vertices_stay_in_rom(const LayerChainView& chain, bool vertices_move, bool rom_on_bus) {
  return rom_on_bus && !vertices_move && chain.store_count() == chain.vertex_count();
}

VertexStreams given_streams(const MeshView& mesh) {
  return {mesh.positions, mesh.normals, mesh.colours,
          mesh.textured ? mesh.texture_coordinates : std::span<const TexCoord>{}};
}

/// The streams of the block as they stand now: blocks move when others are dropped.
StoreTarget store_of(const RamCopy& copy, std::span<std::byte> block, std::uint32_t n) {
  const CopyMesh& m = copy.mesh(n);
  const auto at = [&]<class T>(std::uint32_t offset, std::span<T>& stream) {
    if (offset != kNoStream) stream = {reinterpret_cast<T*>(block.data() + offset), m.vertex_count};
  };
  StoreTarget target;
  at(0, target.positions);
  at(m.normal_offset, target.normals);
  at(m.colour_offset, target.colours);
  at(m.texture_coordinate_offset, target.texture_coordinates);
  return target;
}

LayerReplay replay_of(const LayerChainView& chain, RamCopy& copy, std::uint32_t n, std::uint32_t step) {
  return {chain, copy.block_memory(n).subspan(copy.mesh(n).index_offset), index_bytes(chain.store_count()),
          copy.live_faces(n), step};
}

/// Vertices that stand between two layers go back to where the first has them, so that others may move.
std::uint32_t put_back(const MeshView& mesh, const LayerChainView& chain, const ChainPlace& place, RamCopy& copy) {
  if (place.weight <= 0) return 0;
  return write_middle_layer(chain, given_streams(mesh), place.layer, 0,
                            store_of(copy, copy.block_memory(mesh.number), mesh.number));
}

}  // namespace

ChainPlace place_of_faces(const LayerChainView& chain, std::uint32_t faces) {
  // Faces fall with the steps.
  std::uint32_t low = 0, high = chain.step_count();
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (chain.faces_at(middle) <= faces) high = middle; else low = middle + 1;
  }
  std::uint32_t layer = 0;
  while (layer + 1 < chain.layer_count() && chain.layer(layer + 1).step <= low) ++layer;
  return {low, layer, 0};
}

ChainPlace place_of_layer(const LayerChainView& chain, float layer) {
  const std::uint32_t last = chain.layer_count() - 1;
  if (!(layer > 0)) return {};
  if (layer >= static_cast<float>(last)) return {chain.layer(last).step, last, 0};
  const auto n = static_cast<std::uint32_t>(layer);
  return {chain.layer(n).step, n, layer - static_cast<float>(n)};
}

float layer_of_place(const LayerChainView& chain, const ChainPlace& place) {
  if (place.weight > 0) return static_cast<float>(place.layer) + place.weight;
  return layer_of_faces(chain, static_cast<float>(chain.faces_at(place.step)));
}

std::uint64_t layered_bytes(const MeshView& mesh, const LayerChainView& chain, bool vertices_move, bool rom_on_bus) {
  const std::uint64_t vertices = vertices_stay_in_rom(chain, vertices_move, rom_on_bus) ? 0 : chain.store_count();
  const std::uint64_t indices = std::uint64_t{3} * chain.face_count() * index_bytes(chain.store_count());
  return vertices * vertex_bytes(mesh, !mesh.normals.empty()) + (indices + 3) / 4 * 4 +
         std::uint64_t{4} * chain.group_count();
}

bool copy_layered(const MeshView& mesh, LayeredMesh& layered, bool vertices_move, RamCopy& copy, Clock& clock,
                  BuildReport& report) {
  const LayerChainView chain = layered.view();
  BlockWriter block(copy.free_memory());
  CopyMesh out = described(mesh);
  out.layered = true;
  out.vertices_in_rom = vertices_stay_in_rom(chain, vertices_move, copy.rom_on_bus());
  out.vertex_count = chain.store_count();
  const auto append_store = [&](auto given, auto added) -> std::uint32_t {
    if (given.empty()) return kNoStream;
    const std::uint32_t offset = block.append(given);
    block.append(added);
    return offset;
  };
  if (!out.vertices_in_rom) {
    append_store(mesh.positions, chain.added().positions);
    out.normal_offset = append_store(mesh.normals, chain.added().normals);
    out.colour_offset = append_store(mesh.colours, chain.added().colours);
    if (mesh.textured)
      out.texture_coordinate_offset = append_store(mesh.texture_coordinates, chain.added().texture_coordinates);
  }
  out.topology = command::Topology::kTriangles;
  const std::uint32_t index_size = index_bytes(out.vertex_count);
  out.index_format = index_size == 2 ? command::IndexFormat::kU16 : command::IndexFormat::kU32;
  out.index_count = 3 * chain.face_count();
  out.faces = chain.face_count();
  out.has_group_words = true;
  out.index_offset = block.bytes();
  block.extend(std::size_t{out.index_count} * index_size);
  block.extend(std::size_t{4} * chain.group_count());
  if (block.full()) return false;
  copy.add(mesh.number, out, block.bytes());

  LayerReplay replay = replay_of(chain, copy, mesh.number, 0);
  begin_replay(mesh, replay);
  if (!layered.tried) {
    layered.sound = replay.check().ok();
    layered.tried = true;
    clock.charge(CpuWork::kCornerReplayed, std::uint64_t{2} * chain.header().change_count);
  }
  layered.place = {};
  if (!layered.sound) {
    copy.drop(mesh.number);
    copy.compact();
    return false;
  }
  if (out.vertices_in_rom)
    report.bytes_left_in_rom = out.vertex_count * vertex_bytes(mesh, !mesh.normals.empty());
  clock.charge(CpuWork::kVertexCopied, out.vertices_in_rom ? 0 : out.vertex_count);
  clock.charge(CpuWork::kIndexCopied, out.index_count);
  return true;
}

bool move_layered(const MeshView& mesh, LayeredMesh& layered, const ChainPlace& place, RamCopy& copy, Clock& clock) {
  const ChainPlace from = layered.place;
  if (place == from) return false;
  const LayerChainView chain = layered.view();
  std::uint64_t moved = 0;
  if (place.layer != from.layer) moved += put_back(mesh, chain, from, copy);
  LayerReplay replay = replay_of(chain, copy, mesh.number, from.step);
  clock.charge(CpuWork::kCornerReplayed, replay.go_to(place.step));
  copy.set_faces(mesh.number, replay.faces());
  const bool standing = place.layer == from.layer ? place.weight == from.weight : place.weight <= 0;
  if (!standing)
    moved += write_middle_layer(chain, given_streams(mesh), place.layer, place.weight,
                                store_of(copy, copy.block_memory(mesh.number), mesh.number));
  clock.charge(CpuWork::kVertexMoved, moved);
  layered.place = place;
  return true;
}

}  // namespace usuzumi::firmware
