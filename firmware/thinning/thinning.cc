#include "firmware/thinning/thinning.h"

#include <algorithm>
#include <bit>
#include <new>

namespace usuzumi::firmware {
namespace {

/// A quarter of the quotas' quarter is where a shape stops being recognisable; beyond that a mesh is better left out.
constexpr std::uint32_t kMaxQuotaHalvings = 4;

/// The decision with the quota that memory allows.
Decision narrowed(Decision decision, std::uint32_t quota_halvings) {
  decision.target_faces >>= quota_halvings;
  return decision;
}

unsigned size_class(std::uint64_t bytes) { return static_cast<unsigned>(std::bit_width(bytes)); }
// Working bytes of one mesh stay below 2^39: 2^30 bytes of ROM, under 2^8 times that.
constexpr unsigned kSizeClasses = 40;

}  // namespace

Thinning::Priority Thinning::priority(const MeshView& mesh) {
  if (mesh.telltale()) return kMust;
  switch (mesh.level) {
    case Level::kUnset:
    case Level::kKeep: return kMust;
    case Level::kPoint:
    case Level::kLine: return kMark;
    case Level::kCollapse: return kCollapsible;
    case Level::kDelete: return kDeletable;
  }
  return kDeletable;
}

Status Thinning::begin(const DrawingData& data, Arena& ram, bool rom_on_bus,
                       std::span<const std::uint32_t> boot_layers) {
  begun_ = layers_given_up_ = false;
  layers_ = {};
  copy_ = {};
  quota_halvings_ = 0;
  totals_ = {};
  faces_in_ = 0;
  data_ = &data;
  states_ = ram.allocate<MeshState>(data.mesh_max());
  if (states_.size() != data.mesh_max())
    return {StatusCode::kResourceExhausted, "RAM has no room for the table of meshes; meshes", data.mesh_max()};
  std::uint32_t record = data.first_record();
  for (std::uint32_t n = 0; n < data.mesh_max(); ++n, record = data.next_record(record)) {
    new (&states_[n]) MeshState{};
    states_[n].record_offset = record;
    const MeshView mesh = view_of(n);
    ++totals_.meshes[static_cast<std::size_t>(mesh.level)];
    const std::uint32_t faces = states_[n].faces = mesh.proper_face_count();
    faces_in_ += faces;
    if (mesh.level == Level::kCollapse) totals_.collapse_faces += faces;
  }
  const Status status = layers_.begin(data, ram, boot_layers);
  return status.ok() ? copy_.begin(data.mesh_max(), ram, rom_on_bus) : status;
}

float Thinning::drawn_layer(std::uint32_t n) const {
  const LayeredMesh* layered = layers(n);
  if (layered == nullptr || !copy_.present(n) || !copy_.mesh(n).layered) return -1;
  return layer_of_place(layered->view(), layered->place);
}

Status Thinning::update(const ThinningSettings& settings, const View& view, Clock& clock, ThinningReport& report) {
  report = {};
  report.cause = begun_ ? UpdateCause::kDecisions : UpdateCause::kFirst;
  if (decide_all(settings, view, clock)) {
    begun_ = true;
    build_all(clock);
    report.meshes_moved = move_along_layers(settings.layers, view, clock);
  } else {
    report.meshes_moved = move_along_layers(settings.layers, view, clock);
    report.cause = report.meshes_moved > 0 ? UpdateCause::kLayers : UpdateCause::kUnchanged;
  }
  return summarize(report);
}

/// Builds what is wanted, and asks for less until everything that may not be left out has room. What is given up does
/// not depend on what earlier frames have built: where RAM is short, all is built anew.
void Thinning::build_all(Clock& clock) {
  quota_halvings_ = 0;
  layers_given_up_ = false;
  const bool all = std::all_of(states_.begin(), states_.end(), [](const MeshState& state) { return state.wanted; });
  build_wanted(clock);
  if (short_of_room() && !all) {
    for (MeshState& state : states_) state.wanted = true;
    build_wanted(clock);
  }
  if (short_of_room() && any_layered()) {
    layers_given_up_ = true;
    want_collapses();
    build_wanted(clock);
  }
  while (dropped_any(kCollapsible) && can_halve_quotas()) {
    ++quota_halvings_;
    want_collapses();
    build_wanted(clock);
  }
}

/// Marks the meshes whose copy must be built; false when there are none.
bool Thinning::decide_all(const ThinningSettings& settings, const View& view, Clock& clock) {
  Decider decider(settings, totals_, view);
  bool any = false;
  for (std::uint32_t n = 0; n < data_->mesh_max(); ++n) {
    MeshState& state = states_[n];
    const MeshView mesh = view_of(n);
    Decision decision = decider.decide(mesh, state.faces);
    decide_layers(settings.layers.mode, n, decision);
    state.wanted = !state.known || !same_copy(state.decision, decision);
    state.decision = decision;
    state.built = false;
    any = any || state.wanted;
  }
  clock.charge(CpuWork::kFaceMeasured, decider.faces_measured());
  if (!any) return false;
  // Quotas that an earlier shortage halved, and meshes that it left out, get another chance.
  for (std::uint32_t n = 0; n < data_->mesh_max(); ++n) {
    MeshState& state = states_[n];
    const bool squeezed = (quota_halvings_ > 0 && state.decision.action == Action::kCollapse) ||
                          (layers_given_up_ && state.decision.layered);
    const bool short_of_room =
        state.build.outcome == BuildOutcome::kDropped || state.build.outcome == BuildOutcome::kUnthinned;
    if (squeezed || (state.known && short_of_room)) state.wanted = true;
  }
  return true;
}

/// Whether the mesh is drawn from its chain.
void Thinning::decide_layers(LayerMode mode, std::uint32_t n, Decision& decision) {
  const LayeredMesh* layered = layers(n);
  if (decision.action != Action::kCollapse || layered == nullptr || !layered->sound) return;
  if (!chain_serves(*layered, mode, decision)) return;
  decision.layered = true;
  decision.vertices_move = mode != LayerMode::kFaces;
}

/// Builds what is wanted: what must be there first, and within a priority the meshes that need most room to work in
/// first, while there is most.
void Thinning::build_wanted(Clock& clock) {
  for (std::uint32_t n = 0; n < data_->mesh_max(); ++n)
    if (states_[n].wanted) copy_.drop(n);
  copy_.compact();
  const auto size_of = [&](const MeshView& mesh) {
    const MeshState& state = states_[mesh.number];
    return size_class(working_bytes(mesh, state.faces, state.decision, copy_));
  };
  for (std::uint32_t p = 0; p < kPriorityCount; ++p) {
    std::uint64_t classes = 0;  // bit c: some mesh of this priority is of size class c
    for (std::uint32_t n = 0; n < data_->mesh_max(); ++n) {
      if (!states_[n].wanted) continue;
      const MeshView mesh = view_of(n);
      if (priority(mesh) == p) classes |= std::uint64_t{1} << size_of(mesh);
    }
    for (unsigned c = kSizeClasses; c-- > 0;) {
      if ((classes >> c & 1) == 0) continue;
      for (std::uint32_t n = 0; n < data_->mesh_max(); ++n) {
        if (!states_[n].wanted) continue;
        const MeshView mesh = view_of(n);
        if (priority(mesh) == p && size_of(mesh) == c) build_one(mesh, clock);
      }
    }
  }
}

void Thinning::build_one(const MeshView& mesh, Clock& clock) {
  MeshState& state = states_[mesh.number];
  const Decision decision = narrowed(state.decision, quota_halvings_);
  do {
    copy_.drop(mesh.number);  // what a first try left unthinned
    copy_.compact();
    state.build = build(mesh, decision, clock);
  } while ((state.build.outcome == BuildOutcome::kDropped || state.build.outcome == BuildOutcome::kUnthinned) &&
           make_room(priority(mesh)));
  state.wanted = false;
  state.known = state.built = true;
}

BuildReport Thinning::build(const MeshView& mesh, const Decision& decision, Clock& clock) {
  if (decision.layered && !layers_given_up_) {
    LayeredMesh& layered = *layers_.find(mesh.number);
    BuildReport report;
    if (copy_layered(mesh, layered, decision.vertices_move, copy_, clock, report)) return report;
    if (!layered.sound) states_[mesh.number].decision.layered = false;
  }
  return build_mesh(mesh, states_[mesh.number].faces, decision, copy_, clock);
}

/// Moves every mesh that is drawn from its layers to where it is wanted; returns how many were not there.
std::uint32_t Thinning::move_along_layers(const LayerSettings& settings, const View& view, Clock& clock) {
  std::uint32_t moved = 0;
  for (LayeredMesh& layered : layers_.meshes()) {
    if (layered.chain.empty()) continue;
    const std::uint32_t n = layered.mesh;
    const Decision& decision = states_[n].decision;
    if (!copy_.present(n) || !copy_.mesh(n).layered) {
      layered.memory = {};
      // A mesh that was drawn whole sets out from its first layer.
      if (settings.mode == LayerMode::kAutomatic && copy_.present(n) && decision.action == Action::kKeep)
        layered.memory = memory_of_whole(layered, view);
      continue;
    }
    const ChainPlace place = place_wanted(layered, settings, decision, view);
    const bool automatic = settings.mode == LayerMode::kAutomatic;
    if (!automatic) layered.memory = {};
    // Of LayerMode::kAutomatic the quota is a limit, not what is asked for.
    const bool missed = !automatic && decision.target_faces < layered.view().last_faces();
    states_[n].build.outcome = missed ? BuildOutcome::kQuotaNotReached : BuildOutcome::kBuilt;
    if (move_layered(view_of(n), layered, place, copy_, clock)) ++moved;
  }
  return moved;
}

/// Drops one mesh that counts less than `below`, the last of the least, and has it built again when its turn comes;
/// false when there is none.
bool Thinning::make_room(Priority below) {
  for (std::uint32_t p = kPriorityCount; p-- > static_cast<std::uint32_t>(below) + 1;) {
    for (std::uint32_t n = data_->mesh_max(); n-- > 0;) {
      if (!copy_.present(n) || priority(view_of(n)) != p) continue;
      copy_.drop(n);
      states_[n].wanted = true;
      return true;
    }
  }
  return false;
}

bool Thinning::dropped_any(Priority up_to) const {
  for (std::uint32_t n = 0; n < data_->mesh_max(); ++n)
    if (states_[n].build.outcome == BuildOutcome::kDropped && priority(view_of(n)) <= up_to) return true;
  return false;
}

bool Thinning::short_of_room() const {
  for (const MeshState& state : states_)
    if (state.build.outcome == BuildOutcome::kDropped || state.build.outcome == BuildOutcome::kUnthinned) return true;
  return false;
}

/// Where layers were given up, what was built instead of them counts too.
bool Thinning::same_copy(Decision was, Decision is) const {
  if (!was.same_copy(is)) return false;
  if (layers_given_up_) was.layered = is.layered = false;
  return was.same_copy(is);
}

bool Thinning::any_layered() const {
  for (const MeshState& state : states_)
    if (state.decision.layered) return true;
  return false;
}

/// Whether another halving would ask some mesh for fewer faces.
bool Thinning::can_halve_quotas() const {
  if (quota_halvings_ == kMaxQuotaHalvings) return false;
  for (const MeshState& state : states_)
    if (state.decision.action == Action::kCollapse && narrowed(state.decision, quota_halvings_).target_faces > 0)
      return true;
  return false;
}

/// Everything below the meshes that must be there is built again, with the quotas as they are now; so is what was to be
/// drawn from layers that are given up.
void Thinning::want_collapses() {
  for (std::uint32_t n = 0; n < data_->mesh_max(); ++n)
    if (priority(view_of(n)) >= kCollapsible || states_[n].build.outcome == BuildOutcome::kDropped ||
        states_[n].build.outcome == BuildOutcome::kUnthinned ||
        (layers_given_up_ && copy_.present(n) && copy_.mesh(n).layered))
      states_[n].wanted = true;
}

void Thinning::count_decisions_and_builds(ThinningReport& report) const {
  for (std::uint32_t n = 0; n < data_->mesh_max(); ++n) {
    const MeshState& state = states_[n];
    ++report.actions[static_cast<std::size_t>(state.decision.action)];
    if (state.decision.action == Action::kKeep) ++report.kept_for[static_cast<std::size_t>(state.decision.reason)];
    if (copy_.present(n)) report.bytes_left_in_rom += state.build.bytes_left_in_rom;
    if (copy_.present(n) && copy_.mesh(n).layered) ++report.meshes_layered;
    if (!state.built || !copy_.present(n)) continue;
    ++report.meshes_built;
    if (!state.build.collapsed) continue;
    ++report.meshes_collapsed;
    if (state.build.max_error > report.max_error) report.max_error = state.build.max_error;
  }
}

/// Whether the copy may be drawn. Indices are looked at where they were built: replay puts in their place others that
/// LayerChainView::open() has seen.
bool Thinning::sound() const {
  if (!copy_.blocks_sound()) return false;
  for (std::uint32_t n = 0; n < data_->mesh_max(); ++n)
    if (states_[n].built && copy_.present(n) && !copy_.indices_sound(n)) return false;
  return true;
}

Status Thinning::summarize(ThinningReport& report) const {
  count_decisions_and_builds(report);
  report.meshes_in = data_->mesh_max();
  report.meshes_out = copy_.new_mesh_max();
  report.faces_in = faces_in_;
  report.faces_out = copy_.faces();
  report.quota_halvings = quota_halvings_;
  report.layers_given_up = layers_given_up_;
  for (const LayeredMesh& layered : layers_.meshes())
    if (!layered.sound) ++report.chains_refused;
  report.copy_bytes = copy_.used_bytes();
  report.peak_bytes = copy_.peak_bytes();
  Status status = sound() ? ok_status() : Status{StatusCode::kDataLoss, "RAM copy is not sound", 0};
  for (std::uint32_t n = data_->mesh_max(); n-- > 0;) {
    switch (states_[n].build.outcome) {
      case BuildOutcome::kBuilt: break;
      case BuildOutcome::kQuotaNotReached: ++report.quotas_missed; break;
      case BuildOutcome::kUnthinned: ++report.meshes_unthinned; break;
      case BuildOutcome::kDropped:
        ++report.meshes_dropped;
        report.first_dropped = n;
        if (priority(view_of(n)) == kMust)
          status = {StatusCode::kResourceExhausted, "RAM has no room for a mesh that must be drawn; mesh number", n};
        break;
    }
  }
  return status;
}

}  // namespace usuzumi::firmware
