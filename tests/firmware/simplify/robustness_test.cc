// Any input, any amount of scratch, by every method: the result is sound, repeatable, or the mesh is as it was.
#include "tests/firmware/simplify/robustness.h"

#include <ostream>
#include <string>

#include "tests/firmware/simplify/replay.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

struct Subject {
  const char* name;
  Method method;
  std::size_t alignment;  // of its arrays, and so the room that its scratch has for the arena's start
};
constexpr Subject kSubjects[] = {{"Qem", Method::kQem, 16},
                                 {"EdgeRemoval", Method::kEdgeRemoval, 16},
                                 {"HalfEdge", Method::kHalfEdge, 64},
                                 {"VertexDeletion", Method::kVertexDeletion, 16}};
void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.name; }

class Robustness : public ::testing::TestWithParam<Subject> {
 protected:
  /// A method's settings turn with the seed; the others' do not count.
  static SimplifyOptions options_of(unsigned seed, std::uint32_t target) {
    constexpr float kLimits[] = {0, 1, 1e-2f};
    SimplifyOptions options{.target_faces = target, .method = GetParam().method};
    options.placement = seed % 7 == 0 ? Placement::kMidpoint : Placement::kOptimal;
    options.edge_removal.placement = static_cast<EdgePlacement>(seed % 5);
    options.edge_removal.boundary_answer = static_cast<BoundaryAnswer>(seed / 5 % 2);
    options.edge_removal.boundary_limit = kLimits[seed / 5 % 3];
    options.edge_removal.neighbour_weight = seed % 4 == 0 ? 0.5f : 0.0f;
    return options;
  }
  static std::size_t scratch_of(const Mesh& mesh) {
    return static_cast<std::size_t>(simplify_scratch_bytes(
        GetParam().method, static_cast<std::uint32_t>(mesh.positions.size()),
        static_cast<std::uint32_t>(mesh.face_count()), !mesh.texture_coordinates.empty()));
  }
};

INSTANTIATE_TEST_SUITE_P(Of, Robustness, ::testing::ValuesIn(kSubjects),
                         [](const auto& tested) { return std::string(tested.param.name); });

Mesh textured_patches() {
  Mesh mesh = with_flat_normals(icosphere(2));
  for (const Vec3 p : mesh.positions) mesh.texture_coordinates.push_back({p.x, p.y});
  return mesh;
}

void expect_same(const Mesh& mesh, const Mesh& expected) {
  ASSERT_EQ(mesh.positions, expected.positions);
  ASSERT_EQ(mesh.normals, expected.normals);
  ASSERT_EQ(mesh.colours, expected.colours);
  ASSERT_EQ(mesh.texture_coordinates, expected.texture_coordinates);
  ASSERT_EQ(mesh.indices, expected.indices);
}

TEST_P(Robustness, SoupsStaySoundAndTheirLogsReplay) {
  std::size_t collapses = 0;
  for (unsigned seed = 1; seed <= 600; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = soup(seed);
    const auto target = static_cast<std::uint32_t>(seed % 5 * mesh.face_count() / 6);
    SimplifyOptions options = options_of(seed, target);
    const Thinned thinned = thin(mesh, options);
    expect_sound(mesh, thinned, target);
    RoomyLog room(mesh, 1u << 12);
    options.log = &room.log;
    const Thinned again = thin(mesh, options);
    expect_same(again.mesh, thinned.mesh);
    EXPECT_EQ(again.outcome.work.edges_costed, thinned.outcome.work.edges_costed);
    EXPECT_EQ(room.log.steps().size(), again.outcome.work.collapses);
    expect_replay_gives(mesh, room.log, again.mesh);
    collapses += again.outcome.work.collapses;
  }
  EXPECT_GT(collapses, 10u) << "hardly anything of a soup may go, but something";
}

TEST_P(Robustness, CrumpledSurfacesStaySoundAndTheirLogsReplay) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = crumpled_ball(seed);
    SimplifyOptions options = options_of(seed, 60);
    RoomyLog room(mesh, 1u << 14);
    options.log = &room.log;
    const Thinned thinned = thin(mesh, options);
    expect_sound(mesh, thinned, 60);
    EXPECT_LE(topology_of(thinned.mesh).border_edges, topology_of(mesh).border_edges);
    expect_replay_gives(mesh, room.log, thinned.mesh);
    EXPECT_GT(thinned.outcome.work.collapses, 30u);
  }
}

