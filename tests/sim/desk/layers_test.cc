// Meshes with layers as the panel shows them: the same picture as without, and none that jumps.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/desk/desk.h"
#include "tests/support/desk_request.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/quota_sweep.h"
#include "tests/support/test_layers.h"
#include "tests/support/test_meshes.h"

namespace usuzumi {
namespace {

using firmware::LayerMode;
using sim::Desk;
using testing::RomImage;
using testing::TestMesh;
using Method = firmware::format::Method;

/// Steps of 60 % down to where the sweep ends.
constexpr std::uint32_t kQuotas[] = {1'000'000, 600'000, 360'000, 216'000, 129'600, 77'760, 50'000};

/// A ball with dents, each dent of another colour.
TestMesh dented_ball(Method method) {
  testing::Mesh ball = testing::icosphere(4);
  TestMesh mesh;
  mesh.level = 3;
  mesh.method = method;
  mesh.indices = ball.indices;
  for (const Vec3& p : ball.positions) {
    const float dent = std::sin(5 * p.x) * std::sin(4 * p.y) * std::sin(6 * p.z);
    mesh.positions.push_back(p * (1 + 0.1f * dent));
    mesh.normals.push_back(pack_normal(p));
    const auto shade = static_cast<std::uint32_t>(128 + 100 * dent);
    mesh.colours.push_back(rgba8(shade, 200 - shade / 2, 255 - shade));
  }
  return testing::with_layers(mesh, kQuotas);
}

sim::DeskConfig config() {
  sim::DeskConfig c;
  c.width = c.height = 192;
  return c;
}

firmware::FrameRequest request_with(const Desk& desk, std::uint32_t millionths, LayerMode mode) {
  firmware::FrameRequest request = testing::request_for(desk);
  request.thinning.quota = {firmware::format::QuotaKind::kMillionths, millionths};
  request.thinning.layers.mode = mode;
  return request;
}

class LayersOnThePanel : public ::testing::TestWithParam<Method> {};
/// Vertex deletion for layers fills by fans alone.
class LayersAsWithout : public ::testing::TestWithParam<Method> {};

TEST_P(LayersAsWithout, ALayerIsThePictureOfTheMethodItself) {
  TestMesh mesh = dented_ball(GetParam());
  const RomImage layered = testing::container_rom({mesh});
  mesh.layers.clear();
  const RomImage searched = testing::container_rom({mesh});
  Desk a(config(), layered.bytes(), "layered"), b(config(), searched.bytes(), "searched");
  const std::uint32_t last = kQuotas[std::size(kQuotas) - 1];
  const auto from_layers = a.draw(request_with(a, last, LayerMode::kFaces)).record;
  ASSERT_EQ(from_layers.layers.size(), 1u);
  EXPECT_GT(from_layers.layers[0], 0);
  EXPECT_EQ(from_layers.crc32, b.draw(request_with(b, last, LayerMode::kFaces)).record.crc32);
}

/// While a quota falls from 100 to 5 % in 300 frames: with middle layers nothing on the screen changes between two
/// frames by more than a quarter of what it does where layers are switched.
TEST_P(LayersOnThePanel, NothingJumpsWhileAQuotaSweeps) {
  const RomImage rom = testing::container_rom({dented_ball(GetParam())});
  Desk middle(config(), rom.bytes(), "middle"), switched(config(), rom.bytes(), "switched");
  const testing::SweepChange change =
      testing::sweep_quota(middle, switched, testing::request_for(middle), {.layers_millionths = kQuotas});
  EXPECT_GT(change.switched, 10) << "layers differ";
  EXPECT_LE(change.middle, change.switched / 4);
}

INSTANTIATE_TEST_SUITE_P(Methods, LayersAsWithout,
                         ::testing::Values(Method::kQem, Method::kEdgeRemoval, Method::kHalfEdge));
INSTANTIATE_TEST_SUITE_P(Methods, LayersOnThePanel,
                         ::testing::Values(Method::kQem, Method::kEdgeRemoval, Method::kHalfEdge,
                                           Method::kVertexDeletion));

}  // namespace
}  // namespace usuzumi
