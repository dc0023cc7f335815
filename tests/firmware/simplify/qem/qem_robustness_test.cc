// Beside what holds of every method (robustness_test.cc): where thinning stops, how much scratch, the same bytes.
#include <gtest/gtest.h>

#include <span>

#include "firmware/simplify/qem/qem.h"
#include "hal/crc32.h"
#include "tests/firmware/simplify/robustness.h"

namespace usuzumi::testing {
namespace {

using firmware::StopReason;

TEST(QemRobustness, CrumpledSurfacesStopOnlyWhereNothingMoves) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = crumpled_ball(seed);
    const Thinned thinned = thin(mesh, 20);
    expect_sound(mesh, thinned, 20);
    if (thinned.outcome.stop != StopReason::kNoCollapseAllowed) continue;
    // Stopped for want of an allowed collapse: a fresh start must find none either. It starts with fresh quadrics, so
    // its placements differ a little; it may find a collapse or two more, not dozens.
    const Thinned again = thin(thinned.mesh, 20);
    EXPECT_LE(thinned.mesh.face_count() - again.mesh.face_count(), 8u);
  }
}

TEST(QemRobustness, ScratchIsNoMoreThanTheBar) {
  const Mesh mesh = icosphere(3);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  EXPECT_LE(firmware::qem_scratch_bytes(vertices, faces, false), 128u * vertices) << "sizes of small arrays round up";
}

// One literal for every compiler, processor and optimisation level. It changes only when the method does; then the new
// value is what the failure prints.
TEST(QemRobustness, BytesAreTheSameEverywhere) {
  Mesh mesh = icosphere(4);
  for (Vec3& p : mesh.positions) {
    p = {p.x * 1.5f + 0.1f * p.y * p.y, p.y + 0.2f * p.x * p.z, p.z * 0.7f};
    mesh.colours.push_back(rgba8(static_cast<std::uint32_t>(p.x * 60.0f + 120.0f), 50, 60));
    mesh.normals.push_back(pack_normal(normalized(p)));
  }
  const Thinned thinned = thin(mesh, 900);
  std::uint32_t crc = kCrc32Start;
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.positions)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.normals)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.colours)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.indices)));
  EXPECT_EQ(crc, 4130147165u);
}

}  // namespace
}  // namespace usuzumi::testing
