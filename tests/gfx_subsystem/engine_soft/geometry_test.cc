// Assembly, culling and clipping; points and lines.
#include <limits>

#include "tests/gfx_subsystem/engine_soft/test_bench.h"

namespace usuzumi::gfx::test {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
const float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Culling, SidesAreSeenOnThePanel) {
  // Window y runs down: (2,2) (2,14) (14,2) runs counter-clockwise to the eye.
  const std::vector<Vec3> counter_clockwise{{2, 2, 0}, {2, 14, 0}, {14, 2, 0}},
      clockwise{{2, 2, 0}, {14, 2, 0}, {2, 14, 0}};
  struct Case { CullMode cull; FrontFace front; bool ccw_drawn, cw_drawn; };
  for (const auto& c : {Case{CullMode::kNone, FrontFace::kCounterClockwise, true, true},
                        Case{CullMode::kBack, FrontFace::kCounterClockwise, true, false},
                        Case{CullMode::kFront, FrontFace::kCounterClockwise, false, true},
                        Case{CullMode::kBack, FrontFace::kClockwise, false, true},
                        Case{CullMode::kFront, FrontFace::kClockwise, true, false}}) {
    SetRasterState raster;
    raster.cull = c.cull;
    raster.front_face = c.front;
    Bench a(16, 16), b(16, 16);
    a.put(raster).streams(counter_clockwise).draw(Topology::kTriangles, 3);
    b.put(raster).streams(clockwise).draw(Topology::kTriangles, 3);
    EXPECT_EQ(a.run().counters.faces_drawn, c.ccw_drawn ? 1u : 0u);
    EXPECT_EQ(b.run().counters.faces_drawn, c.cw_drawn ? 1u : 0u);
    EXPECT_EQ(a.covered() != 0, c.ccw_drawn);
    EXPECT_EQ(b.covered() != 0, c.cw_drawn);
  }
}

TEST(Culling, StripsAlternateAndFansDoNot) {
  SetRasterState raster;
  raster.cull = CullMode::kBack;
  Bench strip(64, 64), fan(64, 64);
  std::vector<Vec3> ribbon, rim{{32, 32, 0}};
  for (int i = 0; i < 10; ++i)
    ribbon.push_back({static_cast<float>(i / 2 * 12 + 2), i % 2 == 0 ? 10.0f : 50.0f, 0});  // counter-clockwise
  for (const Vec3 p : {Vec3{60, 32, 0}, Vec3{32, 4, 0}, Vec3{4, 32, 0}, Vec3{32, 60, 0}, Vec3{60, 32, 0}})
    rim.push_back(p);
  strip.put(raster).streams(ribbon).draw(Topology::kTriangleStrip, 10);
  fan.put(raster).streams(rim).draw(Topology::kTriangleFan, 6);
  const auto s = strip.run().counters, f = fan.run().counters;
  EXPECT_EQ(s.faces_drawn, 8u);
  EXPECT_EQ(s.pixels_tested, 48u * 40u);
  EXPECT_EQ(f.faces_drawn, 4u);
  EXPECT_EQ(f.pixels_tested, fan.covered());
}

TEST(Assembly, IndexFormatsAndFirstSelectTheSameTriangles) {
  std::vector<Vec3> v{{0, 0, 0}, {0, 0, 0}};
  for (int i = 0; i < 6; ++i)
    v.push_back({static_cast<float>(i % 3 * 20), static_cast<float>(i / 3 * 20 + (i % 2) * 10), 0});
  const std::vector<std::uint32_t> wide{7, 2, 3, 4, 5, 6, 7};
  const std::vector<std::uint16_t> narrow(wide.begin(), wide.end());
  Bench a(64, 64), b(64, 64), c(64, 64);
  a.streams(v).draw(Topology::kTriangles, 6, 2);
  b.streams(v).put(Draw{Topology::kTriangles, IndexFormat::kU32, b.upload(wide), 1, 6});
  c.streams(v).put(Draw{Topology::kTriangles, IndexFormat::kU16, c.upload(narrow), 1, 6});
  ASSERT_TRUE(a.run().status.ok());
  ASSERT_TRUE(b.run().status.ok());
  ASSERT_TRUE(c.run().status.ok());
  EXPECT_GT(a.covered(), 50u);
  EXPECT_EQ(a.vram(), b.vram());
  EXPECT_EQ(a.vram(), c.vram());
}

