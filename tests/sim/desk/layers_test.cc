// Meshes with layers as the panel shows them: the same picture as without, and none that jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "sim/desk/desk.h"
#include "tests/support/desk_request.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/test_layers.h"
#include "tests/support/test_meshes.h"

namespace usuzumi {
namespace {

using firmware::LayerMode;
using sim::Desk;
using sim::Image;
using testing::RomImage;
using testing::TestMesh;
using Method = firmware::format::Method;

constexpr std::uint32_t kMillion = 1'000'000;
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

/// Largest change of a block of 8 x 8 pixels: the mean difference of its channels, 0..255.
double block_change(const Image& a, const Image& b) {
  constexpr std::uint32_t kSide = 8;
  double largest = 0;
  for (std::uint32_t y = 0; y + kSide <= a.height; y += kSide)
    for (std::uint32_t x = 0; x + kSide <= a.width; x += kSide) {
      int sum = 0;
      for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const std::uint32_t p = a.at(x + i % kSide, y + i / kSide), q = b.at(x + i % kSide, y + i / kSide);
        for (const int shift : {0, 8, 16})
          sum += std::abs(static_cast<int>(p >> shift & 0xFF) - static_cast<int>(q >> shift & 0xFF));
      }
      largest = std::max(largest, sum / (3.0 * kSide * kSide));
    }
  return largest;
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
  constexpr int kFrames = 300;
  double with_middle = 0, with_switching = 0;
  Image before_middle, before_switched;
  for (int i = 0; i < kFrames; ++i) {
    const double share = 1 - 0.95 * i / (kFrames - 1);
    const auto quota = static_cast<std::uint32_t>(std::lround(share * kMillion));
    // The coarsest layer that has as many faces as the quota.
    std::uint32_t layer = kMillion;
    for (const std::uint32_t q : kQuotas)
      if (q >= quota) layer = q;
    const auto a = middle.draw(request_with(middle, quota, LayerMode::kQuota));
    const auto b = switched.draw(request_with(switched, layer, LayerMode::kFaces));
    if (i > 0) {
      with_middle = std::max(with_middle, block_change(before_middle, a.picture));
      with_switching = std::max(with_switching, block_change(before_switched, b.picture));
    }
    before_middle = a.picture;
    before_switched = b.picture;
  }
  RecordProperty("middle", std::to_string(with_middle));
  RecordProperty("switched", std::to_string(with_switching));
  EXPECT_GT(with_switching, 10) << "layers differ";
  EXPECT_LE(with_middle, with_switching / 4);
}

INSTANTIATE_TEST_SUITE_P(Methods, LayersAsWithout,
                         ::testing::Values(Method::kQem, Method::kEdgeRemoval, Method::kHalfEdge));
INSTANTIATE_TEST_SUITE_P(Methods, LayersOnThePanel,
                         ::testing::Values(Method::kQem, Method::kEdgeRemoval, Method::kHalfEdge,
                                           Method::kVertexDeletion));

}  // namespace
}  // namespace usuzumi
