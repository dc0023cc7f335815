#include "firmware/layers/layer_chain.h"

#include <cstring>

#include "firmware/simplify/bounds.h"
#include "firmware/simplify/simplify.h"

namespace usuzumi::firmware {

using format::LayerChainHeader;

/// The checks of open(), pass by pass.
class LayerChainChecker {
 public:
  LayerChainChecker(std::span<const std::byte> bytes, LayerChainView& out) : bytes_(bytes), view_(out) {}

  Status check(const LayerChainMesh& mesh) {
    Status status = check_header(mesh);
    if (status.ok()) status = lay_out();
    if (status.ok()) status = check_groups();
    if (status.ok()) status = check_steps();
    if (status.ok()) status = check_layers();
    if (status.ok()) status = check_faces();
    if (status.ok()) status = check_changes();
    if (status.ok()) status = check_pairs();
    if (status.ok()) status = check_added();
    return status;
  }

  /// Resolves the arrays alone.
  void trust() {
    std::memcpy(&view_.header_, bytes_.data(), sizeof view_.header_);
    (void)lay_out();
  }

 private:
  static Status damaged(const char* message, std::size_t offset) {
    return {StatusCode::kDataLoss, message, static_cast<std::uint32_t>(offset)};
  }
  template <class T>
  Status damaged_entry(const char* message, std::span<const T> array, std::size_t i) const {
    return damaged(message, static_cast<std::size_t>(reinterpret_cast<const std::byte*>(array.data() + i) -
                                                     bytes_.data()));
  }

  Status check_header(const LayerChainMesh& mesh) {
    if (bytes_.size() < sizeof(LayerChainHeader) || reinterpret_cast<std::uintptr_t>(bytes_.data()) % 4 != 0)
      return damaged("chain of layers is cut short at byte offset", bytes_.size());
    std::memcpy(&view_.header_, bytes_.data(), sizeof view_.header_);
    const LayerChainHeader& h = view_.header_;
    if (h.bytes > bytes_.size() || h.bytes % 4 != 0)
      return damaged("chain of layers is longer than its section, as its header says at byte offset", 0);
    if (h.vertex_count != mesh.vertex_count)
      return damaged("chain of layers is of a mesh with another number of vertices, at byte offset",
                     offsetof(LayerChainHeader, vertex_count));
    if (h.face_count != mesh.face_count || h.face_count == 0 || h.face_count > format::kMaxLayerFaces)
      return damaged("chain of layers is of a mesh with another number of faces, at byte offset",
                     offsetof(LayerChainHeader, face_count));
    if (h.group_count != mesh.group_count || h.group_count == 0)
      return damaged("chain of layers is of a mesh with another number of materials, at byte offset",
                     offsetof(LayerChainHeader, group_count));
    if (h.attributes != mesh.attributes)
      return damaged("chain of layers is of a mesh with other attributes, at byte offset",
                     offsetof(LayerChainHeader, attributes));
    if (h.method >= kMethodCount)
      return damaged("chain of layers: no such method, at byte offset", offsetof(LayerChainHeader, method));
    if (h.placement > static_cast<std::uint32_t>(Placement::kMidpoint))
      return damaged("chain of layers: no such placement, at byte offset", offsetof(LayerChainHeader, placement));
    if (h.layer_count == 0 || h.layer_count > format::kMaxLayers)
      return damaged("chain of layers: there must be 1 to 16 layers, at byte offset",
                     offsetof(LayerChainHeader, layer_count));
    if (h.vertex_count > format::kMaxStoreVertices || h.added_count > format::kMaxStoreVertices - h.vertex_count)
      return damaged("chain of layers: too many vertices, at byte offset", offsetof(LayerChainHeader, added_count));
    if (h.reserved[0] != 0 || h.reserved[1] != 0)
      return damaged("chain of layers: reserved words must be 0, at byte offset", offsetof(LayerChainHeader, reserved));
    return ok_status();
  }

