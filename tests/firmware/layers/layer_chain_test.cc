#include "firmware/layers/layer_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "tests/firmware/layers/hand_log.h"

namespace usuzumi {
namespace {

using firmware::LayerChainView;
using testing::build_chain;
using testing::BuiltChain;
using testing::Face;
using testing::HandLog;
using testing::Replayed;

constexpr std::uint32_t kSteps60[] = {1'000'000, 600'000, 360'000, 216'000};

struct Case {
  HandLog::Kind kind;
  bool groups;
  std::uint32_t index_bytes;
};

class LayerChain : public ::testing::TestWithParam<Case> {
 protected:
  LayerChain()
      : mesh_(GetParam().groups ? two_groups() : testing::icosphere(2)),
        hand_(mesh_, GetParam().kind, static_cast<std::uint32_t>(mesh_.face_count() / 5), 7,
              GetParam().groups ? groups_of_two() : std::vector<firmware::MaterialGroup>{}),
        chain_(build_chain(hand_.input(kSteps60))) {}

  /// Two spheres of one mesh that share no vertex.
  static testing::Mesh two_groups() {
    testing::Mesh a = testing::icosphere(1);
    const testing::Mesh b = testing::icosphere(2);
    for (const std::uint32_t v : b.indices) a.indices.push_back(v + static_cast<std::uint32_t>(a.positions.size()));
    for (const Vec3 p : b.positions) a.positions.push_back(p + Vec3{3, 0, 0});
    return a;
  }
  static std::vector<firmware::MaterialGroup> groups_of_two() {
    const auto a = testing::icosphere(1), b = testing::icosphere(2);
    const auto faces = static_cast<std::uint32_t>(a.face_count());
    const auto all = faces + static_cast<std::uint32_t>(b.face_count());
    const auto vertices = static_cast<std::uint32_t>(a.positions.size());
    return {{faces, vertices}, {all, vertices + static_cast<std::uint32_t>(b.positions.size())}};
  }

  /// The state as the hand-made method remembers it, by slot.
  std::map<std::uint32_t, Face> expected(std::uint32_t step) const {
    std::map<std::uint32_t, Face> faces;
    for (const auto& [f, corners] : hand_.state(step).faces) faces[chain_.view.slot(f)] = corners;
    return faces;
  }
  /// The live faces of the buffer, by slot.
  std::map<std::uint32_t, Face> found(const Replayed& replayed) const {
    std::map<std::uint32_t, Face> faces;
    for (std::uint32_t g = 0; g < chain_.view.group_count(); ++g)
      for (std::uint32_t i = 0; i < replayed.live[g]; ++i) {
        const std::uint32_t slot = chain_.view.group_begin(g) + i;
        faces[slot] = replayed.face(slot);
      }
    return faces;
  }

  testing::Mesh mesh_;
  HandLog hand_;
  BuiltChain chain_;
};

INSTANTIATE_TEST_SUITE_P(Kinds, LayerChain,
                         ::testing::Values(Case{HandLog::Kind::kHalfEdge, false, 4},
                                           Case{HandLog::Kind::kMiddle, false, 2},
                                           Case{HandLog::Kind::kHalfEdge, true, 2},
                                           Case{HandLog::Kind::kMiddle, true, 4}));

TEST_P(LayerChain, EveryStateIsWhatTheMethodHad) {
  ASSERT_TRUE(chain_.status.ok()) << chain_.status.message << " " << chain_.status.where;
  Replayed replayed(chain_.view, mesh_, GetParam().index_bytes);
  ASSERT_TRUE(replayed.replay.check().ok());
  for (std::uint32_t s = 0; s <= chain_.view.step_count(); ++s) {
    replayed.replay.go_to(s);
    EXPECT_EQ(found(replayed), expected(s)) << "step " << s;
  }
}

TEST_P(LayerChain, AWalkForwardAndBackwardEqualsAFreshReplay) {
  ASSERT_TRUE(chain_.status.ok());
  Replayed walked(chain_.view, mesh_, GetParam().index_bytes);
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const auto to = static_cast<std::uint32_t>(random() % (chain_.view.step_count() + 1));
    const std::uint32_t from = walked.replay.step();
    std::uint64_t between = 0;
    for (std::uint32_t s = std::min(from, to); s < std::max(from, to); ++s) between += chain_.view.changes(s).size();
    EXPECT_EQ(walked.replay.go_to(to), between) << "corners written are the changes between, and no more";
    Replayed fresh(chain_.view, mesh_, GetParam().index_bytes);
    fresh.replay.go_to(to);
    ASSERT_EQ(walked.words, fresh.words);
    ASSERT_EQ(walked.live, fresh.live);
    ASSERT_EQ(found(walked), expected(to));
  }
}

TEST_P(LayerChain, AQuotaOfFacesIsTheFirstStateThatMeetsIt) {
  ASSERT_TRUE(chain_.status.ok());
  Replayed replayed(chain_.view, mesh_, GetParam().index_bytes);
  std::vector<std::uint32_t> quotas(mesh_.face_count() + 10);
  std::iota(quotas.begin(), quotas.end(), 0u);
  std::shuffle(quotas.begin(), quotas.end(), std::mt19937(5));
  for (const std::uint32_t quota : quotas) {
    std::uint32_t first = 0;
    while (first < chain_.view.step_count() && hand_.state(first).faces.size() > quota) ++first;
    replayed.replay.go_to_faces(quota);
    ASSERT_EQ(replayed.replay.step(), first) << quota;
  }
}

TEST_P(LayerChain, FacesRemovedLastComeFirstAndTiesGoByNumber) {
  ASSERT_TRUE(chain_.status.ok());
  std::vector<std::uint32_t> face_of_slot(mesh_.face_count(), 0xFFFFFFFFu);
  for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) face_of_slot[chain_.view.slot(f)] = f;
  const auto removed = [&](std::uint32_t f) {
    const std::uint32_t at = hand_.log().removed_at()[f];
    return at >= chain_.view.step_count() ? 0xFFFFFFFFu : at;
  };
  for (std::uint32_t g = 0; g < chain_.view.group_count(); ++g)
    for (std::uint32_t slot = chain_.view.group_begin(g) + 1; slot < chain_.view.group_end(g); ++slot) {
      const std::uint32_t before = face_of_slot[slot - 1], face = face_of_slot[slot];
      ASSERT_TRUE(removed(before) > removed(face) || (removed(before) == removed(face) && before < face)) << slot;
    }
}

TEST_P(LayerChain, LayersAreWhereTheirQuotasAreMet) {
  ASSERT_TRUE(chain_.status.ok());
  ASSERT_EQ(chain_.view.layer_count(), 4u);
  EXPECT_EQ(chain_.view.layer(0).step, 0u);
  for (std::uint32_t n = 1; n < 4; ++n) {
    const auto quota = static_cast<std::size_t>(std::uint64_t{kSteps60[n]} * mesh_.face_count() / 1'000'000);
    const std::uint32_t step = chain_.view.layer(n).step;
    EXPECT_LE(hand_.state(step).faces.size(), quota);
    EXPECT_GT(hand_.state(step - 1).faces.size(), quota);
    EXPECT_EQ(chain_.view.layer(n).faces, hand_.state(step).faces.size());
  }
  EXPECT_EQ(chain_.view.layer(3).step, chain_.view.step_count());
}

TEST_P(LayerChain, PairsLeadFromVerticesOfALayerToThoseOfTheNext) {
  ASSERT_TRUE(chain_.status.ok());
  const auto vertices_of = [&](std::uint32_t layer) {
    std::vector<bool> used(chain_.view.store_count());
    for (const auto& [f, corners] : hand_.state(chain_.view.layer(layer).step).faces)
      for (const std::uint32_t v : corners) used[v] = true;
    return used;
  };
  for (std::uint32_t n = 0; n + 1 < chain_.view.layer_count(); ++n) {
    const auto here = vertices_of(n), next = vertices_of(n + 1);
    std::map<std::uint32_t, std::uint32_t> pairs;
    for (const auto& pair : chain_.view.pairs(n)) pairs[pair.from] = pair.vertex();
    for (std::uint32_t v = 0; v < here.size(); ++v) {
      if (pairs.count(v) == 0) {
        if (here[v] && !next[v]) ADD_FAILURE() << "vertex " << v << " of layer " << n << " has no correspondent";
        continue;
      }
      EXPECT_TRUE(here[v]) << v;
      EXPECT_FALSE(next[v]) << v;
      // One vertex at a time, as the log tells it.
      std::uint32_t to = v;
      const auto steps = hand_.log().steps();
      for (std::uint32_t s = chain_.view.layer(n).step; s < chain_.view.layer(n + 1).step; ++s)
        for (std::uint32_t i = s == 0 ? 0 : steps[s - 1].succession_end; i < steps[s].succession_end; ++i)
          if (hand_.log().successions()[i].from == to) {
            to = hand_.log().successions()[i].to;
            break;
          }
      EXPECT_EQ(pairs[v], to);
    }
  }
  EXPECT_TRUE(chain_.view.pairs(chain_.view.layer_count() - 1).empty());
}

TEST(LayerChainBuilder, HalfEdgesShareTheMeshsOwnVertices) {
  const auto mesh = testing::icosphere(2);
  const HandLog hand(mesh, HandLog::Kind::kHalfEdge, 64, 1);
  EXPECT_EQ(build_chain(hand.input(kSteps60)).view.store_count(), mesh.positions.size());
}

TEST(LayerChainBuilder, QuotasMustFallFromAll) {
  using firmware::layer_quotas_fall;
  EXPECT_TRUE(layer_quotas_fall(kSteps60));
  EXPECT_TRUE(layer_quotas_fall(std::array{1'000'000u}));
  EXPECT_FALSE(layer_quotas_fall({}));
  EXPECT_FALSE(layer_quotas_fall(std::array{900'000u, 500'000u}));
  EXPECT_FALSE(layer_quotas_fall(std::array{1'000'000u, 600'000u, 600'000u}));
  EXPECT_FALSE(layer_quotas_fall(std::array{1'000'000u, 0u}));
  std::vector<std::uint32_t> many(17);
  for (std::uint32_t i = 0; i < many.size(); ++i) many[i] = 1'000'000 - i;
  EXPECT_FALSE(layer_quotas_fall(many));
  EXPECT_TRUE(layer_quotas_fall(std::span(many).first(16)));
}

TEST(LayerChainBuilder, AQuotaOutOfReachEndsTheChainAtTheLastState) {
  const auto mesh = testing::icosphere(2);  // 320 faces
  const HandLog hand(mesh, HandLog::Kind::kHalfEdge, 150, 1);
  const auto chain = build_chain(hand.input(std::array{1'000'000u, 600'000u, 360'000u, 216'000u}));
  ASSERT_TRUE(chain.status.ok());
  ASSERT_EQ(chain.view.layer_count(), 3u);
  EXPECT_EQ(chain.view.layer(2).faces, hand.state(hand.steps()).faces.size());
}

TEST(LayerChainBuilder, ALastLayerOfLessThanHalfItsWayTakesThePlaceOfTheOneBefore) {
  const auto mesh = testing::icosphere(2);
  const HandLog hand(mesh, HandLog::Kind::kHalfEdge, 150, 1);
  // 160 faces, then 115 asked for.
  const auto chain = build_chain(hand.input(std::array{1'000'000u, 800'000u, 500'000u, 360'000u}));
  ASSERT_TRUE(chain.status.ok());
  ASSERT_EQ(chain.view.layer_count(), 3u);
  EXPECT_EQ(chain.view.layer(2).faces, 150u);
  EXPECT_EQ(chain.view.layer(2).step, hand.steps());
  EXPECT_EQ(chain.view.layer(2).quota_millionths, 500'000u);
  // The mesh itself is never replaced: 320 faces, then 32 asked for, 300 reached.
  const HandLog few(mesh, HandLog::Kind::kHalfEdge, 300, 1);
  const auto two = build_chain(few.input(std::array{1'000'000u, 100'000u}));
  ASSERT_TRUE(two.status.ok());
  ASSERT_EQ(two.view.layer_count(), 2u);
  EXPECT_EQ(two.view.layer(1).faces, 300u);
}

TEST(LayerChainBuilder, AMeshThatCannotBeThinnedHasOneLayer) {
  const auto mesh = testing::icosphere(0);
  const HandLog hand(mesh, HandLog::Kind::kHalfEdge, 20, 1);
  const auto chain = build_chain(hand.input(kSteps60));
  ASSERT_TRUE(chain.status.ok());
  EXPECT_EQ(chain.view.layer_count(), 1u);
  EXPECT_EQ(chain.view.step_count(), 0u);
  EXPECT_EQ(chain.view.faces_at(0), 20u);
}

TEST(LayerChainBuilder, EverySizeOfMemoryIsEnoughOrRefused) {
  const auto mesh = testing::icosphere(1);
  const HandLog hand(mesh, HandLog::Kind::kMiddle, 20, 1);
  const auto whole = build_chain(hand.input(kSteps60));
  ASSERT_TRUE(whole.status.ok());
  for (std::size_t words = 0; words < whole.bytes / 4; ++words)
    ASSERT_EQ(build_chain(hand.input(kSteps60), words).status.code, StatusCode::kResourceExhausted) << words;
  EXPECT_TRUE(build_chain(hand.input(kSteps60), whole.bytes / 4).status.ok());

  std::vector<std::byte> out(whole.bytes);
  const std::size_t store = whole.view.store_count();
  std::vector<std::byte> scratch(4 * store - 1);
  Arena arena(scratch);
  EXPECT_EQ(firmware::build_layer_chain(hand.input(kSteps60), arena, out).status().code,
            StatusCode::kResourceExhausted);
}

TEST(LayerChainBuilder, AFullLogMakesNoChain) {
  const auto mesh = testing::icosphere(1);
  HandLog hand(mesh, HandLog::Kind::kHalfEdge, 20, 1);
  while (!hand.log().full()) hand.log().succeed(0, 1);
  EXPECT_EQ(build_chain(hand.input(kSteps60)).status.code, StatusCode::kResourceExhausted);
}

TEST(LayerChainBuilder, ALogThatContradictsItselfIsRefused) {
  const auto mesh = testing::icosphere(1);
  constexpr std::array kAllOfIt{1'000'000u, 1u};
  const auto refused = [&](auto&& spoil) {
    HandLog hand(mesh, HandLog::Kind::kHalfEdge, 40, 1);
    spoil(hand.log());
    hand.log().end_step();
    return build_chain(hand.input(kAllOfIt)).status.code == StatusCode::kDataLoss;
  };
  std::uint32_t dead = 0;
  {
    const HandLog hand(mesh, HandLog::Kind::kHalfEdge, 40, 1);
    while (hand.log().removed_at()[dead] == firmware::CollapseLog::kNeverRemoved) ++dead;
  }
  std::uint32_t live = 0;
  {
    const HandLog hand(mesh, HandLog::Kind::kHalfEdge, 40, 1);
    while (hand.log().removed_at()[live] != firmware::CollapseLog::kNeverRemoved) ++live;
  }
  EXPECT_FALSE(refused([&](auto& log) { log.remove_face(live); }));
  EXPECT_TRUE(refused([&](auto& log) { log.remove_face(dead); })) << "removed twice";
  const auto corners = static_cast<std::uint32_t>(mesh.indices.size());
  const std::uint32_t other = live + 1;
  EXPECT_TRUE(refused([&](auto& log) { log.remove_face(live), log.change(corners, 0, 1); })) << "no such corner";
  EXPECT_TRUE(refused([&](auto& log) { log.remove_face(live), log.succeed(0, corners); })) << "no such vertex";
  EXPECT_TRUE(refused([&](auto& log) {
    std::uint32_t f = other;
    while (log.removed_at()[f] != firmware::CollapseLog::kNeverRemoved) ++f;
    log.remove_face(live);
    log.change(3 * f, 0, 9999);
  })) << "a vertex that was never added";
}

}  // namespace
}  // namespace usuzumi
