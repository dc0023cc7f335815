// Lists that are wrong: execution stops at the word with the fault, what came before is drawn, and nothing else
// happens.
#include <limits>

#include "tests/gfx_subsystem/engine_soft/test_bench.h"

namespace usuzumi::gfx::test {
namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();

/// A bench that has drawn a triangle, and then meets the packet.
struct FaultBench {
  Bench b{32, 32, PixelFormat::kXrgb8888, DepthFormat::kUnorm16};
  FaultBench() { b.streams({{0, 0, 0}, {32, 0, 0}, {0, 32, 0}}).draw(Topology::kTriangles, 3); }

  template <class Packet>
  void expect(const Packet& p, StatusCode code) {
    const std::uint32_t word = b.used_words();
    b.put(p);
    b.put(Clear{kClearColour, rgba8(1, 1, 1), 1});  // must not happen
    const auto report = b.run();
    EXPECT_EQ(report.status.code, code) << report.status.message;
    EXPECT_EQ(report.status.where, word);
    EXPECT_EQ(report.counters.command_words, word);
    EXPECT_EQ(b.pixel(2, 2), 0xFFFFFFFFu) << "what was drawn before stays drawn";
    EXPECT_EQ(b.pixel(31, 31), 0u);
  }
};

template <class Packet>
void expect_fault(const Packet& p, StatusCode code = StatusCode::kInvalidArgument) { FaultBench().expect(p, code); }

TEST(Faults, TargetsThatAreNotSoundAreRefused) {
  const auto colour = [](auto change) {
    SetColourTarget t{kVram, 128, 32, 32, PixelFormat::kXrgb8888};
    change(t);
    expect_fault(t);
  };
  colour([](auto& t) { t.width = 0; });
  colour([](auto& t) { t.height = 4097; });
  colour([](auto& t) { t.base += 2; });
  colour([](auto& t) { t.stride_bytes = 126; });
  colour([](auto& t) { t.stride_bytes = 124; });
  colour([](auto& t) { t.base = 0x20; });
  colour([](auto& t) { t.height = 4000; });
  colour([](auto& t) { t.format = static_cast<PixelFormat>(2); });
  expect_fault(SetDepthTarget{kVram, 64, DepthFormat::kUnorm16});  // overlaps
  expect_fault(SetDepthTarget{kVram + 4096, 60, DepthFormat::kUnorm16});
  expect_fault(SetDepthTarget{kVram + 4096, 64, static_cast<DepthFormat>(3)});
}

TEST(Faults, StateOutOfRangeIsRefused) {
  expect_fault(SetViewport{0, 0, 0, 10, 0, 1});
  expect_fault(SetViewport{0, 0, kNan, 10, 0, 1});
  expect_fault(SetViewport{0, 0, 10, 10, -0.1f, 1});
  Mat4 m;
  m.m[5] = kNan;
  expect_fault(SetTransform{m});
  expect_fault(SetLight{2, {}, {}, {}});
  expect_fault(SetLight{1, {0, 0, 1}, {-1, 0, 0}, {}});
  SetRasterState r;
  r.point_size = 65;
  expect_fault(r);
  r = {};
  r.line_width = 0.5f;
  expect_fault(r);
  r = {};
  r.cull = static_cast<CullMode>(3);
  expect_fault(r);
  expect_fault(Clear{4, {}, 1});
  expect_fault(Clear{kClearDepth, {}, 1.5f});
}

TEST(Faults, StreamsAndDrawsBeyondMemoryAreRefused) {
  SetVertexStreams s;
  expect_fault(s);
  s.vertex_count = 3;
  s.positions = kRam + 2;
  expect_fault(s);
  s.positions = kRam;
  s.position_stride = 8;
  expect_fault(s);
  s.position_stride = 12;
  s.vertex_count = 1u << 30;
  expect_fault(s);
  s.vertex_count = 3;
  s.texture_coordinates = kRam + 2;
  expect_fault(s);
  expect_fault(Draw{Topology::kTriangles, IndexFormat::kNone, 0, 1, 3});
  expect_fault(Draw{Topology::kTriangles, IndexFormat::kU16, kRam + 1, 0, 3});
  expect_fault(Draw{Topology::kTriangles, IndexFormat::kU32, kRam, 0, 1u << 30});
  expect_fault(Draw{Topology::kTriangles, IndexFormat::kU32, 0x8, 0, 3});
  expect_fault(Draw{static_cast<Topology>(5), IndexFormat::kNone, 0, 0, 3});
}

TEST(Faults, IndexBeyondTheStreamsIsRefused) {
  FaultBench f;
  const BusAddress indices = f.b.upload(std::vector<std::uint32_t>{0, 1, 3});
  f.expect(Draw{Topology::kTriangles, IndexFormat::kU32, indices, 0, 3}, StatusCode::kInvalidArgument);
}

TEST(Faults, VerticesInsideTheTargetAreRefused) {
  FaultBench f;
  SetVertexStreams s;
  s.vertex_count = 3;
  s.positions = kVram + 64;
  f.b.put(s);
  f.expect(Draw{Topology::kTriangles, IndexFormat::kNone, 0, 0, 3}, StatusCode::kInvalidArgument);
}

TEST(Faults, DrawingWithoutTargetOrStreamsIsRefused) {
  std::vector<std::byte> work(1u << 20);
  SoftEngine engine({work, nullptr, nullptr});
  FlatMemory memory(4096, 4096);
  for (int kind = 0; kind < 2; ++kind) {
    std::uint32_t words[64] = {};
    Writer list(words);
    if (kind == 0) list.put(Clear{kClearColour, {}, 1});
    else
      list.put(SetColourTarget{kVram, 64, 16, 16, PixelFormat::kXrgb8888}),
          list.put(Draw{Topology::kTriangles, IndexFormat::kNone, 0, 0, 3});
    EXPECT_EQ(engine.execute(*list.finish(), memory).status.code, StatusCode::kFailedPrecondition);
  }
}

TEST(Faults, PacketsThatAreNoPacketsStopTheList) {
  struct Case { std::uint32_t word; StatusCode code; };
  for (const auto& c : {Case{0x7F000000u, StatusCode::kUnsupported}, Case{0x22000000u, StatusCode::kUnsupported},
                        Case{0x10010003u, StatusCode::kDataLoss}, Case{0x10000002u, StatusCode::kDataLoss},
                        Case{0x1000FFFFu, StatusCode::kDataLoss}}) {
    FaultBench f;
    const std::uint32_t word = f.b.used_words();
    f.b.raw(c.word).raw(0).raw(0).raw(0);
    const auto report = f.b.run();
    EXPECT_EQ(report.status.code, c.code) << std::hex << c.word;
    EXPECT_EQ(report.status.where, word);
    EXPECT_EQ(f.b.pixel(2, 2), 0xFFFFFFFFu);
  }
}

TEST(Faults, ListWithoutItsEndSaysSo) {
  std::vector<std::byte> work(1u << 20);
  SoftEngine engine({work, nullptr, nullptr});
  FlatMemory memory(4096, 4096);
  EXPECT_EQ(engine.execute({}, memory).status.code, StatusCode::kDataLoss);
}

TEST(Faults, RandomWordsNeverCrash) {
  // Random words, and sound lists with random words changed: most of the fuzz then reaches the raster.
  std::vector<std::byte> work(256u << 10);
  SoftEngine engine({work, nullptr, nullptr});
  Random random(42);
  for (int n = 0; n < 400; ++n) {
    std::vector<std::uint32_t> words(64);
    FlatMemory memory(4096, 65536);
    for (auto& w : words) w = random.below(3) == 0 ? (random.below(18) << 24 | random.below(20)) : random.next();
    static_cast<void>(engine.execute(words, memory));
  }
  for (int n = 0; n < 3000; ++n) {
    std::uint32_t words[160] = {};
    FlatMemory memory(8192, 32768);
    for (auto& byte : memory.ram) byte = static_cast<std::byte>(random.next() >> 7);
    Writer list(words);
    list.put(SetColourTarget{kVram, 100, 1 + random.below(50), 1 + random.below(90),
                             random.below(2) != 0 ? PixelFormat::kRgb565 : PixelFormat::kXrgb8888});
    list.put(SetDepthTarget{kVram + 16384, 100, random.below(2) != 0 ? DepthFormat::kUnorm16 : DepthFormat::kNone});
    list.put(SetVertexStreams{300, kRam, 12, kRam, 12, kRam, 12, {}, 0, 0});
    SetTransform transform;
    for (float& v : transform.model_to_clip.m) v = random.in(-2, 2);
    list.put(transform);
    list.put(SetLight{random.below(2), {0, 0, 1}, {0.5f, 0.5f, 0.5f}, {1, 1, 1}});
    list.put(SetRasterState{static_cast<ShadeModel>(random.below(2)), static_cast<CullMode>(random.below(3)),
                            FrontFace::kClockwise, static_cast<DepthFunction>(random.below(3)), 0, 1, 5, 3});
    list.put(Draw{static_cast<Topology>(random.below(5)), IndexFormat::kNone, 0, random.below(100), random.below(200)});
    const auto finished = *list.finish();
    if (n % 2 != 0) words[random.below(static_cast<std::uint32_t>(finished.size()))] = random.next();
    static_cast<void>(engine.execute({words, finished.size()}, memory));
  }
}

}  // namespace
}  // namespace usuzumi::gfx::test
