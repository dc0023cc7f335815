// The firmware's own methods: what a chain's last state is, is what the method alone makes.
#include "firmware/drawing_data/mesh_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <vector>

#include "firmware/layers/middle_layer.h"
#include "tests/firmware/layers/hand_log.h"
#include "tests/support/indexed_view.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/seen_faces.h"

namespace usuzumi {
namespace {

using firmware::LayerChainView;
using firmware::MeshView;
using firmware::Method;

constexpr std::uint32_t kQuotas[] = {1'000'000, 600'000, 360'000, 216'000};
constexpr std::uint32_t kFarQuotas[] = {1'000'000, 300'000, 100'000, 30'000};

/// A body with a seam, two attributes that differ on its sides, and normals that are sharp at its edges.
testing::Mesh body() {
  testing::Mesh mesh = testing::with_flat_normals(testing::cube(8));
  std::vector<std::array<std::uint32_t, 6>> known;
  testing::Mesh joined;
  for (const std::uint32_t v : mesh.indices) {
    const Vec3 p = mesh.positions[v];
    const PackedNormal n = mesh.normals[v];
    std::array<std::uint32_t, 6> key{};
    std::memcpy(key.data(), &p, 12);
    key[3] = n.bits;
    const auto at = std::find(known.begin(), known.end(), key);
    joined.indices.push_back(static_cast<std::uint32_t>(at - known.begin()));
    if (at != known.end()) continue;
    known.push_back(key);
    joined.positions.push_back(p);
    joined.normals.push_back(n);
    const auto green = static_cast<std::uint32_t>(p.x * 30);
    joined.colours.push_back(n.bits % 3 == 0 ? rgba8(200, 20, 20) : rgba8(20, green, 200));
    joined.texture_coordinates.push_back({p.x / 8 + static_cast<float>(n.bits % 5), p.y / 8});
  }
  return joined;
}

/// A ball of charts: every face of a coarse one has texture coordinates and a normal of its own, so that thinning comes
/// to faces that alone name some wedge of their corners.
testing::Mesh charted_ball() {
  const testing::Mesh coarse = testing::icosphere(1);
  testing::Mesh mesh;
  for (std::uint32_t chart = 0; chart < coarse.face_count(); ++chart) {
    testing::Mesh part;
    part.indices = {0, 1, 2};
    Vec3 middle;
    for (std::size_t k = 0; k < 3; ++k) {
      part.positions.push_back(coarse.positions[coarse.indices[3 * chart + k]]);
      middle = middle + part.positions[k];
    }
    part = testing::subdivided(testing::subdivided(part));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3& p : part.positions) {
      const Vec3 on_ball = normalized(p);
      mesh.positions.push_back(on_ball * (1 + 0.1f * on_ball.x * on_ball.y));
      mesh.normals.push_back(pack_normal(normalized(middle)));
      mesh.colours.push_back(rgba8(chart * 3, 255 - chart * 3, 128));
      mesh.texture_coordinates.push_back({p.x + static_cast<float>(chart), p.y});
    }
    for (const std::uint32_t v : part.indices) mesh.indices.push_back(first + v);
  }
  return mesh;
}

/// A globe: at its poles and along one meridian positions repeat with texture coordinates of their own, those of the
/// poles in one face each. A bump makes collapses differ in cost; without, they are taken by number.
testing::Mesh globe(float bump) {
  constexpr std::uint32_t kMeridians = 16, kParallels = 9;
  constexpr float kPi = 3.14159265f;
  testing::Mesh mesh;
  const auto add = [&](Vec3 on_ball, float s, float t) {
    mesh.positions.push_back(on_ball * (1 + bump * on_ball.x * on_ball.y));
    mesh.normals.push_back(pack_normal(on_ball));
    mesh.texture_coordinates.push_back({s, t});
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  for (std::uint32_t j = 1; j <= kParallels; ++j) {
    const float t = static_cast<float>(j) / (kParallels + 1), latitude = kPi * (t - 0.5f);
    for (std::uint32_t i = 0; i <= kMeridians; ++i) {
      const float longitude = static_cast<float>(i % kMeridians) * 2 * kPi / kMeridians;
      add({std::cos(latitude) * std::cos(longitude), std::sin(latitude), std::cos(latitude) * std::sin(longitude)},
          static_cast<float>(i) / kMeridians, t);
    }
  }
  const auto at = [](std::uint32_t j, std::uint32_t i) { return j * (kMeridians + 1) + i; };
  for (std::uint32_t i = 0; i < kMeridians; ++i) {
    for (std::uint32_t j = 0; j + 1 < kParallels; ++j)
      for (const std::uint32_t v : {at(j, i), at(j + 1, i), at(j, i + 1), at(j, i + 1), at(j + 1, i), at(j + 1, i + 1)})
        mesh.indices.push_back(v);
    const float middle = (static_cast<float>(i) + 0.5f) / kMeridians;
    const std::uint32_t south = add({0, -1, 0}, middle, 0), north = add({0, 1, 0}, middle, 1), top = kParallels - 1;
    for (const std::uint32_t v : {south, at(0, i), at(0, i + 1), north, at(top, i + 1), at(top, i)})
      mesh.indices.push_back(v);
  }
  mesh.colours.assign(mesh.positions.size(), rgba8(255, 255, 255));
  return mesh;
}

using Corner = testing::SeenCorner;
using Picture = testing::SeenFaceSet;
using testing::add_face;
using testing::corner_of;
using testing::indexed_view;

class MeshLayers : public ::testing::TestWithParam<Method> {
 protected:
  MeshLayers() : MeshLayers(body(), kQuotas) {}
  MeshLayers(const testing::Mesh& mesh, std::span<const std::uint32_t> quotas)
      : mesh_(mesh), view_(indexed_view(mesh_, GetParam())), faces_(view_.proper_face_count()) {
    memory_.resize(firmware::mesh_layers_bytes(view_, faces_));
    arena_ = Arena(memory_);
    const auto made = firmware::make_mesh_layers(view_, faces_, quotas, firmware::Placement::kOptimal, arena_);
    status_ = made.status();
    if (!made.ok()) return;
    view_.layers = *made;
    chain_ = LayerChainView::of_checked(*made);
    positions_.resize(chain_.store_count());
    normals_.resize(positions_.size());
    colours_.resize(positions_.size());
    coordinates_.resize(positions_.size());
    firmware::write_store(chain_, {mesh_.positions, mesh_.normals, mesh_.colours, mesh_.texture_coordinates},
                          {positions_, normals_, colours_, coordinates_});
  }

  Picture replayed(std::uint32_t step) {
    std::vector<std::uint32_t> indices(3 * faces_), live(1);
    firmware::LayerReplay replay(chain_, std::as_writable_bytes(std::span(indices)), 4, live);
    firmware::begin_replay(view_, replay);
    EXPECT_TRUE(replay.check().ok());
    replay.go_to(step);
    Picture picture;
    for (std::uint32_t f = 0; f < replay.faces(); ++f) {
      std::array<Corner, 3> face;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = indices[3 * f + k];
        face[k] = corner_of(positions_[v], normals_[v], colours_[v], coordinates_[v]);
      }
      add_face(picture, face);
    }
    return picture;
  }

  Picture thinned(std::uint32_t target) {
    testing::Mesh work = mesh_;
    firmware::WorkingMesh working;
    working.positions = work.positions;
    working.normals = work.normals;
    working.colours = work.colours;
    working.texture_coordinates = work.texture_coordinates;
    working.indices = work.indices;
    working.vertex_count = static_cast<std::uint32_t>(work.positions.size());
    working.face_count = faces_;
    std::vector<std::byte> memory(8u << 20);
    Arena arena(memory);
    firmware::SimplifyOptions options;
    options.target_faces = target;
    options.method = GetParam();
    options.for_layers = true;
    EXPECT_TRUE(firmware::simplify(working, options, arena).ok());
    Picture picture;
    for (std::uint32_t f = 0; f < working.face_count; ++f) {
      std::array<Corner, 3> face;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = working.indices[3 * f + k];
        face[k] =
            corner_of(working.positions[v], working.normals[v], working.colours[v], working.texture_coordinates[v]);
      }
      add_face(picture, face);
    }
    return picture;
  }

  void expect_no_hole_between_layers();
  void expect_each_end_to_be_the_next_layer();

  testing::Mesh mesh_;
  MeshView view_;
  std::uint32_t faces_;
  std::vector<std::byte> memory_;
  Arena arena_;
  Status status_;
  LayerChainView chain_;
  std::vector<Vec3> positions_;
  std::vector<PackedNormal> normals_;
  std::vector<Rgba8> colours_;
  std::vector<TexCoord> coordinates_;
};


TEST_P(MeshLayers, EveryLayerIsWhatTheMethodAloneMakes) {
  ASSERT_TRUE(status_.ok()) << status_.message << " " << status_.where;
  ASSERT_EQ(chain_.layer_count(), 4u);
  for (std::uint32_t n = 0; n < 4; ++n) {
    const auto& layer = chain_.layer(n);
    const Picture alone = thinned(layer.faces), from_chain = replayed(layer.step);
    EXPECT_EQ(alone.size(), from_chain.size()) << "layer " << n;
    EXPECT_TRUE(alone == from_chain) << "layer " << n;
  }
}

TEST_P(MeshLayers, AtItsEndAMiddleLayerIsTheNextLayer) { expect_each_end_to_be_the_next_layer(); }

void MeshLayers::expect_each_end_to_be_the_next_layer() {
  ASSERT_TRUE(status_.ok()) << status_.message;
  const firmware::VertexStreams given{mesh_.positions, mesh_.normals, mesh_.colours, mesh_.texture_coordinates};
  for (std::uint32_t n = 0; n + 1 < chain_.layer_count(); ++n) {
    const Picture next = replayed(chain_.layer(n + 1).step);
    firmware::write_middle_layer(chain_, given, n, 1, {positions_, normals_, colours_, coordinates_});
    Picture end;  // of the faces that have not shrunk to nothing
    for (const auto& face : replayed(chain_.layer(n).step)) {
      const auto place = [&](std::size_t k) { return std::vector(face[k].begin(), face[k].begin() + 3); };
      if (place(0) != place(1) && place(1) != place(2) && place(2) != place(0)) end.insert(face);
    }
    EXPECT_EQ(end.size(), chain_.layer(n + 1).faces);
    EXPECT_TRUE(end == next) << "layer " << n;
    firmware::write_middle_layer(chain_, given, n, 0, {positions_, normals_, colours_, coordinates_});
  }
}

TEST_P(MeshLayers, TheChainAloneStaysInTheArena) {
  ASSERT_TRUE(status_.ok());
  EXPECT_EQ(arena_.used(), view_.layers.size() + static_cast<std::size_t>(view_.layers.data() - memory_.data()));
  EXPECT_TRUE(firmware::check_mesh_layers(view_).ok());
  EXPECT_LT(view_.layers.data() - memory_.data(), 4);
}

TEST_P(MeshLayers, TooLittleMemoryIsSaidAndNothingIsKept) {
  std::size_t refused = 0;
  for (std::size_t bytes = 0; bytes < arena_.high_water(); bytes += arena_.high_water() / 50) {
    const std::span<std::byte> few = std::span(memory_).first(bytes);
    Arena small(few);
    const auto made = firmware::make_mesh_layers(view_, faces_, kQuotas, firmware::Placement::kOptimal, small);
    if (made.ok()) continue;
    ++refused;
    EXPECT_EQ(made.status().code, StatusCode::kResourceExhausted) << made.status().message;
    EXPECT_EQ(small.used(), 0u);
  }
  EXPECT_GT(refused, 25u);
}

class ChartLayers : public MeshLayers {
 protected:
  ChartLayers() : MeshLayers(charted_ball(), kFarQuotas) {}
};

class GlobeLayers : public MeshLayers {
 protected:
  GlobeLayers() : MeshLayers(globe(0.1f), kFarQuotas) {}
};

class RoundGlobeLayers : public MeshLayers {
 protected:
  RoundGlobeLayers() : MeshLayers(globe(0), kQuotas) {}
};

TEST_P(GlobeLayers, MiddleLayersOpenNoHole) { expect_no_hole_between_layers(); }
TEST_P(GlobeLayers, AtItsEndAMiddleLayerIsTheNextLayer) { expect_each_end_to_be_the_next_layer(); }
TEST_P(RoundGlobeLayers, MiddleLayersOpenNoHole) { expect_no_hole_between_layers(); }
TEST_P(RoundGlobeLayers, AtItsEndAMiddleLayerIsTheNextLayer) { expect_each_end_to_be_the_next_layer(); }
TEST_P(ChartLayers, AtItsEndAMiddleLayerIsTheNextLayer) { expect_each_end_to_be_the_next_layer(); }
TEST_P(ChartLayers, MiddleLayersOpenNoHole) { expect_no_hole_between_layers(); }
TEST_P(MeshLayers, MiddleLayersOpenNoHole) { expect_no_hole_between_layers(); }

// The charts' colours are their names. Down to 10 % no method tears one.
TEST_P(ChartLayers, NoVertexMovesAcrossTheTextureToAnotherChart) {
  ASSERT_TRUE(status_.ok());
  std::size_t place_only = 0;
  for (std::uint32_t n = 0; n < 2; ++n)
    for (const firmware::format::LayerPair& pair : chain_.pairs(n)) {
      if (pair.place_only()) ++place_only;
      else EXPECT_EQ(colours_[pair.from], colours_[pair.vertex()]) << "layer " << n << ", vertex " << pair.from;
    }
  if (GetParam() == Method::kQem) {
    EXPECT_GT(place_only, 0u) << "a chart is gone";
  }
}

TEST_P(RoundGlobeLayers, AWedgeThatIsLeftAtAPoleKeepsItsPieceOfTheTexture) {
  ASSERT_TRUE(status_.ok());
  std::size_t left = 0;
  for (std::uint32_t n = 0; n + 1 < chain_.layer_count(); ++n)
    for (const firmware::format::LayerPair& pair : chain_.pairs(n)) {
      if (!(positions_[pair.from] == positions_[pair.vertex()])) continue;
      ++left;
      EXPECT_TRUE(pair.place_only() || coordinates_[pair.from] == coordinates_[pair.vertex()])
          << "layer " << n << ", vertex " << pair.from;
    }
  if (GetParam() == Method::kHalfEdge || GetParam() == Method::kVertexDeletion) {
    EXPECT_GT(left, 10u);
  }
}

void MeshLayers::expect_no_hole_between_layers() {
  ASSERT_TRUE(status_.ok()) << status_.message;
  const firmware::VertexStreams given{mesh_.positions, mesh_.normals, mesh_.colours, mesh_.texture_coordinates};
  for (std::uint32_t n = 0; n + 1 < chain_.layer_count(); ++n)
    for (const float w : {0.25f, 0.5f, 1.0f}) {
      firmware::write_middle_layer(chain_, given, n, w, {positions_, normals_, colours_, coordinates_});
      std::vector<std::uint32_t> indices(3 * faces_), live(1);
      firmware::LayerReplay replay(chain_, std::as_writable_bytes(std::span(indices)), 4, live);
      firmware::begin_replay(view_, replay);
      replay.go_to(chain_.layer(n).step);
      // Every edge of a face at work is met by as many the other way, by place: the body stays closed.
      std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> balance;
      const auto place = [&](std::uint32_t v) {
        return std::array<float, 3>{positions_[v].x + 0.0f, positions_[v].y + 0.0f, positions_[v].z + 0.0f};
      };
      for (std::uint32_t f = 0; f < replay.faces(); ++f)
        for (std::uint32_t k = 0; k < 3; ++k) {
          const auto a = place(indices[3 * f + k]), b = place(indices[3 * f + (k + 1) % 3]);
          if (a < b) ++balance[{a, b}];
          if (b < a) --balance[{b, a}];
        }
      const auto open = std::count_if(balance.begin(), balance.end(), [](const auto& e) { return e.second != 0; });
      EXPECT_EQ(open, 0) << "layer " << n << " + " << w;
      firmware::write_middle_layer(chain_, given, n, 0, {positions_, normals_, colours_, coordinates_});
    }
}

constexpr Method kMethods[] = {Method::kHalfEdge, Method::kQem, Method::kEdgeRemoval, Method::kVertexDeletion};
INSTANTIATE_TEST_SUITE_P(Methods, MeshLayers, ::testing::ValuesIn(kMethods));
INSTANTIATE_TEST_SUITE_P(Methods, ChartLayers, ::testing::ValuesIn(kMethods));
INSTANTIATE_TEST_SUITE_P(Methods, GlobeLayers, ::testing::ValuesIn(kMethods));
INSTANTIATE_TEST_SUITE_P(Methods, RoundGlobeLayers, ::testing::ValuesIn(kMethods));

TEST(MeshLayersRefused, MeshesWithoutNormalsAndWithRepeatedVertices) {
  testing::Mesh mesh = body();
  std::vector<std::byte> memory(4u << 20);
  Arena arena(memory);
  MeshView view = indexed_view(mesh, Method::kHalfEdge);
  view.normals = {};
  const auto make = [&] {
    return firmware::make_mesh_layers(view, view.proper_face_count(), kQuotas, firmware::Placement::kOptimal, arena)
        .status()
        .code;
  };
  EXPECT_EQ(make(), StatusCode::kUnsupported);
  mesh = testing::Mesh{};
  const testing::Mesh from = body();
  for (const std::uint32_t v : from.indices) {
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(from.positions[v]);
    mesh.normals.push_back(from.normals[v]);
  }
  view = indexed_view(mesh, Method::kHalfEdge);
  EXPECT_EQ(make(), StatusCode::kUnsupported);
  EXPECT_EQ(arena.used(), 0u);
}

}  // namespace
}  // namespace usuzumi