  /// Takes the next `count` objects; false, and nothing taken, when they do not fit.
  template <class T>
  bool take(std::uint32_t count, std::span<const T>& out) {
    if (std::uint64_t{count} * sizeof(T) > view_.header_.bytes - at_) return false;
    out = {reinterpret_cast<const T*>(bytes_.data() + at_), count};  // 4-byte aligned, as all before it is
    at_ += count * static_cast<std::uint32_t>(sizeof(T));
    return true;
  }

  Status lay_out() {
    const LayerChainHeader& h = view_.header_;
    const auto added = [&](std::uint32_t stream) { return (h.attributes & stream) != 0 ? h.added_count : 0; };
    bool fits = h.bytes >= sizeof h;
    at_ = sizeof h;
    fits = fits && take(h.layer_count, view_.layers_) && take(h.group_count, view_.groups_) &&
           take(h.step_count, view_.steps_) && take(h.face_count, view_.slots_);
    const std::uint32_t left = !fits || h.step_count == 0 ? h.face_count : view_.steps_.back().faces_after;
    fits = fits && left <= h.face_count && take(h.group_count > 1 ? h.face_count - left : 0, view_.removed_groups_) &&
           take(h.change_count, view_.changes_) && take(h.added_count, view_.added_.positions) &&
           take(added(format::kLayerNormals), view_.added_.normals) &&
           take(added(format::kLayerColours), view_.added_.colours) &&
           take(added(format::kLayerTextureCoordinates), view_.added_.texture_coordinates) &&
           take(h.pair_count, view_.pairs_) && at_ == h.bytes;
    if (!fits) return damaged("chain of layers: its counts do not make up its size; header at byte offset", 0);
    view_.bytes_ = bytes_.first(h.bytes);
    return ok_status();
  }

  Status check_groups() {
    std::uint32_t before = 0;
    for (std::size_t g = 0; g < view_.groups_.size(); ++g) {
      const std::uint32_t end = view_.groups_[g].face_end;
      const bool last = g + 1 == view_.groups_.size();
      if (end < before || end > view_.face_count() || (last && end != view_.face_count()))
        return damaged_entry("chain of layers: groups do not divide the faces, at byte offset", view_.groups_, g);
      before = end;
    }
    return ok_status();
  }

  Status check_steps() {
    std::uint32_t changes = 0, faces = view_.face_count();
    for (std::size_t s = 0; s < view_.steps_.size(); ++s) {
      const format::LayerStep& step = view_.steps_[s];
      if (step.change_end < changes || step.change_end > view_.changes_.size())
        return damaged_entry("chain of layers: changes of steps do not follow each other, at byte offset", view_.steps_,
                             s);
      if (step.faces_after > faces)
        return damaged_entry("chain of layers: a step adds faces, at byte offset", view_.steps_, s);
      changes = step.change_end;
      faces = step.faces_after;
    }
    if (changes != view_.changes_.size())
      return damaged("chain of layers: changes belong to no step, their number at byte offset",
                     offsetof(LayerChainHeader, change_count));
    return ok_status();
  }

  Status check_layers() {
    std::uint32_t pairs = 0;
    for (std::size_t n = 0; n < view_.layers_.size(); ++n) {
      const format::Layer& layer = view_.layers_[n];
      const bool first = n == 0, last = n + 1 == view_.layers_.size();
      const bool in_order = first ? layer.step == 0 : layer.step > view_.layers_[n - 1].step;
      if (!in_order || layer.step > view_.step_count() || (last && layer.step != view_.step_count()))
        return damaged_entry("chain of layers: steps of layers do not rise to the last step, at byte offset",
                             view_.layers_, n);
      if (layer.faces != view_.faces_at(layer.step) || (!first && layer.faces >= view_.layers_[n - 1].faces))
        return damaged_entry("chain of layers: faces of layers do not fall as their steps say, at byte offset",
                             view_.layers_, n);
      if (layer.pair_end < pairs || layer.pair_end > view_.pairs_.size() || (last && layer.pair_end != pairs) ||
          (last && layer.pair_end != view_.pairs_.size()))
        return damaged_entry("chain of layers: pairs of layers do not follow each other, at byte offset", view_.layers_,
                             n);
      if (layer.quota_millionths > 1'000'000 || (first && layer.quota_millionths != 1'000'000) ||
          (!first && layer.quota_millionths >= view_.layers_[n - 1].quota_millionths))
        return damaged_entry("chain of layers: quotas of layers do not fall from all, at byte offset", view_.layers_,
                             n);
      pairs = layer.pair_end;
    }
    return ok_status();
  }

