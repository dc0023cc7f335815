// Chains of layers are drawing data: nothing in them is trusted.
#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>

#include "firmware/layers/layer_chain.h"
#include "firmware/simplify/simplify.h"
#include "tests/firmware/layers/hand_log.h"

namespace usuzumi {
namespace {

using firmware::LayerChainMesh;
using firmware::LayerChainView;
using firmware::format::LayerChainHeader;
using testing::build_chain;
using testing::HandLog;

constexpr std::uint32_t kQuotas[] = {1'000'000, 600'000, 360'000};

/// An icosphere with every attribute, two groups where asked.
struct Sound {
  testing::Mesh mesh = testing::icosphere(1);
  HandLog hand;
  firmware::LayerChainInput input;
  testing::BuiltChain chain;

  explicit Sound(std::uint32_t groups = 1)
      : hand(mesh, HandLog::Kind::kMiddle, 25, 11,
             groups == 1 ? std::vector<firmware::MaterialGroup>{}
                         : std::vector<firmware::MaterialGroup>{{30, 1}, {80, 42}}),
        input(hand.input(kQuotas)) {
    input.mesh.attributes =
        firmware::format::kLayerNormals | firmware::format::kLayerColours | firmware::format::kLayerTextureCoordinates;
    chain = build_chain(input);
  }