TEST(Assembly, IncompletePrimitivesAreLeftOut) {
  const std::vector<Vec3> v{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {8, 8, 0}, {4, 4, 0}};
  for (const auto& [topology, count, primitives] :
       {std::tuple{Topology::kTriangles, 5u, 1u}, std::tuple{Topology::kTriangleStrip, 2u, 0u},
        std::tuple{Topology::kTriangleFan, 1u, 0u}, std::tuple{Topology::kLines, 5u, 2u},
        std::tuple{Topology::kPoints, 5u, 5u}}) {
    Bench b(16, 16);
    b.streams(v).draw(topology, count);
    const auto report = b.run();
    EXPECT_TRUE(report.status.ok());
    EXPECT_EQ(report.counters.primitives_in, primitives);
    EXPECT_EQ(report.counters.vertices_transformed, count);
  }
}

/// Perspective with the eye at the origin looking along -z; 90 degrees both ways.
SetTransform square_view(float near, float far) {
  return {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, (far + near) / (near - far), 2 * far * near / (near - far), 0, 0, -1, 0}}};
}

TEST(Clip, GroundThatRunsBehindTheEyeCoversTheLowerHalf) {
  Bench b(128, 128);
  b.put(square_view(0.1f, 1000));
  b.streams({{-500, -1, 500}, {500, -1, 500}, {500, -1, -900}, {-500, -1, -900}}).draw(Topology::kTriangleFan, 4);
  const auto report = b.run();
  ASSERT_TRUE(report.status.ok());
  EXPECT_EQ(report.counters.faces_drawn, 2u);
  for (std::uint32_t x = 0; x < 128; x += 5) {
    EXPECT_EQ(b.pixel(x, 63), 0u) << "above the horizon";
    for (std::uint32_t y = 65; y < 128; ++y) ASSERT_NE(b.pixel(x, y), 0u) << x << ", " << y;
  }
  EXPECT_EQ(report.counters.pixels_tested, b.covered()) << "pieces of a clipped polygon overlap";
}

TEST(Clip, WhollyBehindTheEyeOrBeyondTheFarPlaneDrawsNothing) {
  for (const float z : {5.0f, 0.05f, 0.0f, -0.05f, -20.0f}) {
    Bench b(64, 64);
    b.put(square_view(0.1f, 10)).streams({{-1, -1, z}, {1, -1, z}, {0, 1, z}}).draw(Topology::kTriangles, 3);
    const auto report = b.run();
    EXPECT_TRUE(report.status.ok());
    EXPECT_EQ(report.counters.faces_drawn, 0u) << z;
    EXPECT_EQ(b.covered(), 0u) << z;
  }
}

TEST(Clip, ColourOnTheCutIsInterpolatedInSpace) {
  // From z = -1 (black) to z = +1 (white) cut at near = 0.5: a quarter of the way.
  Bench b(64, 64);
  b.put(square_view(0.5f, 10));
  b.streams({{-9, -0.5f, -1}, {9, -0.5f, -1}, {9, -0.5f, 1}, {-9, -0.5f, 1}},
            {rgba8(0, 0, 0), rgba8(0, 0, 0), rgba8(255, 255, 255), rgba8(255, 255, 255)})
      .draw(Topology::kTriangleFan, 4);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_NEAR(b.pixel(32, 63) & 255, 0.25 * 255, 2.0);  // the window's lower border shows z = -0.5
}

TEST(Clip, HugeAndUnspeakableCoordinatesDoNoHarm) {
  for (const float bad : {1e6f, 1e12f, 1e20f, 3e38f, -3e38f, kInf, -kInf, kNan})
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        for (const bool perspective : {false, true}) {
          std::vector<Vec3> v{{-0.5f, -0.5f, -1}, {0.5f, -0.5f, -1}, {0, 0.5f, -1}};
          float* value = axis == 0   ? &v[static_cast<std::size_t>(corner)].x
                         : axis == 1 ? &v[static_cast<std::size_t>(corner)].y
                                     : &v[static_cast<std::size_t>(corner)].z;
          *value = bad;
          Bench b(64, 64);
          if (perspective) b.put(square_view(0.1f, 10)); else b.put(SetTransform{});
          b.streams(v).draw(Topology::kTriangles, 3);
          b.draw(Topology::kLines, 2).draw(Topology::kPoints, 3);
          b.streams({{-1, -1, -1}, {1, -1, -1}, {0, 1, -1}})
              .draw(Topology::kTriangles, 3);  // the next draw is unharmed
          const auto report = b.run();
          ASSERT_TRUE(report.status.ok());
          EXPECT_NE(b.pixel(32, 40), 0u) << bad;
        }
}

TEST(Clip, GuardBandCutKeepsTheEdgeInPlace) {
  // One corner a million pixels away: the edge through the target still passes where the line does, to a pixel.
  Bench b(100, 100);
  b.streams({{0, 0, 0}, {1e6f, 1e6f, 0}, {0, 1e6f, 0}}).draw(Topology::kTriangles, 3);
  ASSERT_TRUE(b.run().status.ok());
  for (std::uint32_t y = 0; y < 100; ++y)
    for (std::uint32_t x = 0; x < 100; ++x) {
      if (x + 1 < y) { ASSERT_NE(b.pixel(x, y), 0u) << x << ", " << y; }
      if (x > y + 1) { ASSERT_EQ(b.pixel(x, y), 0u) << x << ", " << y; }
    }
}

