// No visible break of a seam until no other collapse is left: every step of the log is judged anew, by a classification
// of its own, on the mesh as it then was.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "firmware/simplify/collapse_rules.h"
#include "tests/firmware/simplify/half_edge/seamed_shapes.h"
#include "tests/firmware/simplify/half_edge/surface_fixture.h"
#include "tests/firmware/simplify/replay.h"

namespace usuzumi::testing {
namespace {

using firmware::CollapseLog;
using firmware::Corner;
using firmware::next_in_face;

using Place = std::array<float, 3>;
using Ends = std::pair<Place, Place>;
Place place_of(Vec3 p) { return {p.x, p.y, p.z}; }

// Seams by position, from nothing but the faces: what the claim calls IsSeam and IsCross.
class PlainSeams {
 public:
  explicit PlainSeams(const Mesh& mesh) {
    std::map<Ends, std::vector<std::set<std::pair<Place, std::pair<float, float>>>>> sides;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
        const auto corner = [&](std::uint32_t v) {
          const TexCoord c = mesh.texture_coordinates[v];
          return std::pair{place_of(mesh.positions[v]), std::pair{c.s, c.t}};
        };
        wedges_[corner(a).first].insert(corner(a).second);
        sides[ends(corner(a).first, corner(b).first)].push_back({corner(a), corner(b)});
        const Vec3 apex = mesh.positions[mesh.indices[i + (k + 2) % 3]];
        apexes_[ends(corner(a).first, corner(b).first)].push_back(place_of(apex));
      }
    }
    for (const auto& [edge, faces] : sides) {
      std::set<Place> differing;
      for (const auto& [place, wedge] : faces[0])
        if (faces.size() == 2 && !faces[1].contains({place, wedge})) differing.insert(place);
      if (differing.size() == 1) ends_at_.insert({edge, *differing.begin()});
      if (faces.size() == 2 && differing.size() < 2) continue;
      seam_edges_.insert(edge);
      ++count_[edge.first];
      ++count_[edge.second];
    }
  }
  bool is_seam(Place v) const { return count(v) > 0 || wedges_.at(v).size() > 1; }
  bool is_cross(Place v) const { return is_seam(v) && count(v) != 2; }
  bool is_seam(Place a, Place b) const { return seam_edges_.contains(ends(a, b)); }
  bool is_penalised(Place from, Place to) const {
    const auto end = ends_at_.find(ends(from, to));
    if (end != ends_at_.end() && end->second == to) return true;
    if (!is_seam(from)) return false;
    if (!is_seam(to) || is_cross(from) || !is_seam(from, to)) return true;
    for (const Place& apex : apexes_.at(ends(from, to)))  // the seam would fold onto itself
      if (is_seam(from, apex) && is_seam(to, apex)) return true;
    return false;
  }

 private:
  static Ends ends(Place a, Place b) { return a < b ? Ends{a, b} : Ends{b, a}; }
  int count(Place v) const { return count_.contains(v) ? count_.at(v) : 0; }

  std::map<Place, std::set<std::pair<float, float>>> wedges_;
  std::map<Ends, std::vector<Place>> apexes_;
  std::set<Ends> seam_edges_;
  std::map<Ends, Place> ends_at_;  // edges whose faces disagree at this end alone
  std::map<Place, int> count_;
};

// Is some collapse without a penalty allowed? `facing` is of the mesh as given.
bool something_free_is_allowed(const Mesh& now, const std::vector<PackedNormal>& facing,
                               const std::vector<std::uint32_t>& face_numbers) {
  const PlainSeams seams(now);
  TestSurface test(now);
  firmware::Surface& s = test.surface();
  for (std::uint32_t f = 0; f < s.face_count; ++f) s.set_facing(f * 4, facing[face_numbers[f]]);
  firmware::CollapseRules rules(s);
  for (std::uint32_t f = 0; f < s.face_count; ++f) {
    for (Corner c = f * 4; c < f * 4 + 3; ++c) {
      for (const bool forward : {true, false}) {
        firmware::Neighbourhood n;
        n.a = s.vertex_at(forward ? c : next_in_face(c));
        n.b = s.vertex_at(forward ? next_in_face(c) : c);
        if (seams.is_penalised(place_of(now.positions[n.a]), place_of(now.positions[n.b]))) continue;
        if (rules.keeps_topology(n) && !rules.turns_a_face(n, s.position(n.b))) return true;
      }
    }
  }
  return false;
}

