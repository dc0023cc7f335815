#include "firmware/layers/layer_chain_builder.h"

#include "firmware/layers/layer_format.h"

namespace usuzumi::firmware {
namespace {

constexpr std::uint32_t kMillion = 1'000'000;

class LayerChainBuilder {
 public:
  LayerChainBuilder(const LayerChainInput& input, std::span<std::byte> out)
      : input_(input), log_(*input.log), out_(out) {}

  Result<std::uint32_t> build(Arena& scratch) {
    for (std::uint32_t s = 0; s < log_.steps().size(); ++s)
      if (faces_at(s + 1) > faces_at(s)) return contradiction(s);
    choose_layers();
    if (added_count_ > log_.added().size()) return contradiction(step_count_);
    if (!lay_out()) return exhausted();
    Status status = write_faces();
    if (status.ok()) status = write_steps();
    write_added();
    if (status.ok()) status = write_pairs(scratch);
    if (!status.ok()) return status;
    finish_header();
    return header().bytes;
  }

 private:
  Status exhausted() const {
    return {StatusCode::kResourceExhausted, "no room for a chain of layers; bytes there are",
            static_cast<std::uint32_t>(out_.size())};
  }
  static Status contradiction(std::uint32_t step) {
    return {StatusCode::kDataLoss, "log of collapses contradicts itself in step", step};
  }

  std::uint32_t faces_at(std::uint32_t step) const {
    return step == 0 ? input_.mesh.face_count : log_.steps()[step - 1].faces_after;
  }

  /// Layers end at the first step that meets their quota, or at the log's last. Where that comes less than halfway to
  /// the quota, it takes the place of the layer before: so short a layer would be passed in a frame or two.
  void choose_layers() {
    layers_[layer_count_++] = {0, input_.mesh.face_count, 0, kMillion};
    const auto last = static_cast<std::uint32_t>(log_.steps().size());
    std::uint32_t step = 0;
    for (const std::uint32_t quota : input_.quotas_millionths.subspan(1)) {
      const std::uint32_t faces = layer_faces(input_.mesh.face_count, quota);
      while (step < last && faces_at(step) > faces) ++step;
      format::Layer& before = layers_[layer_count_ - 1];
      if (faces_at(step) >= before.faces) continue;
      if (layer_count_ > 1 && faces_at(step) > faces && faces_at(step) - faces > before.faces - faces_at(step)) {
        before.step = step;
        before.faces = faces_at(step);
        continue;
      }
      layers_[layer_count_++] = {step, faces_at(step), 0, quota};
    }
    step_count_ = layers_[layer_count_ - 1].step;
    change_count_ = 0;
    for (std::uint32_t s = 0; s < step_count_; ++s) visit_changes(s, [&](const CornerChange&) { ++change_count_; });
    for (std::uint32_t s = 0; s < step_count_; ++s) added_count_ = added_after(s, added_count_);
  }

  /// The changes of step s whose face outlives it.
  template <class Visit>
  void visit_changes(std::uint32_t s, Visit&& visit) const {
    const std::uint32_t begin = s == 0 ? 0 : log_.steps()[s - 1].change_end;
    for (const CornerChange& change : log_.changes().subspan(begin, log_.steps()[s].change_end - begin))
      if (change.corner / 3 >= input_.mesh.face_count || log_.removed_at()[change.corner / 3] > s) visit(change);
  }

  std::span<const Succession> successions(std::uint32_t first_step, std::uint32_t end_step) const {
    if (end_step == 0) return {};
    const std::uint32_t begin = first_step == 0 ? 0 : log_.steps()[first_step - 1].succession_end;
    return log_.successions().subspan(begin, log_.steps()[end_step - 1].succession_end - begin);
  }

  /// Added vertices in use after step s, at least `before`: they are numbered in the order in which they come up.
  std::uint32_t added_after(std::uint32_t s, std::uint32_t before) const {
    const auto count = [&](std::uint32_t vertex) {
      if (vertex >= input_.mesh.vertex_count && vertex - input_.mesh.vertex_count >= before)
        before = vertex - input_.mesh.vertex_count + 1;
    };
    visit_changes(s, [&](const CornerChange& change) { count(change.to); });
    for (const Succession& succession : successions(s, s + 1)) count(succession.to);
    return before;
  }

  template <class T>
  bool take(std::uint64_t count, std::span<T>& to) {
    if (count * sizeof(T) > out_.size() - used_) return false;
    to = {reinterpret_cast<T*>(out_.data() + used_), static_cast<std::size_t>(count)};
    used_ += static_cast<std::size_t>(count) * sizeof(T);
    return true;
  }

  bool lay_out() {
    const auto stream = [&](std::uint32_t bit) { return (input_.mesh.attributes & bit) != 0 ? added_count_ : 0u; };
    const std::uint32_t removed = input_.mesh.group_count > 1 ? input_.mesh.face_count - faces_at(step_count_) : 0;
    return take(1, header_) && take(layer_count_, out_layers_) && take(input_.mesh.group_count, groups_) &&
           take(step_count_, steps_) && take(input_.mesh.face_count, slots_) && take(removed, removed_groups_) &&
           take(change_count_, changes_) && take(added_count_, positions_) &&
           take(stream(format::kLayerNormals), normals_) && take(stream(format::kLayerColours), colours_) &&
           take(stream(format::kLayerTextureCoordinates), texture_coordinates_);
  }

