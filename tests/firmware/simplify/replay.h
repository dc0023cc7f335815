// A log of collapses followed step by step, and what it must agree with.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "firmware/simplify/collapse_log.h"
#include "tests/firmware/simplify/simplify_fixture.h"

namespace usuzumi::testing {

/// Room for any log of a mesh, and the log.
struct RoomyLog {
  std::vector<firmware::CollapseStep> steps;
  std::vector<firmware::CornerChange> changes;
  std::vector<firmware::Succession> successions;
  std::vector<std::uint32_t> removed_at, store_of_wedge;
  std::vector<firmware::StoreVertex> added;
  firmware::CollapseLog log;

  explicit RoomyLog(const Mesh& mesh, std::size_t entries = 1u << 18)
      : steps(mesh.face_count() + 1), changes(entries), successions(entries), removed_at(mesh.face_count()),
        store_of_wedge(mesh.positions.size()), added(entries),
        log({steps, changes, successions, removed_at, added, store_of_wedge},
            static_cast<std::uint32_t>(mesh.positions.size()), static_cast<std::uint32_t>(mesh.face_count())) {}
};

/// One corner as a viewer sees it: where, and with which attributes.
struct SeenCorner {
  Vec3 position;
  std::uint32_t normal = 0, colour = 0;
  TexCoord texture_coordinate;
  friend bool operator==(const SeenCorner&, const SeenCorner&) = default;
};
using SeenFace = std::array<SeenCorner, 3>;

inline SeenCorner seen_vertex(const Mesh& mesh, std::size_t v) {
  return {mesh.positions[v], mesh.normals.empty() ? 0 : mesh.normals[v].bits,
          mesh.colours.empty() ? 0 : mesh.colours[v].bits,
          mesh.texture_coordinates.empty() ? TexCoord{} : mesh.texture_coordinates[v]};
}

/// `given` with every step of `log` applied to its index buffer must be `thinned`, face for face; and the log must be
/// sound in itself: a corner changes from what it named, faces end with their step, a vertex is succeeded once, and
/// every vertex's line of successors ends at one that stays.
inline void expect_replay_gives(const Mesh& given, const firmware::CollapseLog& log, const Mesh& thinned) {
  ASSERT_FALSE(log.full());
  std::vector<SeenCorner> store;
  for (std::size_t v = 0; v < given.positions.size(); ++v) store.push_back(seen_vertex(given, v));
  for (const firmware::StoreVertex& v : log.added())
    store.push_back({v.position, given.normals.empty() ? 0 : v.normal.bits, given.colours.empty() ? 0 : v.colour.bits,
                     v.texture_coordinate});
  std::vector<std::uint32_t> corners = given.indices;
  std::vector<std::uint32_t> heirs(store.size(), 0xFFFFFFFFu);
  std::size_t change = 0, succession = 0;
  const auto steps = log.steps();
  for (std::size_t step = 0; step < steps.size(); ++step) {
    for (; change < steps[step].change_end; ++change) {
      const firmware::CornerChange& c = log.changes()[change];
      ASSERT_LT(c.corner, corners.size());
      ASSERT_LT(c.to, store.size());
      // The same number, or one that welding made equal.
      ASSERT_TRUE(corners[c.corner] == c.from || store[corners[c.corner]] == store[c.from]) << "step " << step;
      corners[c.corner] = c.to;
    }
    for (; succession < steps[step].succession_end; ++succession) {
      const firmware::Succession& s = log.successions()[succession];
      ASSERT_LT(s.from, store.size());
      ASSERT_LT(s.to, store.size());
      ASSERT_EQ(heirs[s.from], 0xFFFFFFFFu) << "vertex " << s.from << " is gone twice";
      heirs[s.from] = s.to;
    }
    const auto left = static_cast<std::size_t>(
        std::count_if(log.removed_at().begin(), log.removed_at().end(), [&](std::uint32_t at) { return at > step; }));
    ASSERT_EQ(steps[step].faces_after, left) << "step " << step;
  }
  EXPECT_EQ(change, log.changes().size());
  EXPECT_EQ(succession, log.successions().size());

  std::vector<SeenFace> replayed, expected;
  for (std::size_t f = 0; f < given.face_count(); ++f) {
    if (log.removed_at()[f] != firmware::CollapseLog::kNeverRemoved) continue;
    replayed.push_back({store[corners[3 * f]], store[corners[3 * f + 1]], store[corners[3 * f + 2]]});
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(heirs[corners[3 * f + k]], 0xFFFFFFFFu) << "a live corner's is gone";
  }
  for (std::size_t f = 0; f < thinned.face_count(); ++f)
    expected.push_back({seen_vertex(thinned, thinned.indices[3 * f]), seen_vertex(thinned, thinned.indices[3 * f + 1]),
                        seen_vertex(thinned, thinned.indices[3 * f + 2])});
  ASSERT_EQ(replayed.size(), expected.size());
  for (std::size_t f = 0; f < replayed.size(); ++f) EXPECT_TRUE(replayed[f] == expected[f]) << "face " << f;
  for (std::size_t v = 0; v < heirs.size(); ++v) {
    std::uint32_t end = static_cast<std::uint32_t>(v);
    for (std::size_t hops = 0; heirs[end] != 0xFFFFFFFFu; ++hops) {
      ASSERT_LT(hops, heirs.size()) << "successions go round";
      end = heirs[end];
    }
  }
}

/// The steps of `log` from the thinned corners back to the given ones: every change must name what is there.
inline void expect_undoing_gives(const Mesh& given, const firmware::CollapseLog& log) {
  std::vector<std::uint32_t> corners = given.indices;
  for (const firmware::CornerChange& c : log.changes()) corners[c.corner] = c.to;
  for (std::size_t i = log.changes().size(); i-- > 0;) {
    const firmware::CornerChange& c = log.changes()[i];
    ASSERT_EQ(corners[c.corner], c.to) << "change " << i;
    corners[c.corner] = c.from;
  }
  for (std::size_t c = 0; c < corners.size(); ++c)  // or one that welding made equal
    ASSERT_TRUE(seen_vertex(given, corners[c]) == seen_vertex(given, given.indices[c])) << "corner " << c;
}

}  // namespace usuzumi::testing