struct Steps {
  std::size_t free = 0, penalised = 0;
};

Steps expect_free_collapses_first(const Mesh& mesh, std::uint32_t target) {
  RoomyLog room(mesh);
  const Thinned thinned =
      thin(mesh, {.target_faces = target, .method = firmware::Method::kHalfEdge, .log = &room.log});
  EXPECT_TRUE(thinned.status.ok());
  const CollapseLog& log = room.log;
  std::vector<PackedNormal> facing;
  {
    TestSurface given(mesh);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) facing.push_back(given.surface().facing(f * 4));
  }
  std::vector<std::uint32_t> corners = mesh.indices;
  Steps steps;
  std::uint32_t change = 0, succession = 0;
  for (std::uint32_t step = 0; step < log.steps().size(); ++step) {
    Mesh now = mesh;
    now.indices.clear();
    std::vector<std::uint32_t> face_numbers;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      if (log.removed_at()[f] < step) continue;
      face_numbers.push_back(f);
      now.indices.insert(now.indices.end(), {corners[3 * f], corners[3 * f + 1], corners[3 * f + 2]});
    }
    const firmware::Succession first = log.successions()[succession];
    if (PlainSeams(now).is_penalised(place_of(mesh.positions[first.from]), place_of(mesh.positions[first.to]))) {
      ++steps.penalised;
      EXPECT_FALSE(something_free_is_allowed(now, facing, face_numbers)) << "step " << step;
    } else {
      ++steps.free;
    }
    for (; change < log.steps()[step].change_end; ++change)
      corners[log.changes()[change].corner] = log.changes()[change].to;
    succession = log.steps()[step].succession_end;
  }
  return steps;
}

TEST(HalfEdgeOrder, NoSeamBreaksWhileAnotherCollapseIsAllowed) {
  Steps all;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const Steps steps = expect_free_collapses_first(ball_of_islands(2, 2 + seed, seed), 8);
    all.free += steps.free;
    all.penalised += steps.penalised;
  }
  EXPECT_GT(all.free, 100u) << "or the shapes test nothing";
  EXPECT_GT(all.penalised, 30u);
}

TEST(HalfEdgeOrder, ACubesSeamsOutlastItsSides) {
  const Steps steps = expect_free_collapses_first(joined(study::six_sided_cube(5)), 4);
  EXPECT_GE(steps.free, (300u - 12) / 2) << "down to the twelve faces of a cube";
}

TEST(HalfEdgeOrder, CheapestFirst) {
  const Mesh ball = ball_of_islands(3, 4, 11);
  RoomyLog room(ball);
  (void)thin(ball, {.target_faces = static_cast<std::uint32_t>(ball.face_count()) - 2,
                    .method = firmware::Method::kHalfEdge,
                    .log = &room.log});
  ASSERT_EQ(room.log.steps().size(), 1u);
  TestSurface test(ball);
  firmware::Surface& s = test.surface();
  firmware::CollapseRules rules(s);
  firmware::HalfEdge least;
  for (Corner c = 0; c < s.face_count * 4; ++c) {
    if ((c & 3) == 3 || (s.links[c] & firmware::kRepresentative) == 0) continue;
    for (const std::uint32_t refused : {firmware::kForwardRefused, firmware::kBackwardRefused}) {
      const firmware::HalfEdge h = test.costs.cheapest(c, refused);
      firmware::Neighbourhood n;
      n.a = h.from, n.b = h.to;
      if (h.key < least.key && rules.keeps_topology(n) && !rules.turns_a_face(n, s.position(n.b))) least = h;
    }
  }
  const firmware::Succession taken = room.log.successions()[0];
  EXPECT_EQ(test.vertex_of_wedge[taken.from], least.from);
  EXPECT_EQ(test.vertex_of_wedge[taken.to], least.to);
}

}  // namespace
}  // namespace usuzumi::testing