  format::LayerChainHeader& header() { return header_[0]; }
  std::uint32_t group_end(std::uint32_t g) const {
    return input_.groups.empty() ? input_.mesh.face_count : input_.groups[g].face_end;
  }

  /// Slots group by group, within a group by the step that removes the face, the last first; faces of one step by
  /// number. Faces removed after the last layer count as never removed. The steps' entries serve as cursors meanwhile.
  Status write_faces() {
    const auto never = [&](std::uint32_t removed_at) { return removed_at >= step_count_; };
    std::uint32_t begin = 0;
    for (std::uint32_t g = 0; g < input_.mesh.group_count; ++g) {
      const std::uint32_t end = group_end(g);
      groups_[g].face_end = end;
      for (format::LayerStep& step : steps_) step = {0, 0};
      std::uint32_t kept = 0;
      for (std::uint32_t f = begin; f < end; ++f) {
        const std::uint32_t at = log_.removed_at()[f];
        if (never(at)) slots_[f] = begin + kept++;
        else ++steps_[at].faces_after;
      }
      std::uint32_t slot = begin + kept;
      for (std::size_t s = steps_.size(); s-- > 0;) {
        steps_[s].change_end = slot;  // where the faces that step s removes begin
        slot += steps_[s].faces_after;
      }
      for (std::uint32_t f = begin; f < end; ++f) {
        const std::uint32_t at = log_.removed_at()[f];
        if (!never(at)) slots_[f] = steps_[at].change_end++;
      }
      begin = end;
      for (std::uint32_t s = 0; s < step_count_; ++s)
        if (!count_removed(s, g, steps_[s].faces_after)) return contradiction(s);
    }
    return ok_status();
  }

  /// Step s removes `count` faces of group g: notes the group for as many of the faces it removes, those of each step
  /// group by group. False where the log told of another number of faces.
  bool count_removed(std::uint32_t s, std::uint32_t g, std::uint32_t count) {
    if (input_.mesh.group_count == 1) return count == faces_at(s) - faces_at(s + 1);
    constexpr std::uint32_t kNotYet = 0xFFFFFFFFu;
    const std::uint32_t all = input_.mesh.face_count, first = all - faces_at(s), end = all - faces_at(s + 1);
    if (g == 0)
      for (std::uint32_t i = first; i < end; ++i) removed_groups_[i] = kNotYet;
    std::uint32_t i = first;
    while (i < end && removed_groups_[i] != kNotYet) ++i;
    for (; i < end && count > 0; ++i, --count) removed_groups_[i] = g;
    return count == 0 && (g + 1 < input_.mesh.group_count || i == end);
  }

  Status write_steps() {
    std::uint32_t used = 0;
    for (std::uint32_t s = 0; s < step_count_; ++s) {
      bool good = true;
      visit_changes(s, [&](const CornerChange& change) {
        good = good && change.corner / 3 < input_.mesh.face_count;
        if (good) changes_[used++] = {3 * slots_[change.corner / 3] + change.corner % 3, change.from, change.to};
      });
      if (!good) return contradiction(s);
      steps_[s] = {used, faces_at(s + 1)};
    }
    return ok_status();
  }

  void write_added() {
    for (std::uint32_t i = 0; i < added_count_; ++i) {
      const StoreVertex& vertex = log_.added()[i];
      positions_[i] = vertex.position;
      if (!normals_.empty()) normals_[i] = vertex.normal;
      if (!colours_.empty()) colours_[i] = vertex.colour;
      if (!texture_coordinates_.empty()) texture_coordinates_[i] = vertex.texture_coordinate;
    }
  }

  /// Composes the successions between layers: from the last to the first, so that where a vertex goes is known before
  /// what goes to it is asked.
  Status write_pairs(Arena& scratch) {
    const ScratchScope scope(scratch);
    const std::uint32_t store = input_.mesh.vertex_count + added_count_;
    const auto target = scratch.allocate<std::uint32_t>(store);
    if (target.size() != store) return exhausted();
    std::uint32_t added = 0;  // at the layer
    for (std::uint32_t n = 0; n + 1 < layer_count_; ++n) {
      for (std::uint32_t s = n == 0 ? 0 : layers_[n - 1].step; n > 0 && s < layers_[n].step; ++s)
        added = added_after(s, added);
      for (std::uint32_t v = 0; v < store; ++v) target[v] = v;
      const auto between = successions(layers_[n].step, layers_[n + 1].step);
      for (std::size_t i = between.size(); i-- > 0;) {
        if (between[i].from >= store || between[i].to >= store) return contradiction(layers_[n].step);
        target[between[i].from] = target[between[i].to] | (between[i].place_only != 0 ? format::kPairPlaceOnly : 0);
      }
      for (std::uint32_t v = 0; v < input_.mesh.vertex_count + added; ++v) {
        if (target[v] == v) continue;
        std::span<format::LayerPair> pair;
        if (!take(1, pair)) return exhausted();
        pair[0] = {v, target[v]};
        ++pair_count_;
      }
      layers_[n].pair_end = pair_count_;
    }
    layers_[layer_count_ - 1].pair_end = pair_count_;
    return ok_status();
  }

