// Random sequences of settings over meshes of every kind, in RAM of several sizes: whatever came before, the copy is
// sound and holds what was decided. Where nothing was given up for want of RAM it is the copy of a device with plenty
// of it; where something was, that of the same device just started.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "firmware/drawing_data/mesh_layers.h"
#include "firmware/layers/middle_layer.h"
#include "firmware/thinning/thinning.h"
#include "tests/support/test_layers.h"
#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using firmware::Action;
using firmware::BuildOutcome;
using firmware::CopyMesh;
using firmware::LayerChainView;
using firmware::LayerMode;
using firmware::MeshView;
using firmware::PolicyKind;
using firmware::ThinningSettings;
using testing::container_rom;
using testing::hills;
using testing::mapped_hills;
using testing::RomImage;
using testing::TestMesh;
using testing::ThinningBench;
using testing::two_hills;
using testing::with_smooth_normals;
using Method = firmware::format::Method;
using QuotaKind = firmware::format::QuotaKind;

constexpr std::uint32_t kQuotas[] = {1'000'000, 600'000, 360'000, 216'000};
constexpr std::uint32_t kFewQuotas[] = {1'000'000, 700'000};
constexpr std::uint32_t kTelltale = firmware::format::kFlagTelltale;

TestMesh made_by(TestMesh mesh, Method method) {
  mesh.method = method;
  return mesh;
}

/// The chain names another vertex than a corner has.
TestMesh spoilt(TestMesh mesh) {
  const auto bytes = std::as_bytes(std::span(mesh.layers));
  const auto* change = reinterpret_cast<const std::byte*>(LayerChainView::of_checked(bytes).changes(5).data());
  mesh.layers[static_cast<std::size_t>(change - bytes.data()) / 4 + 1] ^= 1;
  return mesh;
}

std::vector<TestMesh> every_kind() {
  const auto appearance = testing::five_materials();
  const auto layered = [&](const TestMesh& mesh, std::span<const std::uint32_t> quotas = kQuotas) {
    return testing::with_layers(mesh, quotas, appearance);
  };
  TestMesh coloured = with_smooth_normals(hills(9, 3));
  for (std::size_t v = 0; v < coloured.positions.size(); ++v)
    coloured.colours.push_back(rgba8(static_cast<std::uint32_t>(v), 255 - static_cast<std::uint32_t>(v), 90));
  TestMesh small_only = layered(with_smooth_normals(hills(8, 3)));
  small_only.area_threshold_px = 2500;
  TestMesh lamp = layered(with_smooth_normals(hills(7, 3)));
  lamp.flags = kTelltale;
  TestMesh quoted = layered(with_smooth_normals(mapped_hills(8, 3, 0)), kFewQuotas);
  quoted.quota_kind = QuotaKind::kFaces;
  quoted.quota = 60;
  TestMesh deletable = with_smooth_normals(hills(6, 2)), sign = with_smooth_normals(hills(5, 2));
  deletable.area_threshold_px = 5000;
  sign.flags = kTelltale;
  return {with_smooth_normals(hills(6, 1)),
          layered(with_smooth_normals(mapped_hills(12, 3, 0))),
          layered(made_by(coloured, Method::kEdgeRemoval)),
          layered(made_by(with_smooth_normals(mapped_hills(10, 3, 0)), Method::kHalfEdge)),
          layered(made_by(with_smooth_normals(hills(9, 3)), Method::kVertexDeletion)),
          layered(with_smooth_normals(two_hills(6, 3, 0, 3))),
          layered(made_by(with_smooth_normals(two_hills(5, 3, 3, 1)), Method::kHalfEdge)),
          small_only,
          lamp,
          quoted,
          spoilt(layered(with_smooth_normals(hills(8, 3)))),
          with_smooth_normals(hills(7, 3)),                             // without layers
          made_by(with_smooth_normals(two_hills(5, 3, 1, 0)), Method::kHalfEdge),
          hills(6, 3),                                           // normals are made for it
          deletable,
          sign,
          hills(6, 4),
          hills(6, 5)};
}

struct Frame {
  ThinningSettings settings;
  firmware::View view = testing::flat_view();
};

class RandomFrames {
 public:
  explicit RandomFrames(std::uint32_t seed, std::uint32_t meshes) : random_(seed), all_(meshes) {
    std::iota(all_.begin(), all_.end(), 0u);
  }

  /// Another frame, in which most is as it was.
  const Frame& next() {
    ThinningSettings& s = frame_.settings;
    if (one_in(8)) s.enabled = !s.enabled;
    if (!s.enabled && one_in(2)) s.enabled = true;
    if (one_in(5)) s.layers.mode = static_cast<LayerMode>(below(3));
    if (one_in(2)) s.quota = any_quota();
    if (one_in(6)) s.delete_policy = any_policy();
    if (one_in(6)) s.collapse_policy = any_policy();
    if (one_in(12)) s.placement = one_in(2) ? firmware::Placement::kMidpoint : firmware::Placement::kOptimal;
    if (one_in(12)) s.method_override = {one_in(2), static_cast<firmware::Method>(below(4))};
    if (one_in(3)) s.layers.attention = {one_in(2), static_cast<float>(below(100)), static_cast<float>(below(100))};
    if (one_in(2)) {
      float* m = frame_.view.model_to_clip.m;
      m[0] = m[5] = 0.02f * static_cast<float>(1 + below(60));
      m[12] = 0.01f * static_cast<float>(below(100));
    }
    return frame_;
  }

 private:
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }

  firmware::Quota any_quota() {
    switch (below(4)) {
      case 0: return {};
      case 1: return {QuotaKind::kFaces, below(2500)};
      default: return {QuotaKind::kMillionths, below(1'000'001)};
    }
  }

  firmware::Policy any_policy() {
    firmware::Policy policy;
    policy.kind = one_in(2) ? PolicyKind::kAlways : static_cast<PolicyKind>(below(4));
    policy.area_threshold_px = static_cast<float>(below(10'000));
    policy.random_millionths = below(1'000'001);
    policy.seed = below(1000);
    const std::uint32_t first = below(static_cast<std::uint32_t>(all_.size()));
    policy.chosen = std::span(all_).subspan(first, below(static_cast<std::uint32_t>(all_.size()) - first) + 1);
    return policy;
  }

  std::mt19937 random_;
  std::vector<std::uint32_t> all_;
  Frame frame_;
};

/// What the 3D engine would read of one mesh. Absent meshes have nothing.
struct Drawn {
  bool present = false, layered = false, in_rom = false;
  command::Topology topology{};
  std::uint32_t faces = 0;
  std::vector<Vec3> positions;
  std::vector<PackedNormal> normals;
  std::vector<Rgba8> colours;
  std::vector<TexCoord> texture_coordinates;
  std::vector<std::uint32_t> indices, group_words;
  bool operator==(const Drawn&) const = default;
};

Drawn drawn(const ThinningBench& bench, std::uint32_t n) {
  if (!bench.copy().present(n)) return {};
  const CopyMesh& mesh = bench.copy().mesh(n);
  const auto words = bench.copy().group_words(n);
  return {true,
          mesh.layered,
          mesh.vertices_in_rom,
          mesh.topology,
          mesh.faces,
          mesh.vertices_in_rom ? std::vector<Vec3>{} : bench.positions(n),
          bench.stream<PackedNormal>(n, mesh.normal_offset),
          bench.stream<Rgba8>(n, mesh.colour_offset),
          bench.stream<TexCoord>(n, mesh.texture_coordinate_offset),
          bench.indices(n),
          {words.begin(), words.end()}};
}

/// A layered mesh from nothing: a replay from its beginning, and its store with the middle layer on top.
void expect_layered_as_from_nothing(const ThinningBench& bench, const MeshView& mesh) {
  const firmware::LayeredMesh& layered = *bench.thinning.layers(mesh.number);
  const LayerChainView chain = layered.view();
  const Drawn now = drawn(bench, mesh.number);
  ASSERT_LE(layered.place.step, chain.step_count());
  EXPECT_EQ(now.faces, chain.faces_at(layered.place.step));

  std::vector<std::uint32_t> indices(now.indices.size()), live(chain.group_count());
  firmware::LayerReplay replay(chain, std::as_writable_bytes(std::span(indices)), 4, live);
  begin_replay(mesh, replay);
  replay.go_to(layered.place.step);
  EXPECT_EQ(now.indices, indices);
  EXPECT_EQ(now.group_words, live);
  if (now.in_rom) return;

  const firmware::VertexStreams given{mesh.positions, mesh.normals, mesh.colours,
                                      mesh.textured ? mesh.texture_coordinates : std::span<const TexCoord>{}};
  Drawn store = now;
  const firmware::StoreTarget target{store.positions, store.normals, store.colours, store.texture_coordinates};
  write_store(chain, given, target);
  if (layered.place.weight > 0) write_middle_layer(chain, given, layered.place.layer, layered.place.weight, target);
  EXPECT_TRUE(store == now) << "vertices stand where no layer has them";
}

bool must_be_drawn(const MeshView& mesh) {
  return mesh.telltale() || mesh.level == firmware::Level::kKeep || mesh.level == firmware::Level::kUnset;
}

void expect_as_decided(const ThinningBench& bench, const firmware::DrawingData& data, const Status& status) {
  ASSERT_TRUE(status.ok() || status.code == StatusCode::kResourceExhausted) << status.message;
  EXPECT_TRUE(bench.copy().sound());
  std::uint64_t faces = 0;
  std::uint32_t must_missing = 0;
  for (std::uint32_t n = 0; n < data.mesh_max(); ++n) {
    SCOPED_TRACE(n);
    const MeshView mesh = data.mesh(n);
    const firmware::MeshState& state = bench.thinning.state(n);
    const Action action = state.decision.action;
    if (!bench.copy().present(n)) {
      EXPECT_TRUE(action == Action::kDelete || state.build.outcome == BuildOutcome::kDropped);
      if (must_be_drawn(mesh)) ++must_missing;
      continue;
    }
    const CopyMesh& copy = bench.copy().mesh(n);
    faces += copy.faces;
    EXPECT_NE(action, Action::kDelete);
    if (action == Action::kPoint || action == Action::kLine) {
      EXPECT_EQ(copy.faces, 0u);
    }
    if (action == Action::kKeep || state.build.outcome == BuildOutcome::kUnthinned) {
      EXPECT_EQ(copy.faces, mesh.proper_face_count());
    }
    if (copy.layered) {
      EXPECT_TRUE(state.decision.layered);
      expect_layered_as_from_nothing(bench, mesh);
      // By replay the quota is met, and would not be with one step less.
      const auto& place = bench.thinning.layers(n)->place;
      const LayerChainView chain = bench.thinning.layers(n)->view();
      if (!state.decision.vertices_move) {
        EXPECT_LE(copy.faces, state.decision.target_faces);
        if (place.step > 0) {
          EXPECT_GT(chain.faces_at(place.step - 1), state.decision.target_faces);
        }
      }
    } else if (action == Action::kCollapse && state.build.outcome == BuildOutcome::kBuilt) {
      EXPECT_LE(copy.faces, state.decision.target_faces);
    }
  }
  EXPECT_EQ(bench.report.faces_out, faces);
  EXPECT_EQ(status.ok(), must_missing == 0) << "what must be drawn is missing, or an error without a reason";
}

bool anything_given_up(const firmware::ThinningReport& report) {
  return report.layers_given_up || report.quota_halvings > 0 || report.meshes_unthinned > 0 ||
         report.meshes_dropped > 0;
}

/// Normals that ROM has not are made where RAM has room to, and the mesh is drawn unlit where it has not: they are not
/// looked at where RAM is short.
void expect_same_picture_data(const ThinningBench& bench, const ThinningBench& expected, bool made_normals) {
  for (std::uint32_t n = 0; n < bench.copy().mesh_max(); ++n) {
    Drawn is = drawn(bench, n), should_be = drawn(expected, n);
    if (!made_normals && bench.thinning.data().mesh(n).normals.empty()) is.normals = should_be.normals = {};
    EXPECT_TRUE(is == should_be) << "mesh " << n << " has " << is.faces << " faces" << (is.layered ? " of layers" : "")
                                 << " where " << should_be.faces << (should_be.layered ? " of layers" : "")
                                 << " are expected";
  }
}

struct Memory {
  std::size_t ram_bytes;
  bool rom_on_bus, boot_layers;
};

void PrintTo(const Memory& memory, std::ostream* out) { *out << memory.ram_bytes << " bytes"; }

constexpr std::size_t kPlenty = 1 << 20;

class RandomSettings : public ::testing::TestWithParam<Memory> {};

TEST_P(RandomSettings, LeaveTheCopyThatTheyAskForWhateverCameBefore) {
  const auto [ram_bytes, rom_on_bus, with_boot_layers] = GetParam();
  const RomImage rom = container_rom(every_kind(), testing::five_materials());
  const auto data = firmware::DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok()) << data.status().message;
  const std::span<const std::uint32_t> boot_layers =
      with_boot_layers ? std::span<const std::uint32_t>(kQuotas) : std::span<const std::uint32_t>{};
  std::uint32_t compared = 0, short_of_ram = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    ThinningBench bench(rom, ram_bytes, rom_on_bus, boot_layers);
    ASSERT_TRUE(bench.begin_status.ok());
    RandomFrames frames(seed, data->mesh_max());
    for (std::uint32_t i = 0; i < 60; ++i) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", frame " << i);
      const Frame& frame = frames.next();
      const Status status = bench.update(frame.settings, frame.view);
      expect_as_decided(bench, *data, status);

      if (frame.settings.layers.mode == LayerMode::kAutomatic) continue;  // it remembers the frames before
      const bool given_up = anything_given_up(bench.report);
      ThinningBench fresh(rom, given_up ? ram_bytes : kPlenty, rom_on_bus, boot_layers);
      EXPECT_EQ(fresh.update(frame.settings, frame.view).code, status.code);
      expect_same_picture_data(bench, fresh, ram_bytes == kPlenty);
      ++compared;
      short_of_ram += given_up ? 1 : 0;
      ASSERT_EQ(bench.update(frame.settings, frame.view).code, status.code);
      EXPECT_EQ(bench.report.cause, firmware::UpdateCause::kUnchanged) << "nothing has changed";
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(compared, 100u);
  if (ram_bytes == kPlenty) {
    EXPECT_EQ(short_of_ram, 0u);
  } else {
    EXPECT_GT(short_of_ram, 10u) << "RAM is not short enough for this test";
    EXPECT_LT(short_of_ram, compared) << "RAM is too short for this test";
  }
}

INSTANTIATE_TEST_SUITE_P(Ram, RandomSettings,
                         ::testing::Values(Memory{kPlenty, false, false}, Memory{kPlenty, true, false},
                                           Memory{kPlenty, false, true}, Memory{kPlenty, true, true},
                                           Memory{52'000, false, false}, Memory{44'000, false, false},
                                           Memory{37'000, false, false}, Memory{48'000, true, false},
                                           Memory{40'000, true, false}, Memory{34'000, true, false}));

}  // namespace
}  // namespace usuzumi
