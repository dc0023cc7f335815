// A chain of layers, read in place, and the replay that brings an index buffer to any state on it.
//
// A chain remembers every step of one thinning (US 6,396,952, p. 31-35, keeps layers and the correspondence between
// them; the steps between are ours). Faces are renumbered into slots, those removed last first, so that the live faces
// of every state are a prefix of their group's slots: to draw a state is to draw that many faces, and to reach it from
// another is to replay the changes between the two, forward or backward, on one index buffer. All states share one
// store of vertices: those of the mesh as given, then those that the method added.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/layers/layer_format.h"
#include "hal/status.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// What a chain must agree with.
struct LayerChainMesh {
  std::uint32_t vertex_count = 0;
  std::uint32_t face_count = 0;   // proper faces
  std::uint32_t group_count = 1;
  std::uint32_t attributes = 0;   // format::kLayerNormals and so on
};

/// Vertex streams; absent ones are empty.
struct VertexStreams {
  std::span<const Vec3> positions;
  std::span<const PackedNormal> normals;
  std::span<const Rgba8> colours;
  std::span<const TexCoord> texture_coordinates;
};

class LayerChainView {
 public:
  LayerChainView() = default;
  /// Checks all of the chain at the front of `bytes` (4-byte aligned; what lies behind it is not looked at): after this
  /// no replay reads or writes outside its buffers. Whether each change begins where the one before it ended is not
  /// known until LayerReplay::check(). kDataLoss, `where` is the byte offset in the chain.
  static Result<LayerChainView> open(std::span<const std::byte> bytes, const LayerChainMesh& mesh);
  /// Of bytes that open() has accepted: nothing is checked again.
  static LayerChainView of_checked(std::span<const std::byte> bytes);

  const format::LayerChainHeader& header() const { return header_; }
  std::uint32_t vertex_count() const { return header_.vertex_count; }
  std::uint32_t store_count() const { return header_.vertex_count + header_.added_count; }
  std::uint32_t face_count() const { return header_.face_count; }
  std::uint32_t step_count() const { return header_.step_count; }
  std::uint32_t layer_count() const { return header_.layer_count; }
  std::uint32_t group_count() const { return header_.group_count; }

  const format::Layer& layer(std::uint32_t n) const { return layers_[n]; }
  std::span<const format::Layer> layers() const { return layers_; }
  std::uint32_t group_begin(std::uint32_t g) const { return g == 0 ? 0 : groups_[g - 1].face_end; }
  std::uint32_t group_end(std::uint32_t g) const { return groups_[g].face_end; }
  /// Group of slot < face_count().
  std::uint32_t group_of(std::uint32_t slot) const;
  /// Faces after `step` steps, 0 <= step <= step_count().
  std::uint32_t faces_at(std::uint32_t step) const {
    return step == 0 ? header_.face_count : steps_[step - 1].faces_after;
  }
  /// Of the last layer.
  std::uint32_t last_faces() const { return faces_at(header_.step_count); }
  /// Of step s < step_count(), which leads from state s to state s + 1.
  std::span<const format::LayerChange> changes(std::uint32_t s) const {
    const std::uint32_t begin = s == 0 ? 0 : steps_[s - 1].change_end;
    return changes_.subspan(begin, steps_[s].change_end - begin);
  }
  /// Slot of proper face f of the mesh as given.
  std::uint32_t slot(std::uint32_t f) const { return slots_[f]; }
  /// Group of the i-th face that is removed.
  std::uint32_t removed_group(std::uint32_t i) const { return removed_groups_.empty() ? 0 : removed_groups_[i]; }
  /// Correspondents of layer n's vertices in layer n + 1, where they are not the same.
  std::span<const format::LayerPair> pairs(std::uint32_t n) const {
    const std::uint32_t begin = n == 0 ? 0 : layers_[n - 1].pair_end;
    return pairs_.subspan(begin, layers_[n].pair_end - begin);
  }
  const VertexStreams& added() const { return added_; }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  friend class LayerChainChecker;

  format::LayerChainHeader header_;
  std::span<const std::byte> bytes_;
  std::span<const format::Layer> layers_;
  std::span<const format::LayerGroup> groups_;
  std::span<const format::LayerStep> steps_;
  std::span<const std::uint32_t> slots_;
  std::span<const std::uint32_t> removed_groups_;
  std::span<const format::LayerChange> changes_;
  std::span<const format::LayerPair> pairs_;
  VertexStreams added_;
};

/// The index buffer of one mesh at some state of its chain. Holds no memory of its own; made anew from (buffer, step)
/// whenever it is needed, as the buffer may have moved.
class LayerReplay {
 public:
  /// `indices`: 3 * face_count() numbers of 4 bytes, or of 2 where store_count() <= 65536; 4-byte aligned. `live`:
  /// group_count() counts of live faces. Both hold the state after `step` steps, or nothing yet: see begin().
  LayerReplay(const LayerChainView& chain, std::span<std::byte> indices, std::uint32_t index_bytes,
              std::span<std::uint32_t> live, std::uint32_t step = 0)
      : chain_(chain), indices_(indices.data()), index_bytes_(index_bytes), live_(live), step_(step) {}

  /// State 0, but for its faces: each of them is then to be set_face(), in any order.
  void begin();
  /// Proper face f < face_count() of the mesh as given, with vertices below vertex_count().
  void set_face(std::uint32_t f, const std::uint32_t vertices[3]);
  /// From state 0 to the end and back: whether every slot has a face, every change finds what it replaces, and every
  /// group has the faces that are removed from it. kDataLoss with the number of the step. Linear in the chain.
  Status check();

  /// Goes to the state after `step` <= step_count() steps. Returns the corners written: the changes between.
  std::uint64_t go_to(std::uint32_t step);
  /// Goes to the first state with at most `faces` faces, or to the last.
  std::uint64_t go_to_faces(std::uint32_t faces);

  std::uint32_t step() const { return step_; }
  std::uint32_t faces() const { return chain_.faces_at(step_); }
  /// Store vertex of corner 3 * slot + k.
  std::uint32_t corner(std::uint32_t c) const;

 private:
  template <class Index>
  Index* indices() const { return reinterpret_cast<Index*>(indices_); }
  void write(std::uint32_t corner, std::uint32_t vertex);
  std::uint64_t forward();
  std::uint64_t backward();

  const LayerChainView& chain_;
  std::byte* indices_;
  std::uint32_t index_bytes_;
  std::span<std::uint32_t> live_;
  std::uint32_t step_;
};

}  // namespace usuzumi::firmware