  void finish_header() {
    for (std::uint32_t n = 0; n < layer_count_; ++n) out_layers_[n] = layers_[n];
    format::LayerChainHeader h;
    h.bytes = static_cast<std::uint32_t>(used_);
    h.vertex_count = input_.mesh.vertex_count;
    h.face_count = input_.mesh.face_count;
    h.group_count = input_.mesh.group_count;
    h.attributes = input_.mesh.attributes;
    h.method = static_cast<std::uint32_t>(input_.method);
    h.placement = static_cast<std::uint32_t>(input_.placement);
    h.layer_count = layer_count_;
    h.step_count = step_count_;
    h.change_count = change_count_;
    h.added_count = added_count_;
    h.pair_count = pair_count_;
    header() = h;
  }

  const LayerChainInput& input_;
  const CollapseLog& log_;
  std::span<std::byte> out_;
  std::size_t used_ = 0;
  format::Layer layers_[format::kMaxLayers];
  std::uint32_t layer_count_ = 0, step_count_ = 0, change_count_ = 0, added_count_ = 0, pair_count_ = 0;

  std::span<format::LayerChainHeader> header_;
  std::span<format::Layer> out_layers_;
  std::span<format::LayerGroup> groups_;
  std::span<format::LayerStep> steps_;
  std::span<std::uint32_t> slots_, removed_groups_;
  std::span<format::LayerChange> changes_;
  std::span<Vec3> positions_;
  std::span<PackedNormal> normals_;
  std::span<Rgba8> colours_;
  std::span<TexCoord> texture_coordinates_;
};

}  // namespace

bool layer_quotas_fall(std::span<const std::uint32_t> quotas) {
  if (quotas.empty() || quotas.size() > format::kMaxLayers || quotas[0] != kMillion) return false;
  for (std::size_t n = 1; n < quotas.size(); ++n)
    if (quotas[n] >= quotas[n - 1] || quotas[n] == 0) return false;
  return true;
}

std::uint32_t layer_faces(std::uint32_t faces, std::uint32_t quota_millionths) {
  return static_cast<std::uint32_t>(std::uint64_t{faces} * quota_millionths / kMillion);
}

Result<std::uint32_t> build_layer_chain(const LayerChainInput& input, Arena& scratch, std::span<std::byte> out) {
  if (!layer_quotas_fall(input.quotas_millionths))
    return Status{StatusCode::kInvalidArgument, "layers must fall from 1,000,000 millionths; their number is",
                  static_cast<std::uint32_t>(input.quotas_millionths.size())};
  if (input.mesh.face_count == 0 || input.mesh.face_count > format::kMaxLayerFaces)
    return Status{StatusCode::kInvalidArgument, "a mesh without faces has no layers; faces", input.mesh.face_count};
  if (input.log->full())
    return Status{StatusCode::kResourceExhausted, "log of collapses is full; its steps",
                  static_cast<std::uint32_t>(input.log->steps().size())};
  const std::size_t most = out.size() < 0xFFFFFFFCu ? out.size() : 0xFFFFFFFCu;
  const auto bytes = LayerChainBuilder(input, out.first(most)).build(scratch);
  if (!bytes.ok()) return bytes;
  // What is made is held to what is read: no chain that open() refuses leaves this place.
  const auto opened = LayerChainView::open(out.first(*bytes), input.mesh);
  if (!opened.ok()) return opened.status();
  return bytes;
}

CollapseLogSizes collapse_log_sizes(std::uint32_t vertex_count, std::uint32_t face_count) {
  // A closed mesh of F faces has F / 2 vertices and as many collapses to lose them all; open borders and wedges make it
  // more of either. Changes: eight corners a collapse; wedges make several added vertices of one.
  return {face_count, 6 * face_count + 64, 2 * vertex_count + face_count + 64, vertex_count + face_count / 2 + 64};
}

bool allocate_collapse_log(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count,
                           CollapseLog::Memory& memory) {
  const CollapseLogSizes sizes = collapse_log_sizes(vertex_count, face_count);
  memory = {arena.allocate<CollapseStep>(sizes.steps),
            arena.allocate<CornerChange>(sizes.changes),
            arena.allocate<Succession>(sizes.successions),
            arena.allocate<std::uint32_t>(face_count),
            arena.allocate<StoreVertex>(sizes.added),
            arena.allocate<std::uint32_t>(vertex_count)};
  return memory.steps.size() == sizes.steps && memory.changes.size() == sizes.changes &&
         memory.successions.size() == sizes.successions && memory.removed_at.size() == face_count &&
         memory.added.size() == sizes.added && memory.store_of_wedge.size() == vertex_count;
}

}  // namespace usuzumi::firmware
