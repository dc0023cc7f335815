// What the recorder tells is the whole of what collapses did: followed step by step it gives the thinned mesh.
#include "firmware/simplify/log_recorder.h"

#include <gtest/gtest.h>

#include <random>

#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/initial_quadrics.h"
#include "firmware/simplify/weld.h"
#include "tests/firmware/simplify/replay.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

// Edges in random order, each to its middle, until `target` faces are left or none of a round may go: the smallest
// method there is.
Mesh thinned_at_random(const Mesh& given, std::uint32_t target, unsigned seed, CollapseLog& log) {
  Mesh mesh = given;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size()),
             faces = static_cast<std::uint32_t>(mesh.face_count());
  std::vector<std::uint32_t> vertex_of_wedge(vertices), table(weld_table_slots(vertices)), links(faces * 4);
  std::vector<Place> places(vertices);
  std::vector<Vertex> vertex_data(vertices);
  WorkingMesh working{.positions = mesh.positions,
                      .normals = mesh.normals,
                      .colours = mesh.colours,
                      .texture_coordinates = mesh.texture_coordinates,
                      .indices = mesh.indices,
                      .vertex_count = vertices,
                      .face_count = faces};
  WorkingSurface surface;
  build_surface(working, {vertex_of_wedge, table, places, vertex_data, links}, surface);
  set_initial_quadrics(surface.surface);
  CollapseRules rules(surface.surface);
  LogRecorder recorder(&log, surface);
  recorder.begin();
  std::mt19937 random(seed);
  std::uint32_t left = surface.live_faces;
  for (std::uint32_t tries = faces * 40; left > target && tries > 0 && !recorder.full(); --tries) {
    const auto face = static_cast<std::uint32_t>(random() % faces);
    const Corner edge = face * 4 + static_cast<Corner>(random() % 3);
    if (surface.surface.is_dead(face)) continue;
    Neighbourhood n;
    n.a = surface.surface.vertex_at(edge);
    n.b = surface.surface.vertex_at(next_in_face(edge));
    const Vec3 middle = (surface.surface.position(n.a) + surface.surface.position(n.b)) * 0.5f;
    if (!rules.keeps_topology(n) || rules.turns_a_face(n, middle)) continue;
    const std::uint32_t singular = (places[n.a].mark | places[n.b].mark) & kSingular;
    const CollapsedEdge collapsed = collapse_edge(surface.surface, surface.seam_map, surface.attributes, n, {});
    places[collapsed.vertex].position = middle;
    places[collapsed.vertex].mark |= singular;
    left -= collapsed.faces_removed;
    recorder.record(collapsed);
  }
  write_surface(working, surface);
  mesh.positions.resize(working.vertex_count);
  if (!mesh.normals.empty()) mesh.normals.resize(working.vertex_count);
  if (!mesh.colours.empty()) mesh.colours.resize(working.vertex_count);
  if (!mesh.texture_coordinates.empty()) mesh.texture_coordinates.resize(working.vertex_count);
  mesh.indices.resize(std::size_t{working.face_count} * 3);
  return mesh;
}

void expect_recorded(const Mesh& mesh, std::uint32_t target, unsigned seed) {
  RoomyLog room(mesh);
  const Mesh thinned = thinned_at_random(mesh, target, seed, room.log);
  EXPECT_LT(thinned.face_count(), mesh.face_count());
  expect_replay_gives(mesh, room.log, thinned);
}

TEST(LogRecorder, ReplayOfABareMeshGivesTheThinnedOne) { expect_recorded(icosphere(3), 100, 1); }

TEST(LogRecorder, ReplayKeepsEveryWedgeApart) {
  expect_recorded(with_flat_normals(icosphere(3)), 100, 2);
  expect_recorded(with_flat_normals(cube(5)), 40, 3);
}

