#include "sim/pack/strip.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/pack/weld.h"

namespace usuzumi::sim {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// A face's side from -> to, as its winding runs.
struct DirectedEdge {
  std::uint32_t from = 0, to = 0, face = 0, opposite = 0;
};

class Stripper {
 public:
  Stripper(const Mesh& mesh, const PositionIds& ids) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const std::array<std::uint32_t, 3> f{ids.of_vertex[mesh.indices[i]], ids.of_vertex[mesh.indices[i + 1]],
                                           ids.of_vertex[mesh.indices[i + 2]]};
      if (f[0] != f[1] && f[1] != f[2] && f[2] != f[0]) faces_.push_back(f);
    }
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        edges_.push_back({faces_[f][k], faces_[f][(k + 1) % 3], f, faces_[f][(k + 2) % 3]});
    std::sort(edges_.begin(), edges_.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
      return a.from != b.from ? a.from < b.from : a.to != b.to ? a.to < b.to : a.face < b.face;
    });
    taken_by_.assign(faces_.size(), 0);
  }

  std::vector<std::uint32_t> strip() {
    std::vector<std::uint32_t> out;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (taken_by_[f] == kDone) continue;
      std::vector<std::uint32_t> best;
      std::size_t best_turn = 0;
      for (std::size_t turn = 0; turn < 3; ++turn) {
        std::vector<std::uint32_t> run = walk(f, turn, ++trial_);
        if (run.size() > best.size()) {
          best = std::move(run);
          best_turn = turn;
        }
      }
      walk(f, best_turn, kDone);
      join(out, best);
    }
    return out;
  }

 private:
  static constexpr std::uint32_t kDone = kNone;

  /// The longest run from face `f` turned by `turn`; its faces are marked as taken by `trial`.
  std::vector<std::uint32_t> walk(std::uint32_t f, std::size_t turn, std::uint32_t trial) {
    std::vector<std::uint32_t> run{faces_[f][turn], faces_[f][(turn + 1) % 3], faces_[f][(turn + 2) % 3]};
    taken_by_[f] = trial;
    for (;;) {
      const std::uint32_t a = run[run.size() - 2], b = run[run.size() - 1];
      // The next face is number run.size() - 2 of the strip; an odd one is wound (b, a, next).
      const bool odd = run.size() % 2 == 1;
      const DirectedEdge* next = free_edge(odd ? b : a, odd ? a : b, trial);
      if (next == nullptr) return run;
      taken_by_[next->face] = trial;
      run.push_back(next->opposite);
    }
  }

  /// The first face with the side from -> to that is neither done nor in this trial's run.
  const DirectedEdge* free_edge(std::uint32_t from, std::uint32_t to, std::uint32_t trial) const {
    auto at = std::lower_bound(
        edges_.begin(), edges_.end(), DirectedEdge{from, to, 0, 0},
        [](const DirectedEdge& a, const DirectedEdge& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; });
    for (; at != edges_.end() && at->from == from && at->to == to; ++at)
      if (taken_by_[at->face] != kDone && taken_by_[at->face] != trial) return &*at;
    return nullptr;
  }

  /// Appends `run` behind faces without area, so that its first face has an even number and keeps its winding.
  static void join(std::vector<std::uint32_t>& out, const std::vector<std::uint32_t>& run) {
    if (!out.empty()) {
      out.push_back(out.back());
      out.push_back(run.front());
      if (out.size() % 2 == 1) out.push_back(run.front());
    }
    out.insert(out.end(), run.begin(), run.end());
  }

  std::vector<std::array<std::uint32_t, 3>> faces_;
  std::vector<DirectedEdge> edges_;      // sorted by from, to, face
  std::vector<std::uint32_t> taken_by_;  // per face: the trial that walked over it last, or kDone
  std::uint32_t trial_ = 0;
};

}  // namespace

std::vector<Vec3> triangle_strip(const Mesh& mesh) {
  const PositionIds ids = number_positions(mesh.positions);
  std::vector<Vec3> out;
  for (std::uint32_t id : Stripper(mesh, ids).strip()) out.push_back(mesh.positions[ids.first_vertex[id]]);
  return out;
}

}  // namespace usuzumi::sim
