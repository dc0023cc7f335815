// A method too simple to be wrong, which logs what it does and keeps every state it passed through.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "firmware/layers/layer_chain_builder.h"
#include "firmware/simplify/collapse_log.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {

using Face = std::array<std::uint32_t, 3>;

/// Collapses random edges that keep the surface a surface, without asking whether the shape suffers. `Kind` says
/// whether the vertex that stays keeps its entry (half-edge) or becomes a new one in the middle.
class HandLog {
 public:
  enum class Kind { kHalfEdge, kMiddle };

  HandLog(const Mesh& mesh, Kind kind, std::uint32_t target_faces, unsigned seed,
          std::vector<firmware::MaterialGroup> groups = {})
      : groups_(std::move(groups)),
        vertex_count_(static_cast<std::uint32_t>(mesh.positions.size())),
        positions_(mesh.positions),
        steps_(mesh.face_count()),
        changes_(200 * mesh.face_count()),
        successions_(10 * mesh.positions.size()),
        removed_(mesh.face_count()),
        added_(mesh.positions.size()),
        wedges_(mesh.positions.size()),
        log_({steps_, changes_, successions_, removed_, added_, wedges_}, vertex_count_,
             static_cast<std::uint32_t>(mesh.face_count())) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
      faces_.push_back({mesh.indices[3 * f], mesh.indices[3 * f + 1], mesh.indices[3 * f + 2]});
    alive_.assign(faces_.size(), true);
    keep_state();
    std::mt19937 random(seed);
    while (alive_faces() > target_faces) collapse(random, kind);
  }

  const firmware::CollapseLog& log() const { return log_; }
  firmware::CollapseLog& log() { return log_; }
  const std::vector<firmware::MaterialGroup>& groups() const { return groups_; }
  const std::vector<Vec3>& positions() const { return positions_; }  // of the store
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(faces_.size()); }
  std::uint32_t vertex_count() const { return vertex_count_; }

  /// Live faces after `step` steps, by number of the mesh as given.
  struct State {
    std::vector<std::pair<std::uint32_t, Face>> faces;
  };
  const State& state(std::uint32_t step) const { return states_[step]; }
  std::uint32_t steps() const { return static_cast<std::uint32_t>(states_.size() - 1); }

  firmware::LayerChainInput input(std::span<const std::uint32_t> quotas) const {
    const auto groups = static_cast<std::uint32_t>(std::max<std::size_t>(groups_.size(), 1));
    return {{vertex_count_, face_count(), groups, 0}, groups_, quotas, firmware::Method::kHalfEdge,
            firmware::Placement::kOptimal, &log_};
  }

 private:
  std::uint32_t alive_faces() const {
    return static_cast<std::uint32_t>(std::count(alive_.begin(), alive_.end(), true));
  }

  void collapse(std::mt19937& random, Kind kind) {
    std::uint32_t gone = 0, stays = 0;
    do {
      std::size_t f = random() % faces_.size();
      while (!alive_[f]) f = (f + 1) % faces_.size();
      const std::size_t k = random() % 3;
      gone = faces_[f][k];
      stays = faces_[f][(k + 1) % 3];
    } while (!keeps_topology(gone, stays));
    log_.begin_step();
    std::uint32_t to = stays;
    if (kind == Kind::kMiddle) {
      const Vec3 middle = (positions_[gone] + positions_[stays]) * 0.5f;
      // Attributes need only differ from others' and repeat.
      to = log_.add_vertex({middle, pack_normal(middle), Rgba8{static_cast<std::uint32_t>(random())},
                            {middle.x, middle.y}});
      positions_.push_back(middle);
    }
    for (std::uint32_t g = 0; g < faces_.size(); ++g) {
      if (!alive_[g]) continue;
      const auto has = [&](std::uint32_t v) { return std::count(faces_[g].begin(), faces_[g].end(), v) > 0; };
      if (has(gone) && has(stays)) {
        alive_[g] = false;
        log_.remove_face(g);
      }
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t v = faces_[g][c];
        if ((v != gone && v != stays) || v == to) continue;
        log_.change(3 * g + c, v, to);  // of removed faces, too: a method may tell of them
        faces_[g][c] = to;
      }
    }
    log_.succeed(gone, to);
    if (to != stays) log_.succeed(stays, to);
    log_.end_step();
    keep_state();
  }

  /// The link condition: the vertices next to both ends are the apexes of the faces between them.
  bool keeps_topology(std::uint32_t a, std::uint32_t b) const {
    std::set<std::uint32_t> near_a, near_b, common;
    std::size_t shared = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (!alive_[f]) continue;
      const auto has = [&](std::uint32_t v) { return std::count(faces_[f].begin(), faces_[f].end(), v) > 0; };
      if (has(a)) near_a.insert(faces_[f].begin(), faces_[f].end());
      if (has(b)) near_b.insert(faces_[f].begin(), faces_[f].end());
      if (has(a) && has(b)) ++shared;
    }
    std::set_intersection(near_a.begin(), near_a.end(), near_b.begin(), near_b.end(),
                          std::inserter(common, common.begin()));
    return common.size() == shared + 2;  // the ends themselves are next to both
  }

  void keep_state() {
    State state;
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      if (alive_[f]) state.faces.emplace_back(f, faces_[f]);
    states_.push_back(std::move(state));
  }

  std::vector<firmware::MaterialGroup> groups_;
  std::uint32_t vertex_count_;
  std::vector<Vec3> positions_;
  std::vector<firmware::CollapseStep> steps_;
  std::vector<firmware::CornerChange> changes_;
  std::vector<firmware::Succession> successions_;
  std::vector<std::uint32_t> removed_;
  std::vector<firmware::StoreVertex> added_;
  std::vector<std::uint32_t> wedges_;
  firmware::CollapseLog log_;
  std::vector<Face> faces_;
  std::vector<bool> alive_;
  std::vector<State> states_;
};

/// A chain in memory of its own.
struct BuiltChain {
  std::vector<std::uint32_t> words;
  std::uint32_t bytes = 0;
  firmware::LayerChainView view;
  Status status;
};

inline BuiltChain build_chain(const firmware::LayerChainInput& input, std::size_t words = 1u << 20) {
  BuiltChain chain;
  chain.words.resize(words);
  std::vector<std::byte> scratch(1u << 20);
  Arena arena(scratch);
  const auto bytes = firmware::build_layer_chain(input, arena, std::as_writable_bytes(std::span(chain.words)));
  chain.status = bytes.status();
  if (!bytes.ok()) return chain;
  chain.bytes = *bytes;
  const auto view =
      firmware::LayerChainView::open(std::as_bytes(std::span(chain.words)).first(*bytes), input.mesh);
  chain.status = view.status();
  if (view.ok()) chain.view = *view;
  return chain;
}

/// An index buffer with its replay.
struct Replayed {
  std::vector<std::uint32_t> words, live;
  firmware::LayerReplay replay;

  Replayed(const firmware::LayerChainView& chain, const Mesh& mesh, std::uint32_t index_bytes = 4)
      : words((3 * std::size_t{chain.face_count()} * index_bytes + 3) / 4),
        live(chain.group_count()),
        replay(chain, std::as_writable_bytes(std::span(words)), index_bytes, live) {
    replay.begin();
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) replay.set_face(f, &mesh.indices[3 * std::size_t{f}]);
  }

  Face face(std::uint32_t slot) const {
    return {replay.corner(3 * slot), replay.corner(3 * slot + 1), replay.corner(3 * slot + 2)};
  }
};

}  // namespace usuzumi::testing