  /// A permutation cannot be checked without memory. Equal sums of the numbers and of their squares miss no one or two
  /// wrong numbers; LayerReplay::check() finds what they miss.
  Status check_faces() {
    std::uint64_t sum = 0, squares = 0;
    for (std::size_t f = 0; f < view_.slots_.size(); ++f) {
      const std::uint64_t slot = view_.slots_[f], number = f;
      if (slot >= view_.face_count())
        return damaged_entry("chain of layers: no such slot, at byte offset", view_.slots_, f);
      sum += slot - number;
      squares += slot * slot - number * number;
    }
    if (sum != 0 || squares != 0)
      return damaged_entry("chain of layers: two faces have one slot; slots begin at byte offset", view_.slots_, 0);
    for (std::size_t i = 0; i < view_.removed_groups_.size(); ++i)
      if (view_.removed_groups_[i] >= view_.group_count())
        return damaged_entry("chain of layers: no such group, at byte offset", view_.removed_groups_, i);
    return ok_status();
  }

  Status check_changes() {
    const std::uint32_t store = view_.store_count();
    for (std::uint32_t s = 0; s < view_.step_count(); ++s) {
      // With several groups the live faces are not one prefix; LayerReplay::check() knows more.
      const std::uint32_t faces = view_.group_count() > 1 ? view_.face_count() : view_.faces_at(s + 1);
      for (const format::LayerChange& change : view_.changes(s)) {
        const auto i = static_cast<std::size_t>(&change - view_.changes_.data());
        if (change.corner >= 3 * faces)
          return damaged_entry("chain of layers: a change of a corner that is not there, at byte offset",
                               view_.changes_, i);
        if (change.from >= store || change.to >= store)
          return damaged_entry("chain of layers: a change names no vertex, at byte offset", view_.changes_, i);
      }
    }
    return ok_status();
  }

  Status check_pairs() {
    for (std::uint32_t n = 0; n < view_.layer_count(); ++n) {
      const auto pairs = view_.pairs(n);
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].from >= view_.store_count() || pairs[i].vertex() >= view_.store_count() ||
            (i > 0 && pairs[i].from <= pairs[i - 1].from))
          return damaged_entry("chain of layers: a pair names no vertex or is out of order, at byte offset", pairs, i);
    }
    return ok_status();
  }

  Status check_added() {
    const VertexStreams& added = view_.added_;
    const auto within = [](float c, float most) { return c >= -most && c <= most; };
    for (std::size_t i = 0; i < added.positions.size(); ++i) {
      const Vec3 p = added.positions[i];
      constexpr float kMost = kMaxCoordinate;
      if (!within(p.x, kMost) || !within(p.y, kMost) || !within(p.z, kMost))
        return damaged_entry("chain of layers: a coordinate beyond 1e8 or not a number, at byte offset",
                             added.positions, i);
    }
    for (std::size_t i = 0; i < added.normals.size(); ++i)
      if (added.normals[i].bits >> 30 != 0)
        return damaged_entry("chain of layers: not a packed normal, at byte offset", added.normals, i);
    for (std::size_t i = 0; i < added.texture_coordinates.size(); ++i) {
      const TexCoord t = added.texture_coordinates[i];
      if (!within(t.s, kMaxTextureCoordinate) || !within(t.t, kMaxTextureCoordinate))
        return damaged_entry("chain of layers: a texture coordinate beyond 10000 or not a number, at byte offset",
                             added.texture_coordinates, i);
    }
    return ok_status();
  }

  std::span<const std::byte> bytes_;
  LayerChainView& view_;
  std::uint32_t at_ = 0;
};

Result<LayerChainView> LayerChainView::open(std::span<const std::byte> bytes, const LayerChainMesh& mesh) {
  LayerChainView view;
  const Status status = LayerChainChecker(bytes, view).check(mesh);
  if (!status.ok()) return status;
  return view;
}

