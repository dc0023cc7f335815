#include "firmware/layers/middle_layer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "tests/firmware/layers/hand_log.h"

namespace usuzumi {
namespace {

using firmware::format::kLayerColours;
using firmware::format::kLayerNormals;
using firmware::format::kLayerTextureCoordinates;

constexpr std::uint32_t kQuotas[] = {1'000'000, 600'000, 360'000, 216'000};

/// A sphere with every attribute, thinned by a simple method, and its store in RAM.
struct Thinned {
  testing::Mesh mesh = testing::icosphere(3);
  testing::HandLog hand;
  testing::BuiltChain chain;
  std::vector<Vec3> positions;
  std::vector<PackedNormal> normals;
  std::vector<Rgba8> colours;
  std::vector<TexCoord> texture_coordinates;

  explicit Thinned(testing::HandLog::Kind kind = testing::HandLog::Kind::kMiddle) : hand(mesh, kind, 250, 4) {
    for (const Vec3 p : mesh.positions) {
      mesh.normals.push_back(pack_normal(p));
      mesh.colours.push_back(
          rgba8(static_cast<std::uint32_t>(127 * (1 + p.x)), static_cast<std::uint32_t>(127 * (1 + p.y)), 90));
      mesh.texture_coordinates.push_back({p.x, p.z});
    }
    firmware::LayerChainInput input = hand.input(kQuotas);
    input.mesh.attributes = kLayerNormals | kLayerColours | kLayerTextureCoordinates;
    chain = testing::build_chain(input);
    positions.resize(chain.view.store_count());
    normals.resize(positions.size());
    colours.resize(positions.size());
    texture_coordinates.resize(positions.size());
    firmware::write_store(chain.view, given(), target());
  }

  firmware::VertexStreams given() const {
    return {mesh.positions, mesh.normals, mesh.colours, mesh.texture_coordinates};
  }
  firmware::StoreTarget target() { return {positions, normals, colours, texture_coordinates}; }

  /// What a face looks like, whatever its vertices are called, from its least corner on.
  using Corner = std::array<std::uint32_t, 7>;
  std::multiset<std::array<Corner, 3>> picture(std::uint32_t layer) const {
    testing::Replayed replayed(chain.view, mesh);
    replayed.replay.go_to(chain.view.layer(layer).step);
    std::multiset<std::array<Corner, 3>> faces;
    for (std::uint32_t slot = 0; slot < replayed.replay.faces(); ++slot) {
      std::array<Corner, 3> face;
      for (std::uint32_t k = 0; k < 3; ++k) face[k] = corner_of(replayed.face(slot)[k]);
      const auto same_place = [](const Corner& a, const Corner& b) { return std::equal(&a[0], &a[3], &b[0]); };
      if (same_place(face[0], face[1]) || same_place(face[1], face[2]) || same_place(face[2], face[0])) continue;
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      faces.insert(face);
    }
    return faces;
  }

 private:
  Corner corner_of(std::uint32_t v) const {
    Corner corner;
    std::memcpy(&corner[0], &positions[v], 12);
    corner[3] = normals[v].bits;
    corner[4] = colours[v].bits;
    std::memcpy(&corner[5], &texture_coordinates[v], 8);
    return corner;
  }
};

TEST(MiddleLayer, WeightNothingIsTheLayerByteForByte) {
  Thinned thinned;
  ASSERT_TRUE(thinned.chain.status.ok()) << thinned.chain.status.message;
  ASSERT_EQ(thinned.chain.view.layer_count(), 4u);
  const Thinned untouched;
  for (std::uint32_t n = 0; n < 3; ++n) {
    EXPECT_EQ(firmware::write_middle_layer(thinned.chain.view, thinned.given(), n, 0.625f, thinned.target()),
              thinned.chain.view.pairs(n).size());
    EXPECT_NE(thinned.positions, untouched.positions);
    EXPECT_NE(thinned.colours, untouched.colours);
    EXPECT_NE(thinned.normals, untouched.normals);
    EXPECT_NE(thinned.texture_coordinates, untouched.texture_coordinates);
    firmware::write_middle_layer(thinned.chain.view, thinned.given(), n, 0, thinned.target());
    EXPECT_EQ(std::memcmp(thinned.positions.data(), untouched.positions.data(), 12 * thinned.positions.size()), 0);
    EXPECT_EQ(thinned.normals, untouched.normals);
    EXPECT_EQ(thinned.colours, untouched.colours);
    EXPECT_EQ(thinned.texture_coordinates, untouched.texture_coordinates);
  }
}

TEST(MiddleLayer, WeightOneIsThePictureOfTheNextLayer) {
  for (const auto kind : {testing::HandLog::Kind::kMiddle, testing::HandLog::Kind::kHalfEdge}) {
    Thinned thinned(kind);
    ASSERT_TRUE(thinned.chain.status.ok());
    for (std::uint32_t n = 0; n < 3; ++n) {
      const auto next = thinned.picture(n + 1);
      EXPECT_GT(next.size(), 0u);
      EXPECT_NE(thinned.picture(n), next);
      firmware::write_middle_layer(thinned.chain.view, thinned.given(), n, 1, thinned.target());
      EXPECT_EQ(thinned.picture(n), next) << "layer " << n;
      firmware::write_middle_layer(thinned.chain.view, thinned.given(), n, 0, thinned.target());
    }
  }
}

TEST(MiddleLayer, HalfwayEveryVertexLiesHalfwayToItsCorrespondent) {
  Thinned thinned;
  const Thinned store;
  firmware::write_middle_layer(thinned.chain.view, thinned.given(), 1, 0.5f, thinned.target());
  std::vector<bool> moved(store.positions.size());
  for (const auto& pair : thinned.chain.view.pairs(1)) {
    moved[pair.from] = true;
    const Vec3 a = store.positions[pair.from], b = store.positions[pair.vertex()], m = thinned.positions[pair.from];
    EXPECT_FLOAT_EQ(m.x, (a.x + b.x) / 2);
    EXPECT_FLOAT_EQ(m.y, (a.y + b.y) / 2);
    EXPECT_FLOAT_EQ(m.z, (a.z + b.z) / 2);
    const TexCoord s = store.texture_coordinates[pair.from], t = store.texture_coordinates[pair.vertex()];
    EXPECT_FLOAT_EQ(thinned.texture_coordinates[pair.from].s, (s.s + t.s) / 2);
    EXPECT_FLOAT_EQ(thinned.texture_coordinates[pair.from].t, (s.t + t.t) / 2);
    EXPECT_NEAR(thinned.colours[pair.from].r(),
                0.5 * (store.colours[pair.from].r() + store.colours[pair.vertex()].r()), 0.51);
    EXPECT_NEAR(length(unpack(thinned.normals[pair.from])), 1, 0.003);
  }
  for (std::uint32_t v = 0; v < moved.size(); ++v)
    if (!moved[v]) {
      EXPECT_EQ(thinned.positions[v], store.positions[v]);
    }
}

TEST(MiddleLayer, WeightsBeyondTheEndsAndNotANumberAreTheEnds) {
  Thinned thinned, ends;
  const auto write = [](Thinned& t, float w) {
    firmware::write_middle_layer(t.chain.view, t.given(), 0, w, t.target());
  };
  write(thinned, 1.5f), write(ends, 1);
  EXPECT_EQ(thinned.positions, ends.positions);
  write(thinned, -1), write(ends, 0);
  EXPECT_EQ(thinned.positions, ends.positions);
  write(thinned, std::nanf("")), write(ends, 0);
  EXPECT_EQ(thinned.positions, ends.positions);
}

/// Two faces over the edge 0-1, of which the first goes: vertex 0 is followed by vertex 1.
struct OnePair {
  testing::Mesh mesh;
  std::vector<Vec3> positions;
  std::vector<PackedNormal> normals;
  std::vector<Rgba8> colours{rgba8(0, 0, 0), rgba8(200, 200, 200), {}, {}};
  std::vector<TexCoord> texture_coordinates{{0, 0}, {1, 1}, {0, 0}, {0, 0}};
  testing::BuiltChain chain;

  OnePair(Vec3 from, Vec3 to, bool whole = true) {
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}};
    mesh.indices = {0, 1, 2, 1, 0, 3};
    mesh.normals = {pack_normal(from), pack_normal(to), {}, {}};
    mesh.colours = colours;
    mesh.texture_coordinates = texture_coordinates;
    positions = mesh.positions;
    normals = mesh.normals;
    std::vector<firmware::CollapseStep> steps(1);
    std::vector<firmware::Succession> successions(1);
    std::vector<std::uint32_t> removed(2), wedges(4);
    firmware::CollapseLog log({steps, {}, successions, removed, {}, wedges}, 4, 2);
    log.begin_step();
    log.remove_face(0);
    log.follow(0, 1, whole);
    log.end_step();
    constexpr std::uint32_t kTwo[] = {1'000'000, 500'000};
    chain = testing::build_chain(
        {{4, 2, 1, kLayerNormals | kLayerColours | kLayerTextureCoordinates}, {}, kTwo, {}, {}, &log});
    EXPECT_TRUE(chain.status.ok()) << chain.status.message;
  }

  /// The first vertex's normal on its way.
  Vec3 normal_at(float weight) {
    firmware::write_middle_layer(
        chain.view, {mesh.positions, mesh.normals, mesh.colours, mesh.texture_coordinates}, 0, weight,
        {positions, normals, colours, texture_coordinates});
    return unpack(normals[0]);
  }
};

double degrees_between(Vec3 a, Vec3 b) {
  constexpr double kPi = 3.14159265358979;
  return std::acos(std::clamp(double{dot(normalized(a), normalized(b))}, -1.0, 1.0)) * 180 / kPi;
}

TEST(MiddleLayer, NormalsTurnEvenlyHoweverFar) {
  for (const double turn : {10.0, 45.0, 90.0, 150.0, 178.0}) {
    const auto x = static_cast<float>(std::cos(turn * 3.14159265 / 180));
    const auto y = static_cast<float>(std::sin(turn * 3.14159265 / 180));
    OnePair pair({1, 0, 0}, {x, y, 0});
    for (const float weight : {0.1f, 0.25f, 0.5f, 0.6f, 0.9f}) {
      const Vec3 normal = pair.normal_at(weight);
      EXPECT_NEAR(length(normal), 1, 0.003);
      EXPECT_NEAR(degrees_between({1, 0, 0}, normal), turn * weight, 1) << turn << " degrees, weight " << weight;
      EXPECT_NEAR(degrees_between(normal, {x, y, 0}), turn * (1 - weight), 1) << turn << " degrees, weight " << weight;
    }
  }
}

TEST(MiddleLayer, OppositeNormalsTurnToo) {
  for (const Vec3 up : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, normalized({1, 1, 1})}) {
    OnePair pair(up, up * -1);
    EXPECT_EQ(pair.normal_at(0), unpack(pack_normal(up)));
    for (const float weight : {0.25f, 0.5f, 0.75f})
      EXPECT_NEAR(degrees_between(up, pair.normal_at(weight)), 180 * weight, 1.5);
    EXPECT_EQ(pair.normal_at(1), unpack(pack_normal(up * -1)));
  }
}

TEST(MiddleLayer, AVertexThatFollowsAPlaceAloneKeepsTheRest) {
  OnePair pair({1, 0, 0}, {0, 1, 0}, false);
  for (const float weight : {0.5f, 1.0f, 0.0f}) {
    EXPECT_EQ(pair.normal_at(weight), (Vec3{1, 0, 0}));
    EXPECT_EQ(pair.positions[0], (Vec3{weight, 0, 0}));
    EXPECT_EQ(pair.colours[0], rgba8(0, 0, 0));
    EXPECT_EQ(pair.texture_coordinates[0], (TexCoord{0, 0}));
  }
}

TEST(MiddleLayer, WhoeverFollowsOneThatFollowsAPlaceAloneDoesSoToo) {
  testing::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}, {2, 0, 0}};
  mesh.indices = {0, 1, 2, 1, 0, 3, 1, 4, 2};
  std::vector<firmware::CollapseStep> steps(2);
  std::vector<firmware::Succession> successions(2);
  std::vector<std::uint32_t> removed(3), wedges(5);
  firmware::CollapseLog log({steps, {}, successions, removed, {}, wedges}, 5, 3);
  log.begin_step(), log.remove_face(0), log.succeed(0, 1), log.end_step();
  log.begin_step(), log.remove_face(1), log.follow(1, 4, false), log.end_step();
  constexpr std::uint32_t kTwo[] = {1'000'000, 333'400};
  const auto chain = testing::build_chain({{5, 3, 1, 0}, {}, kTwo, {}, {}, &log});
  ASSERT_TRUE(chain.status.ok()) << chain.status.message;
  ASSERT_EQ(chain.view.pairs(0).size(), 2u);
  for (const firmware::format::LayerPair& pair : chain.view.pairs(0)) {
    EXPECT_EQ(pair.vertex(), 4u);
    EXPECT_TRUE(pair.place_only()) << pair.from;
  }
}

}  // namespace
}  // namespace usuzumi
