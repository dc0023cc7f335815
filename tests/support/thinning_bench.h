// Drawing data, RAM and a Thinning over them, for tests that update it with settings and look at the copy.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "firmware/thinning/thinning.h"
#include "tests/support/fake_clock.h"
#include "tests/support/test_meshes.h"

namespace usuzumi::testing {

/// A view in which model x and y in [-1, 1] span a picture of 100 x 100 pixels: a unit square is 2500 pixels.
inline firmware::View flat_view() { return {Mat4{}, 100, 100}; }

class ThinningBench {
 public:
  explicit ThinningBench(RomImage rom, std::size_t ram_bytes = 1 << 20, bool rom_on_bus = false,
                         std::span<const std::uint32_t> boot_layers = {})
      : rom_(std::move(rom)), ram_(ram_bytes / kRamAlignment + 1) {
    const auto data = firmware::DrawingData::open(rom_.bytes());
    EXPECT_TRUE(data.ok()) << data.status().message;
    data_ = *data;
    arena_ = Arena(std::as_writable_bytes(std::span(ram_)).first(ram_bytes));
    begin_status = thinning.begin(data_, arena_, rom_on_bus, boot_layers);
  }

  Status update(const firmware::ThinningSettings& settings = {}, const firmware::View& view = flat_view()) {
    return thinning.update(settings, view, clock, report);
  }

  const firmware::RamCopy& copy() const { return thinning.copy(); }
  std::vector<Vec3> positions(std::uint32_t n) const { return stream<Vec3>(n, 0); }
  /// One entry per vertex of mesh n, from `offset` in its block on; none where the block has no such stream.
  template <class T>
  std::vector<T> stream(std::uint32_t n, std::uint32_t offset) const {
    if (offset == firmware::kNoStream) return {};
    std::vector<T> entries(copy().mesh(n).vertex_count);
    std::memcpy(static_cast<void*>(entries.data()), copy().block(n) + offset, entries.size() * sizeof(T));
    return entries;
  }
  std::vector<std::uint32_t> indices(std::uint32_t n) const {
    const firmware::CopyMesh& mesh = copy().mesh(n);
    const bool narrow = mesh.index_format == command::IndexFormat::kU16;
    std::vector<std::uint32_t> result(mesh.index_count, 0);
    for (std::size_t i = 0; i < result.size(); ++i)
      std::memcpy(&result[i], copy().block(n) + mesh.index_offset + i * (narrow ? 2 : 4), narrow ? 2 : 4);
    return result;
  }
  const RomImage& rom() const { return rom_; }

  firmware::Thinning thinning;
  firmware::ThinningReport report;
  FakeClock clock;
  Status begin_status;

 private:
  RomImage rom_;
  /// A board's RAM begins where it begins in every run: what fits must not depend on where the host's lies.
  static constexpr std::size_t kRamAlignment = 64;
  struct alignas(kRamAlignment) Line {
    std::byte bytes[kRamAlignment];
  };
  std::vector<Line> ram_;
  Arena arena_;
  firmware::DrawingData data_;
};

}  // namespace usuzumi::testing