LayerChainView LayerChainView::of_checked(std::span<const std::byte> bytes) {
  LayerChainView view;
  LayerChainChecker(bytes, view).trust();
  return view;
}

std::uint32_t LayerChainView::group_of(std::uint32_t slot) const {
  std::uint32_t low = 0, high = group_count() - 1;
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (slot < groups_[middle].face_end) high = middle; else low = middle + 1;
  }
  return low;
}

void LayerReplay::begin() {
  step_ = 0;
  std::memset(indices_, 0, std::size_t{3} * chain_.face_count() * index_bytes_);
  for (std::uint32_t g = 0; g < live_.size(); ++g) live_[g] = chain_.group_end(g) - chain_.group_begin(g);
}

void LayerReplay::set_face(std::uint32_t f, const std::uint32_t vertices[3]) {
  const std::uint32_t first = 3 * chain_.slot(f);
  for (std::uint32_t k = 0; k < 3; ++k) write(first + k, vertices[k]);
}

std::uint32_t LayerReplay::corner(std::uint32_t c) const {
  return index_bytes_ == 2 ? indices<std::uint16_t>()[c] : indices<std::uint32_t>()[c];
}

void LayerReplay::write(std::uint32_t corner, std::uint32_t vertex) {
  if (index_bytes_ == 2) indices<std::uint16_t>()[corner] = static_cast<std::uint16_t>(vertex);
  else indices<std::uint32_t>()[corner] = vertex;
}

std::uint64_t LayerReplay::forward() {
  const auto changes = chain_.changes(step_);
  for (const format::LayerChange& change : changes) write(change.corner, change.to);
  const std::uint32_t all = chain_.face_count();
  for (std::uint32_t i = all - chain_.faces_at(step_); i < all - chain_.faces_at(step_ + 1); ++i)
    --live_[chain_.removed_group(i)];
  ++step_;
  return changes.size();
}

std::uint64_t LayerReplay::backward() {
  --step_;
  const auto changes = chain_.changes(step_);
  for (std::size_t i = changes.size(); i-- > 0;) write(changes[i].corner, changes[i].from);
  const std::uint32_t all = chain_.face_count();
  for (std::uint32_t i = all - chain_.faces_at(step_); i < all - chain_.faces_at(step_ + 1); ++i)
    ++live_[chain_.removed_group(i)];
  return changes.size();
}

std::uint64_t LayerReplay::go_to(std::uint32_t step) {
  std::uint64_t written = 0;
  while (step_ < step) written += forward();
  while (step_ > step) written += backward();
  return written;
}

std::uint64_t LayerReplay::go_to_faces(std::uint32_t faces) {
  std::uint64_t written = 0;
  while (step_ > 0 && chain_.faces_at(step_ - 1) <= faces) written += backward();
  while (step_ < chain_.step_count() && chain_.faces_at(step_) > faces) written += forward();
  return written;
}

Status LayerReplay::check() {
  const auto contradiction = [](std::uint32_t step) {
    return Status{StatusCode::kDataLoss, "chain of layers contradicts itself in step", step};
  };
  // A slot that no face was put in is as begin() left it; proper faces name three vertices.
  for (std::uint32_t slot = 0; slot < chain_.face_count(); ++slot)
    if (corner(3 * slot) == corner(3 * slot + 1)) return contradiction(0);
  while (step_ < chain_.step_count()) {
    const std::uint32_t s = step_, all = chain_.face_count();
    for (const format::LayerChange& change : chain_.changes(s)) {
      if (corner(change.corner) != change.from) return contradiction(s);
      write(change.corner, change.to);
    }
    for (std::uint32_t i = all - chain_.faces_at(s); i < all - chain_.faces_at(s + 1); ++i)
      if (live_[chain_.removed_group(i)]-- == 0) return contradiction(s);
    for (const format::LayerChange& change : chain_.changes(s)) {
      const std::uint32_t g = chain_.group_of(change.corner / 3);
      if (change.corner / 3 - chain_.group_begin(g) >= live_[g]) return contradiction(s);
    }
    ++step_;
  }
  go_to(0);
  return ok_status();
}

}  // namespace usuzumi::firmware