TEST_P(Robustness, TooLittleScratchLeavesTheMeshAsItWas) {
  const Mesh mesh = textured_patches();
  const std::size_t need = scratch_of(mesh), slack = GetParam().alignment;
  // The last bytes are room for the alignment of the arena's start.
  for (std::size_t bytes = 1; bytes + slack < need; bytes += bytes < 64 || bytes + slack + 64 > need ? 1 : 369) {
    const Thinned thinned = thin(mesh, options_of(1, 20), bytes);
    ASSERT_EQ(thinned.status.code, StatusCode::kResourceExhausted) << bytes;
    ASSERT_EQ(thinned.scratch_used, 0u);
    expect_same(thinned.mesh, mesh);
  }
  EXPECT_TRUE(thin(mesh, options_of(1, 20)).status.ok());
}

TEST_P(Robustness, ScratchIsGivenBackWhateverItHeldAndWhereverItBegan) {
  for (const Mesh& mesh : {textured_patches(), icosphere(3)}) {  // three vertices a face, and half of one
    const SimplifyOptions options = options_of(5, 100);
    const Thinned expected = thin(mesh, options);
    const std::size_t need = scratch_of(mesh), alignment = GetParam().alignment;
    for (const std::size_t misalignment : {std::size_t{0}, std::size_t{1}, std::size_t{7}, alignment - 1}) {
      for (const unsigned fill : {0x00u, 0x3Fu, 0xA5u, 0xFFu}) {
        std::vector<std::byte> memory(need + misalignment, static_cast<std::byte>(fill));
        Arena scratch(memory);
        (void)scratch.allocate<std::byte>(misalignment);
        const Thinned thinned = thin_in(scratch, mesh, options);
        ASSERT_TRUE(thinned.status.ok()) << misalignment;
        EXPECT_EQ(scratch.used(), misalignment);
        EXPECT_GE(scratch.high_water() + 2 * alignment, need) << "the bound is tight";
        expect_same(thinned.mesh, expected.mesh);
      }
    }
  }
}

TEST_P(Robustness, AFullLogIsAnErrorAndLeavesAWholeMesh) {
  const Mesh mesh = icosphere(2);
  for (std::size_t entries = 0; entries < 100; entries += 7) {
    RoomyLog room(mesh, entries);
    SimplifyOptions options = options_of(0, 20);
    options.log = &room.log;
    const Thinned thinned = thin(mesh, options);
    EXPECT_EQ(thinned.status.code, StatusCode::kResourceExhausted) << entries;
    EXPECT_TRUE(room.log.full());
    EXPECT_GT(thinned.mesh.face_count(), 20u);
    EXPECT_EQ(topology_of(thinned.mesh).euler(), 2);
  }
}

TEST_P(Robustness, NothingAndNothingToDoAreDone) {
  const Thinned empty = thin(Mesh{}, options_of(0, 0));
  EXPECT_TRUE(empty.status.ok());
  EXPECT_EQ(empty.mesh.face_count(), 0u);
  Mesh points;
  points.positions = {{1, 1, 1}, {1, 1, 1}, {2, 2, 2}};
  points.indices = {0, 1, 2, 0, 0, 0};
  EXPECT_EQ(thin(points, options_of(0, 0)).mesh.face_count(), 0u);
  const Mesh mesh = icosphere(0);
  const Thinned same = thin(mesh, options_of(0, 20));
  expect_same(same.mesh, mesh);
  EXPECT_EQ(same.outcome.work.collapses, 0u);
}

TEST_P(Robustness, ALastFaceStays) {
  for (const float height : {1.0f, 0.0f}) {  // or three points on a line: a face without area
    Mesh triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {2, height, 0}};
    triangle.indices = {0, 1, 2, 0, 0, 1};
    const Thinned one = thin(triangle, options_of(0, 0));
    EXPECT_EQ(one.mesh.face_count(), 1u);
    EXPECT_EQ(one.outcome.stop, StopReason::kNoCollapseAllowed);
  }
}

}  // namespace
}  // namespace usuzumi::testing