TEST(LogRecorder, ReplayOfSeamsAndDegenerateFacesGivesTheThinnedMesh) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Mesh mesh = with_flat_normals(icosphere(2));
    mesh.normals.clear();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      mesh.texture_coordinates.push_back({static_cast<float>(random() % 2), 0});
    for (int i = 0; i < 6; ++i) mesh.indices[(random() % mesh.face_count()) * 3] = mesh.indices[3 * (random() % 9) + 1];
    for (int i = 0; i < 2; ++i) {
      const std::size_t face = random() % mesh.face_count();
      mesh.indices[3 * face] = mesh.indices[3 * face + 1];
    }
    expect_recorded(mesh, 60, seed);
  }
}

TEST(LogRecorder, OneCollapseIsToldAsItWas) {
  //   4---1---3
  //    \ 0|\ 2|\ 3         faces 0: 4 0 1, 1: 0 2 1, 2: 2 3 1, 3: 2 5 3, 4: 2 6 5; the edge from 3 to 5 goes to its
  //     \ |1\ | \          middle, face 3 with it
  //      \0---2--5
  //            \4|
  //              6
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {3, 0, 0}, {3, -1, 0}};
  mesh.indices = {4, 0, 1, 0, 2, 1, 2, 3, 1, 2, 5, 3, 2, 6, 5};
  RoomyLog room(mesh);
  WorkingMesh working{.positions = mesh.positions, .indices = mesh.indices, .vertex_count = 7, .face_count = 5};
  std::vector<std::uint32_t> vertex_of_wedge(7), table(weld_table_slots(7)), links(20);
  std::vector<Place> places(7);
  std::vector<Vertex> vertices(7);
  WorkingSurface surface;
  build_surface(working, {vertex_of_wedge, table, places, vertices, links}, surface);
  LogRecorder recorder(&room.log, surface);
  recorder.begin();
  Neighbourhood n;
  n.a = 3, n.b = 5;
  set_initial_quadrics(surface.surface);
  ASSERT_TRUE(CollapseRules(surface.surface).keeps_topology(n));
  const CollapsedEdge collapsed = collapse_edge(surface.surface, surface.seam_map, surface.attributes, n, {});
  surface.surface.places[collapsed.vertex].position = Vec3{2.5f, 0.5f, 0} * surface.scale;
  recorder.record(collapsed);
  ASSERT_EQ(room.log.steps().size(), 1u);
  EXPECT_EQ(room.log.steps()[0].faces_after, 4u);
  ASSERT_EQ(room.log.added().size(), 1u);
  EXPECT_EQ(room.log.added()[0].position, (Vec3{2.5f, 0.5f, 0}));
  ASSERT_EQ(room.log.changes().size(), 2u);
  const CornerChange at_kept = room.log.changes()[0], at_removed = room.log.changes()[1];
  EXPECT_EQ(at_kept.corner, 7u) << "face 2's second";
  EXPECT_EQ(at_kept.from, 3u);
  EXPECT_EQ(at_kept.to, 7u);
  EXPECT_EQ(at_removed.corner, 14u) << "face 4's third";
  EXPECT_EQ(at_removed.from, 5u);
  EXPECT_EQ(at_removed.to, 7u);
  ASSERT_EQ(room.log.successions().size(), 2u);
  EXPECT_EQ(room.log.successions()[0].from, 3u);
  EXPECT_EQ(room.log.successions()[0].to, 7u);
  EXPECT_EQ(room.log.successions()[1].from, 5u);
  EXPECT_EQ(room.log.successions()[1].to, 7u);
  EXPECT_EQ(room.log.removed_at()[3], 0u);
  for (const std::size_t stays : {0u, 1u, 2u, 4u})
    EXPECT_EQ(room.log.removed_at()[stays], CollapseLog::kNeverRemoved);
}

TEST(LogRecorder, AFullLogSaysSoAndNothingIsWrittenBeyondIt) {
  const Mesh mesh = icosphere(2);
  for (std::size_t entries = 0; entries < 60; ++entries) {
    RoomyLog room(mesh, entries);
    (void)thinned_at_random(mesh, 20, 5, room.log);
    EXPECT_TRUE(room.log.full()) << entries;
  }
}

}  // namespace
}  // namespace usuzumi::testing