  std::span<std::byte> bytes() { return std::as_writable_bytes(std::span(chain.words)).first(chain.bytes); }
  template <class T>
  std::size_t offset_of(std::span<const T> array, std::size_t i = 0) {
    return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(array.data() + i) - bytes().data());
  }
  std::uint32_t get(std::size_t offset) {
    std::uint32_t v;
    std::memcpy(&v, bytes().data() + offset, 4);
    return v;
  }
  /// The status of opening the chain with the word at `offset` replaced; the chain is whole again afterwards.
  Status with(std::size_t offset, std::uint32_t value) {
    const std::uint32_t before = get(offset);
    std::memcpy(bytes().data() + offset, &value, 4);
    const auto opened = LayerChainView::open(bytes(), input.mesh);
    std::memcpy(bytes().data() + offset, &before, 4);
    return opened.status();
  }
};

void expect_refused(Sound& sound, std::size_t offset, std::uint32_t value, std::size_t where, const char* what) {
  const Status status = sound.with(offset, value);
  EXPECT_EQ(status.code, StatusCode::kDataLoss) << what << ", word " << offset << " = " << value;
  EXPECT_EQ(status.where, where) << what << ": " << status.message;
}

TEST(LayerChainOpen, TheSoundChainOpens) {
  for (const std::uint32_t groups : {1u, 2u}) {
    Sound sound(groups);
    ASSERT_TRUE(sound.chain.status.ok()) << sound.chain.status.message;
    EXPECT_TRUE(sound.with(0, sound.get(0)).ok());
  }
}

TEST(LayerChainOpen, EveryWordOfTheHeaderIsHeldToTheMeshAndTheSize) {
  Sound sound;
  ASSERT_TRUE(sound.chain.status.ok());
  const LayerChainHeader h = sound.chain.view.header();
  // Counts that change the size are told at the header; those that the mesh knows better, where they stand.
  expect_refused(sound, offsetof(LayerChainHeader, bytes), h.bytes + 4, 0, "size");
  expect_refused(sound, offsetof(LayerChainHeader, bytes), h.bytes - 4, 0, "size");
  expect_refused(sound, offsetof(LayerChainHeader, bytes), 0, 0, "size");
  expect_refused(sound, offsetof(LayerChainHeader, bytes), 0xFFFFFFFFu, 0, "size");
  expect_refused(sound, 4, h.vertex_count + 1, 4, "vertices");
  expect_refused(sound, 8, h.face_count - 1, 8, "faces");
  expect_refused(sound, 8, 0, 8, "faces");
  expect_refused(sound, 12, 2, 12, "groups");
  expect_refused(sound, 12, 0, 12, "groups");
  expect_refused(sound, 16, h.attributes ^ 1, 16, "attributes");
  expect_refused(sound, 16, h.attributes | 8, 16, "attributes");
  expect_refused(sound, 20, firmware::kMethodCount, 20, "method");
  expect_refused(sound, 24, 2, 24, "placement");
  expect_refused(sound, 28, 0, 28, "layers");
  expect_refused(sound, 28, 17, 28, "layers");
  expect_refused(sound, 28, h.layer_count - 1, 0, "layers");
  for (const std::size_t count : {28u, 32u, 36u, 40u, 44u}) {
    expect_refused(sound, count, sound.get(count) + 1, 0, "a count");
    expect_refused(sound, count, 0xFFFFFFFFu, count == 28 || count == 40 ? count : 0, "a count");
  }
  expect_refused(sound, 48, 1, 48, "reserved");
  expect_refused(sound, 52, 1, 48, "reserved");
}

TEST(LayerChainOpen, AChainThatIsCutShortIsRefused) {
  Sound sound;
  const auto bytes = sound.bytes();
  for (std::size_t n = 0; n < bytes.size(); n += 4)
    ASSERT_EQ(LayerChainView::open(bytes.first(n), sound.input.mesh).status().code, StatusCode::kDataLoss) << n;
  EXPECT_EQ(LayerChainView::open(bytes.subspan(1), sound.input.mesh).status().code, StatusCode::kDataLoss);
}

TEST(LayerChainOpen, LayersMustFallStepByStep) {
  Sound sound;
  const auto& view = sound.chain.view;
  const std::size_t layers = sound.offset_of(view.layers());
  const auto entry = [&](std::size_t n) { return layers + 16 * n; };
  expect_refused(sound, entry(0), 1, entry(0), "layer 0 is the mesh as given");
  expect_refused(sound, entry(1), 0, entry(1), "step");
  expect_refused(sound, entry(1), view.layer(1).step + 1, entry(1), "faces of another step");
  expect_refused(sound, entry(2), view.step_count() + 1, entry(2), "step beyond the last");
  expect_refused(sound, entry(2), view.step_count() - 1, entry(2), "the last layer is the last step");
  expect_refused(sound, entry(0) + 4, 79, entry(0), "faces");
  expect_refused(sound, entry(1) + 4, view.layer(1).faces - 1, entry(1), "faces");
  expect_refused(sound, entry(1) + 8, view.layer(0).pair_end - 1, entry(1), "pairs");
  expect_refused(sound, entry(1) + 8, view.header().pair_count + 1, entry(1), "pairs");
  expect_refused(sound, entry(2) + 8, view.header().pair_count - 1, entry(2), "pairs");
  expect_refused(sound, entry(0) + 12, 999'999, entry(0), "quota");
  expect_refused(sound, entry(1) + 12, 360'000, entry(2), "quota");
}

TEST(LayerChainOpen, GroupsMustDivideTheFaces) {
  Sound sound(2);
  ASSERT_TRUE(sound.chain.status.ok());
  const std::size_t groups = sound.offset_of(sound.chain.view.layers()) + 16 * sound.chain.view.layer_count();
  expect_refused(sound, groups, 81, groups, "beyond");
  expect_refused(sound, groups + 4, 79, groups + 4, "not all");
  expect_refused(sound, groups + 4, 10, groups + 4, "falling");
}

TEST(LayerChainOpen, StepsChangesSlotsAndPairsStayInTheirBounds) {
  for (const std::uint32_t group_count : {1u, 2u}) {
    Sound sound(group_count);
    ASSERT_TRUE(sound.chain.status.ok());
    const auto& view = sound.chain.view;
    const std::size_t steps =
        sound.offset_of(view.layers()) + 16 * view.layer_count() + 4 * view.group_count();
    const std::size_t slots = steps + 8 * view.step_count();
    const std::size_t removed = slots + 4 * view.face_count();
    const auto all_changes = view.changes(0);
    const std::size_t changes = sound.offset_of(all_changes);
    EXPECT_EQ(changes, removed + (group_count > 1 ? 4 * (80 - view.faces_at(view.step_count())) : 0));

    expect_refused(sound, steps + 8, view.header().change_count + 1, steps + 8, "change_end");
    expect_refused(sound, steps, view.header().change_count + 1, steps, "change_end");
    expect_refused(sound, steps + 4, 81, steps + 4 - 4, "faces_after");
    const std::size_t last = steps + 8 * (view.step_count() - 1);
    expect_refused(sound, last, view.header().change_count - 1, 36, "changes of no step");
    if (group_count == 1) expect_refused(sound, last + 4, 0, sound.offset_of(view.layers(), 2), "faces of the layer");
    else expect_refused(sound, last + 4, 0, 0, "another number of faces removed");

    expect_refused(sound, slots + 4, 80, slots + 4, "slot");
    expect_refused(sound, slots + 4, sound.get(slots), slots, "two faces in one slot");
    if (group_count > 1) expect_refused(sound, removed, 2, removed, "group");

    expect_refused(sound, changes, 3 * (group_count > 1 ? 80 : view.faces_at(1)), changes, "corner");
    expect_refused(sound, changes, 0xFFFFFFFFu, changes, "corner");
    expect_refused(sound, changes + 4, view.store_count(), changes, "from");
    expect_refused(sound, changes + 8, view.store_count(), changes, "to");

    const std::size_t pairs = sound.offset_of(view.pairs(0));
    expect_refused(sound, pairs, view.store_count(), pairs, "from");
    expect_refused(sound, pairs + 4, view.store_count(), pairs, "to");
    expect_refused(sound, pairs + 4, view.store_count() | firmware::format::kPairPlaceOnly, pairs, "to");
    EXPECT_TRUE(sound.with(pairs + 4, sound.get(pairs + 4) | firmware::format::kPairPlaceOnly).ok());
    expect_refused(sound, pairs + 8, sound.get(pairs), pairs + 8, "rising");
  }
}

TEST(LayerChainOpen, AddedVerticesAreHeldToTheBoundsOfDrawingData) {
  Sound sound;
  const auto& added = sound.chain.view.added();
  ASSERT_FALSE(added.positions.empty());
  const std::size_t position = sound.offset_of(added.positions, 1);
  for (const float bad : {2e8f, -2e8f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    for (const std::size_t axis : {0u, 4u, 8u})
      expect_refused(sound, position + axis, std::bit_cast<std::uint32_t>(bad), position, "coordinate");
  const std::size_t normal = sound.offset_of(added.normals, 2);
  expect_refused(sound, normal, 0x40000000u, normal, "normal");
  const std::size_t texture = sound.offset_of(added.texture_coordinates, 3);
  expect_refused(sound, texture + 4, 0x7F800000u, texture, "texture coordinate");
}

TEST(LayerChainOpen, ChangesThatDoNotFollowEachOtherAreFoundByReplaying) {
  for (const std::uint32_t group_count : {1u, 2u}) {
    Sound sound(group_count);
    const auto& view = sound.chain.view;
    const std::size_t from = sound.offset_of(view.changes(view.step_count() - 1)) + 4;
    const std::uint32_t other = (sound.get(from) + 1) % view.store_count();
    std::memcpy(sound.bytes().data() + from, &other, 4);
    const auto opened = LayerChainView::open(sound.bytes(), sound.input.mesh);
    ASSERT_TRUE(opened.ok()) << "not to be seen without an index buffer";
    testing::Replayed replayed(*opened, sound.mesh);
    const Status status = replayed.replay.check();
    EXPECT_EQ(status.code, StatusCode::kDataLoss);
    EXPECT_EQ(status.where, view.step_count() - 1);
  }
}

TEST(LayerChainOpen, FacesRemovedFromTheWrongGroupAreFoundByReplaying) {
  Sound sound(2);
  const auto& view = sound.chain.view;
  const std::size_t steps = sound.offset_of(view.layers()) + 16 * view.layer_count() + 4 * 2;
  const std::size_t removed = steps + 8 * view.step_count() + 4 * 80;
  for (std::uint32_t i = 0; i < 80 - view.faces_at(view.step_count()); ++i)
    std::memset(sound.bytes().data() + removed + 4 * i, 0, 4);
  const auto opened = LayerChainView::open(sound.bytes(), sound.input.mesh);
  ASSERT_TRUE(opened.ok());
  testing::Replayed replayed(*opened, sound.mesh);
  EXPECT_EQ(replayed.replay.check().code, StatusCode::kDataLoss);
}

TEST(LayerChainOpen, SlotsWithoutAFaceAreFoundByReplaying) {
  // 0, 4, 5 and 1, 2, 6 have the same sum and the same sum of squares, wherever they begin.
  const testing::Mesh mesh = testing::icosphere(1);
  const HandLog hand(mesh, HandLog::Kind::kHalfEdge, 78, 11);
  constexpr std::uint32_t kTwoQuotas[] = {1'000'000, 975'000};
  testing::BuiltChain chain = build_chain(hand.input(kTwoQuotas));
  ASSERT_TRUE(chain.status.ok());
  const auto changes = chain.view.changes(0);
  std::uint32_t first = 0;  // of seven slots in which nothing changes
  for (std::uint32_t slot = 0; slot < first + 7; ++slot)
    for (const auto& change : changes)
      if (change.corner / 3 == slot) first = slot + 1;
  ASSERT_LT(first + 7, 78u);
  std::uint32_t* const slots = chain.words.data() + 14 + 4 * 2 + 1 + 2;  // behind header, layers, group and step
  ASSERT_EQ(slots[0], chain.view.slot(0));
  for (std::uint32_t f = 0; f < 80; ++f)
    for (const auto& [from, to] : {std::pair{0u, 1u}, {4u, 2u}, {5u, 6u}})
      if (chain.view.slot(f) == first + from) slots[f] = first + to;
  const auto bytes = std::as_bytes(std::span(chain.words)).first(chain.bytes);
  const auto opened = LayerChainView::open(bytes, hand.input(kTwoQuotas).mesh);
  ASSERT_TRUE(opened.ok()) << opened.status().message;
  testing::Replayed replayed(*opened, mesh);
  EXPECT_EQ(replayed.replay.check().code, StatusCode::kDataLoss);
}

/// What opens may be nonsense, but replaying it stays inside (the sanitizers watch).
TEST(LayerChainOpen, SpoiledChainsAreRefusedOrReplayedInBounds) {
  std::mt19937 random(17);
  std::size_t opened_count = 0, refused = 0;
  for (const std::uint32_t group_count : {1u, 2u}) {
    Sound sound(group_count);
    const std::vector<std::uint32_t> whole = sound.chain.words;
    for (int i = 0; i < 4000; ++i) {
      sound.chain.words = whole;
      const std::size_t words = sound.chain.bytes / 4;
      for (unsigned n = 1 + random() % 2; n > 0; --n) {
        std::uint32_t& word = sound.chain.words[random() % words];
        switch (random() % 3) {
          case 0: word ^= 1u << random() % 32; break;
          case 1: word = static_cast<std::uint32_t>(random()); break;
          default: word = static_cast<std::uint32_t>(random() % 100); break;
        }
      }
      const auto opened = LayerChainView::open(sound.bytes(), sound.input.mesh);
      if (!opened.ok()) {
        ++refused;
        EXPECT_EQ(opened.status().code, StatusCode::kDataLoss);
        continue;
      }
      ++opened_count;
      testing::Replayed replayed(*opened, sound.mesh);
      replayed.replay.go_to(opened->step_count());
      replayed.replay.go_to_faces(50);
      for (std::uint32_t c = 0; c < 3 * opened->face_count(); ++c)
        ASSERT_LT(replayed.replay.corner(c), opened->store_count());
    }
  }
  EXPECT_GT(opened_count, 100u);
  EXPECT_GT(refused, 1000u);
}

}  // namespace
}  // namespace usuzumi
