// The same bytes and the same counts whatever the threads, the SIMD width and the working memory.
#include <cmath>

#include "hal/crc32.h"
#include "sim/parallel/thread_runner.h"
#include "gfx_subsystem/engine/texture_layout.h"
#include "tests/gfx_subsystem/engine_soft/test_bench.h"

namespace usuzumi::gfx::test {
namespace {

/// A list with everything in it: small, big, clipped, perspective, flat, lines, points, clears in between, scissors.
void compose(Bench& b, std::uint32_t seed) {
  Random random(seed);
  const float w = static_cast<float>(b.width()), h = static_cast<float>(b.height());
  SetRasterState raster;
  raster.depth_test = 1;
  b.put(Clear{kClearColour | kClearDepth, rgba8(10, 20, 30), 1});
  for (int group = 0; group < 12; ++group) {
    raster.shade_model = group % 3 == 0 ? ShadeModel::kFlat : ShadeModel::kGouraud;
    raster.depth_function = group % 4 == 0 ? DepthFunction::kLessEqual : DepthFunction::kLess;
    raster.cull = group % 5 == 0 ? CullMode::kBack : CullMode::kNone;
    raster.point_size = 1 + static_cast<float>(group);
    raster.line_width = 1 + static_cast<float>(group) / 2;
    b.put(raster);
    const float size = group < 4 ? 6.0f : group < 8 ? 70.0f : 900.0f;
    const int triangles = group < 4 ? 400 : group < 8 ? 60 : 12;
    std::vector<Vec3> v;
    std::vector<Rgba8> c;
    for (int i = 0; i < triangles * 3; ++i) {
      const Vec3 centre{random.in(0, w), random.in(0, h), 0};
      const Vec3 origin = i % 3 == 0 ? centre : v[static_cast<std::size_t>(i / 3 * 3)];
      v.push_back({origin.x + random.in(-size, size), origin.y + random.in(-size, size), random.in(-0.1f, 1.1f)});
      c.push_back({random.next()});  // one call: arguments are evaluated in an order of the compiler's choice
    }
    b.streams(v, c);
    const auto count = static_cast<std::uint32_t>(v.size());
    if (group % 2 == 0) {
      b.put(SetTransform{b.pixel_transform()});
    } else {
      Mat4 m = b.pixel_transform();  // w varies across the window
      m.m[12] = 1.5f / w;
      m.m[13] = -0.5f / h;
      b.put(SetTransform{m});
    }
    b.draw(Topology::kTriangles, count);
    std::vector<std::uint32_t> shuffled;
    for (std::uint32_t i = 0; i < 300; ++i) shuffled.push_back(random.below(count));
    if (group == 6) b.put(SetScissor{b.width() / 5, b.height() / 7, b.width() / 2, b.height() / 2});
    if (group == 7) b.put(Clear{kClearColour, rgba8(90, 0, 0), 1});
    if (group == 9) b.put(SetScissor{0, 0, b.width(), b.height()});
    if (group < 8) b.draw_indexed(group % 2 == 0 ? Topology::kTriangleStrip : Topology::kTriangles, shuffled);
    b.draw(Topology::kTriangleFan, 12).draw(Topology::kLines, 36).draw(Topology::kPoints, 36);
  }
}

/// Every texture format, filter, wrap mode and number of levels, with and without alpha test, blending, light and a
/// target's depth; small, big and clipped, in perspective, points and lines; coordinates near and absurd.
void compose_fragments(Bench& b, std::uint32_t seed) {
  Random random(seed);
  const float w = static_cast<float>(b.width()), h = static_cast<float>(b.height());
  std::vector<std::uint32_t> noise;
  for (int i = 0; i < 70 * 50 * 2; ++i) noise.push_back(random.next());
  const BusAddress texels = b.upload(noise);
  b.put(Clear{kClearColour | kClearDepth, rgba8(10, 20, 30), 1});
  for (std::uint32_t group = 0; group < 16; ++group) {
    SetRasterState raster;
    raster.shade_model = group % 5 == 0 ? ShadeModel::kFlat : ShadeModel::kGouraud;
    raster.depth_test = group % 4 != 3;
    raster.depth_write = group % 3 != 0;
    raster.point_size = 9;
    raster.line_width = 3;
    b.put(raster).put(SetFragmentState{group % 2, 60 + random.below(100), static_cast<BlendMode>(group / 2 % 2)});
    SetTexture t{static_cast<TextureFormat>(1 + random.below(3)), texels, 1 + random.below(70), 1 + random.below(50), 1,
                 static_cast<TextureFilter>(random.below(2)), static_cast<TextureWrap>(random.below(3)),
                 static_cast<TextureWrap>(random.below(3))};
    if (group % 3 != 0) t.level_count = 1 + random.below(full_level_count(t.width, t.height));
    if (group == 13) t.format = TextureFormat::kNone;
    b.put(t).put(SetLight{group % 2, {0.6f, 0, 0.8f}, {0.2f, 0.2f, 0.2f}, {0.7f, 0.9f, 0.5f}});
    const float size = group < 5 ? 8.0f : group < 10 ? 60.0f : 700.0f;
    const int triangles = group < 5 ? 300 : group < 10 ? 50 : 8;
    const float reach = group % 4 == 0 ? 1.0f : group == 7 ? 1e9f : 12.0f;
    std::vector<Vec3> v;
    std::vector<Rgba8> c;
    std::vector<TexCoord> st;
    std::vector<PackedNormal> n;
    for (int i = 0; i < triangles * 3; ++i) {
      Vec3 p;
      p.x = i % 3 == 0 ? random.in(0, w) : v[static_cast<std::size_t>(i / 3 * 3)].x + random.in(-size, size);
      p.y = i % 3 == 0 ? random.in(0, h) : v[static_cast<std::size_t>(i / 3 * 3)].y + random.in(-size, size);
      p.z = random.in(-0.1f, 1.1f);
      v.push_back(p);
      c.push_back({random.next()});
      n.push_back({random.next() & 0x3FFFFFFFu});
      TexCoord place;
      place.s = random.in(-reach, reach);
      place.t = random.in(-reach, reach);
      st.push_back(place);
    }
    SetVertexStreams s;
    s.vertex_count = static_cast<std::uint32_t>(v.size());
    s.positions = b.upload(v);
    s.normals = b.upload(n);
    if (group % 6 != 5) s.colours = b.upload(c);
    s.constant_colour = rgba8(200, 250, 255, 230);
    s.texture_coordinates = b.upload(st);
    b.put(s);
    Mat4 m = b.pixel_transform();
    if (group % 2 != 0) {  // w varies across the window
      m.m[12] = 1.5f / w;
      m.m[13] = -0.5f / h;
    }
    b.put(SetTransform{m});
    b.draw(Topology::kTriangles, s.vertex_count).draw(Topology::kTriangleFan, 9);
    b.draw(Topology::kLines, 18).draw(Topology::kPoints, 12);
    std::vector<std::uint32_t> shuffled;
    for (std::uint32_t i = 0; i < 40; ++i) shuffled.push_back(random.below(s.vertex_count));
    b.draw_indexed(Topology::kTriangleStrip, shuffled);
  }
}

/// Both lists, one after the other.
void compose_all(Bench& b, std::uint32_t seed) {
  compose(b, seed);
  b.put(SetTransform{b.pixel_transform()});
  compose_fragments(b, seed);
}

struct Outcome {
  Vram vram;
  EngineCounters counters;
};

Outcome outcome(const EngineSetup& setup, PixelFormat format = PixelFormat::kXrgb8888,
                DepthFormat depth = DepthFormat::kUnorm24, std::uint32_t seed = 1,
                void (*draw)(Bench&, std::uint32_t) = compose_all) {
  Bench b(333, 211, format, depth);
  draw(b, seed);
  const auto report = b.run(setup);
  EXPECT_TRUE(report.status.ok()) << report.status.message;
  return {b.vram(), report.counters};
}

void expect_same(const Outcome& a, const Outcome& b) {
  EXPECT_TRUE(a.vram == b.vram);
  EXPECT_EQ(a.counters.faces_drawn, b.counters.faces_drawn);
  EXPECT_EQ(a.counters.pixels_tested, b.counters.pixels_tested);
  EXPECT_EQ(a.counters.pixels_cleared, b.counters.pixels_cleared);
  EXPECT_EQ(a.counters.vertices_transformed, b.counters.vertices_transformed);
  EXPECT_EQ(a.counters.primitives_in, b.counters.primitives_in);
  EXPECT_EQ(a.counters.texels_fetched, b.counters.texels_fetched);
  EXPECT_EQ(a.counters.pixels_blended, b.counters.pixels_blended);
}

TEST(Invariance, EveryKernelVariantGivesTheSameBytes) {
  for (const auto format : {PixelFormat::kRgb565, PixelFormat::kXrgb8888})
    for (const auto depth : {DepthFormat::kUnorm16, DepthFormat::kUnorm24})
      for (std::uint32_t seed = 1; seed < 5; ++seed) {
        const Outcome first = outcome({1u << 20, nullptr, soft::all_kernels()[0]}, format, depth, seed);
        EXPECT_GT(first.counters.pixels_tested, 100000u);
        EXPECT_GT(first.counters.texels_fetched, 100000u);
        EXPECT_GT(first.counters.pixels_blended, 100000u);
        for (const auto* kernels : soft::all_kernels())
          if (kernels->supported()) {
            SCOPED_TRACE(kernels->name);
            expect_same(first, outcome({1u << 20, nullptr, kernels}, format, depth, seed));
          }
      }
}

std::uint32_t crc32_of(const Vram& bytes) { return crc32(kCrc32Start, bytes); }

TEST(Invariance, EveryCompilerAndProcessorGivesTheseBytes) {
  // Approved with gcc 12 and clang 14. A change here is a change of the picture, and the goldens change with it.
  const auto crcs = [](void (*draw)(Bench&, std::uint32_t)) {
    return std::pair{
        crc32_of(outcome({}, PixelFormat::kXrgb8888, DepthFormat::kUnorm24, 1, draw).vram),
        crc32_of(outcome({}, PixelFormat::kRgb565, DepthFormat::kUnorm16, 2, draw).vram)};
  };
  EXPECT_EQ(crcs(compose), (std::pair{1185477057u, 3962769037u}));
  EXPECT_EQ(crcs(compose_fragments), (std::pair{2233138398u, 1713185058u}));
}

TEST(Invariance, ThreadsGiveTheSameBytes) {
  const Outcome alone = outcome({});
  for (const std::uint32_t threads : {1u, 2u, 3u, 5u}) {
    sim::ThreadRunner runner(threads);
    for (const std::size_t memory : {std::size_t{512} << 10, std::size_t{4} << 20}) {
      SCOPED_TRACE(threads);
      expect_same(alone, outcome({memory, &runner}));
    }
  }
}

TEST(Invariance, StoringPastTheCachesGivesTheSameBytes) {
  const auto drawn = [](const EngineSetup& setup) {
    Bench b(336, 211, PixelFormat::kXrgb8888, DepthFormat::kUnorm24, 0);  // 21 cache lines a row; the last tile is cut
    compose_all(b, 3);
    EXPECT_TRUE(b.run(setup).status.ok());
    return b.vram();
  };
  const auto cleared = [](const EngineSetup& setup) {
    Bench b(336, 211, PixelFormat::kXrgb8888, DepthFormat::kUnorm24, 0);
    b.put(Clear{kClearColour | kClearDepth, rgba8(10, 20, 30), 0.5f});
    b.put(SetScissor{3, 5, 101, 77}).put(Clear{kClearColour, rgba8(1, 2, 3), 1});  // rows that begin within a line
    EXPECT_TRUE(b.run(setup).status.ok());
    return b.vram();
  };
  sim::ThreadRunner runner(2);
  for (const auto* kernels : soft::all_kernels()) {
    if (!kernels->supported()) continue;
    SCOPED_TRACE(kernels->name);
    constexpr std::size_t kNever = ~std::size_t{0};
    EXPECT_TRUE(drawn({1u << 20, nullptr, kernels, kNever}) == drawn({1u << 20, nullptr, kernels, 0}));
    EXPECT_TRUE(drawn({1u << 20, nullptr, kernels, kNever}) == drawn({1u << 20, &runner, kernels, 0}));
    EXPECT_TRUE(cleared({1u << 20, nullptr, kernels, kNever}) == cleared({1u << 20, nullptr, kernels, 0}));
  }
}

TEST(Invariance, ManyRoundsOverLittleMemoryGiveTheSameBytes) {
  const Outcome roomy = outcome({16u << 20});
  const std::size_t least = SoftEngine::minimum_work_bytes(333, 211);
  for (const std::size_t memory : {least, least + 1000, 2 * least, std::size_t{200} << 10}) {
    SCOPED_TRACE(memory);
    expect_same(roomy, outcome({memory}));
    sim::ThreadRunner runner(2);
    expect_same(roomy, outcome({memory, &runner}));
  }
}

TEST(Invariance, UnalignedWorkingMemoryIsFine) {
  std::vector<std::byte> work((1u << 20) + 7);
  Bench a(333, 211, PixelFormat::kXrgb8888, DepthFormat::kUnorm24);
  compose_all(a, 1);
  SoftEngine engine({std::span(work).subspan(7), nullptr, nullptr});
  ASSERT_TRUE(a.run_on(engine).status.ok());
  EXPECT_TRUE(a.vram() == outcome({}).vram);
}

TEST(Invariance, TheSameEngineRunsListAfterListAndTargetAfterTarget) {
  std::vector<std::byte> work(2u << 20);
  SoftEngine engine({work, nullptr, nullptr});
  for (int run = 0; run < 3; ++run) {
    Bench a(333, 211, PixelFormat::kXrgb8888, DepthFormat::kUnorm24), small(40, 30);
    compose_all(a, 1);
    ASSERT_TRUE(a.run_on(engine).status.ok());
    EXPECT_TRUE(a.vram() == outcome({}).vram);
    small.streams({{0, 0, 0}, {40, 0, 0}, {0, 30, 0}}).draw(Topology::kTriangles, 3);
    ASSERT_TRUE(small.run_on(engine).status.ok());
    EXPECT_EQ(small.pixel(2, 2), 0xFFFFFFFFu);
  }
}

TEST(WorkMemory, BelowTheMinimumEndsTheListWithTheReason) {
  for (const auto& [width, height] :
       {std::pair{16u, 16u}, std::pair{480u, 272u}, std::pair{1920u, 720u}, std::pair{4096u, 4096u}}) {
    const std::size_t least = SoftEngine::minimum_work_bytes(width, height);
    Bench b(width, height);
    b.streams({{-5, -5, 0}, {9000, -5, 0}, {-5, 9000, 0}}).draw(Topology::kTriangles, 3);
    EXPECT_TRUE(b.run({least}).status.ok()) << width;
    EXPECT_EQ(b.pixel(width - 1, height - 1), 0xFFFFFFFFu);
    Bench starved(width, height);
    starved.streams({{-5, -5, 0}, {9000, -5, 0}, {-5, 9000, 0}}).draw(Topology::kTriangles, 3);
    const auto status = starved.run({least / 3}).status;
    EXPECT_EQ(status.code, StatusCode::kResourceExhausted);
    EXPECT_EQ(status.where, starved.used_words() - 1 - kPayloadWords<Draw>);
    EXPECT_EQ(starved.covered(), 0u);
  }
}

}  // namespace
}  // namespace usuzumi::gfx::test
