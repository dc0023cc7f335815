// Drawing data, RAM and a Thinning over them, for tests that update it with settings and look at the copy.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "firmware/thinning/thinning.h"
#include "tests/support/fake_clock.h"
#include "tests/support/test_meshes.h"

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

}  // namespace usuzumi::testing
