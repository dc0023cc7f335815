// Drawing data, RAM and a Thinning over them, for tests that update it with settings and look at the copy.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "firmware/thinning/thinning.h"
#include "tests/support/fake_clock.h"
#include "tests/support/rom_builder.h"

namespace usuzumi::testing {

/// A view in which model x and y in [-1, 1] span a picture of 100 x 100 pixels: a unit square is 2500 pixels.
inline firmware::View flat_view() { return {Mat4{}, 100, 100}; }

class ThinningBench {
 public:
  explicit ThinningBench(RomImage rom, std::size_t ram_bytes = 1 << 20) : rom_(std::move(rom)), ram_(ram_bytes) {
    const auto data = firmware::DrawingData::open(rom_.bytes());
    EXPECT_TRUE(data.ok()) << data.status().message;
    data_ = *data;
    arena_ = Arena(ram_);
    begin_status = thinning.begin(data_, arena_);
  }

  Status update(const firmware::ThinningSettings& settings = {}, const firmware::View& view = flat_view()) {
    return thinning.update(settings, view, clock, report);
  }

  const firmware::RamCopy& copy() const { return thinning.copy(); }
  std::vector<Vec3> positions(std::uint32_t n) const {
    std::vector<Vec3> p(copy().mesh(n).vertex_count);
    std::memcpy(static_cast<void*>(p.data()), copy().block(n), p.size() * sizeof(Vec3));
    return p;
  }
  const RomImage& rom() const { return rom_; }

  firmware::Thinning thinning;
  firmware::ThinningReport report;
  FakeClock clock;
  Status begin_status;

 private:
  RomImage rom_;
  std::vector<std::byte> ram_;
  Arena arena_;
  firmware::DrawingData data_;
};

/// An n x n grid of squares over [-1, 1] x [-1, 1] with gentle hills: 2 n^2 faces, (n + 1)^2 vertices.
inline TestMesh hills(std::uint32_t n, std::uint32_t level) {
  TestMesh mesh;
  mesh.level = level;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const float x = 2 * static_cast<float>(i) / static_cast<float>(n) - 1, y = 2 * static_cast<float>(j) / static_cast<float>(n) - 1;
      mesh.positions.push_back({x, y, 0.2f * x * x - 0.1f * y * y * y});
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      for (std::uint32_t v : {a, b, c, b, d, c}) mesh.indices.push_back(v);
    }
  return mesh;
}

/// One square of side 2 * half around the origin, facing +z, as a strip.
inline TestMesh square(float half, std::uint32_t level, float z = 0) {
  TestMesh mesh;
  mesh.level = level;
  mesh.positions = {{-half, -half, z}, {half, -half, z}, {-half, half, z}, {half, half, z}};
  return mesh;
}

}  // namespace usuzumi::testing