TEST(Points, AreSquaresAroundTheVertex) {
  Bench b(16, 8);
  SetRasterState raster;
  raster.point_size = 3;
  b.put(raster).streams({{4.5f, 3.5f, 0}, {12, 4, 0}}).draw(Topology::kPoints, 1);
  raster.point_size = 2;
  b.put(raster).draw(Topology::kPoints, 1, 1);
  const auto report = b.run();
  EXPECT_EQ(b.picture(),
            "................\n"
            "................\n"
            "...###..........\n"
            "...###.....##...\n"
            "...###.....##...\n"
            "................\n"
            "................\n"
            "................\n");
  EXPECT_EQ(report.counters.primitives_in, 2u);
  EXPECT_EQ(report.counters.faces_in, 0u);
  EXPECT_EQ(report.counters.faces_drawn, 0u);
  EXPECT_EQ(report.counters.pixels_tested, 13u);
}

TEST(Points, WithTheirVertexOutsideTheViewAreNotDrawn) {
  Bench b(16, 16);
  SetRasterState raster;
  raster.point_size = 8;
  b.put(raster).streams({{-1, 8, 0}, {8, 17, 0}, {8, 8, 1.5f}}).draw(Topology::kPoints, 3);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.covered(), 0u);
}

TEST(Lines, AreWidenedAlongTheMinorAxis) {
  Bench b(12, 8);
  SetRasterState raster;
  raster.line_width = 3;
  b.put(raster).streams({{2, 3.5f, 0}, {10, 3.5f, 0}}).draw(Topology::kLines, 2);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.picture(),
            "............\n"
            "............\n"
            "..########..\n"
            "..########..\n"
            "..########..\n"
            "............\n"
            "............\n"
            "............\n");
}

TEST(Lines, OfOnePixelAreGaplessAndOnePixelThick) {
  Random random(9);
  for (int n = 0; n < 300; ++n) {
    const Vec3 a{random.in(0, 64), random.in(0, 64), 0}, b{random.in(0, 64), random.in(0, 64), 0};
    Bench bench(64, 64);
    bench.streams({a, b}).draw(Topology::kLines, 2);
    ASSERT_TRUE(bench.run().status.ok());
    const bool wide = std::abs(b.x - a.x) > std::abs(b.y - a.y);
    const float from = wide ? std::min(a.x, b.x) : std::min(a.y, b.y),
                to = wide ? std::max(a.x, b.x) : std::max(a.y, b.y);
    for (std::uint32_t i = 0; i < 64; ++i) {
      int in_column = 0;
      for (std::uint32_t j = 0; j < 64; ++j) in_column += bench.pixel(wide ? i : j, wide ? j : i) != 0;
      const float centre = static_cast<float>(i) + 0.5f;
      if (centre > from + 0.01f && centre < to - 0.01f) {
        const float t = (centre - (wide ? a.x : a.y)) / (wide ? b.x - a.x : b.y - a.y),
                    across = wide ? a.y + t * (b.y - a.y) : a.x + t * (b.x - a.x);
        if (across > 0.6f && across < 63.4f) { ASSERT_EQ(in_column, 1) << n << " column " << i; }
      }
      if (centre < from - 0.01f || centre > to + 0.01f) { ASSERT_EQ(in_column, 0) << n << " column " << i; }
    }
  }
}

TEST(Counters, CountFacesLeftAfterClippingCullingAndZeroArea) {
  Bench b(64, 64);
  b.streams({{0, 0, 0}, {9, 0, 0}, {0, 9, 0},                  // drawn
             {5, 5, 0}, {10, 10, 0}, {15, 15, 0},              // no area
             {-90, 0, 0}, {-80, 0, 0}, {-90, 9, 0},            // left of the view
             {20.1f, 20.1f, 0}, {20.2f, 20.1f, 0}, {20.1f, 20.2f, 0}})  // between pixel centres: has area
      .draw(Topology::kTriangles, 12);
  const auto c = b.run().counters;
  EXPECT_EQ(c.faces_in, 4u);
  EXPECT_EQ(c.primitives_in, 4u);
  EXPECT_EQ(c.faces_drawn, 2u);
  EXPECT_EQ(c.vertices_transformed, 12u);
  EXPECT_EQ(c.pixels_tested, b.covered());
  EXPECT_EQ(c.command_words, b.used_words() + 1);
}

}  // namespace
}  // namespace usuzumi::gfx::test
