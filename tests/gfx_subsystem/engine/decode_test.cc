// The command decoder: what it lets through, what it refuses, and at which word. Packets are written out as words where
// the wire format is the point, and by command::Writer where the values are.
#include <limits>

#include "tests/gfx_subsystem/engine/decode_fixture.h"

namespace usuzumi::gfx {
namespace {

// ---- the wire

TEST_F(DecodeTest, AnEndAloneIsAList) {
  EXPECT_TRUE(decode_words({0}).ok());
  EXPECT_EQ(words_consumed, 1u);
}

TEST_F(DecodeTest, WordsAfterTheEndAreNotLookedAt) {
  EXPECT_TRUE(decode_words({0, 0xFFFFFFFFu}).ok());
  EXPECT_EQ(words_consumed, 1u);
}

TEST_F(DecodeTest, AListWithoutEndIsCorrupt) {
  EXPECT_EQ(decode_words({}).code, StatusCode::kDataLoss);
  const Status status = decode_words({0x03000004u, 0, 0, 1, 1});
  EXPECT_EQ(status.code, StatusCode::kDataLoss);
  EXPECT_EQ(status.where, 5u);
}

TEST_F(DecodeTest, APacketPastTheEndOfTheListIsCorrupt) {
  const Status status = decode_words({0x03000004u, 0, 0, 1, 1, 0x03000004u, 0, 0, 1});
  EXPECT_EQ(status.code, StatusCode::kDataLoss);
  EXPECT_EQ(status.where, 5u);
}

TEST_F(DecodeTest, AWrongLengthIsCorrupt) {
  EXPECT_EQ(decode_words({0x03000003u, 0, 0, 1, 0}).code, StatusCode::kDataLoss);
  EXPECT_EQ(decode_words({0x03000005u, 0, 0, 1, 1, 1, 0}).code, StatusCode::kDataLoss);
  EXPECT_EQ(decode_words({0x03000000u, 0}).code, StatusCode::kDataLoss);
  EXPECT_EQ(decode_words({0x00000001u, 0}).code, StatusCode::kDataLoss) << "the end has no payload";
}

TEST_F(DecodeTest, SpareHeaderBitsMustBeZero) {
  for (unsigned bit = 16; bit < 24; ++bit)
    EXPECT_EQ(decode_words({0x03000004u | 1u << bit, 0, 0, 1, 1, 0}).code, StatusCode::kDataLoss) << "bit " << bit;
}

TEST_F(DecodeTest, EveryUnknownOpcodeIsUnsupported) {
  for (std::uint32_t opcode = 1; opcode < 256; ++opcode) {
    if (opcode <= 0x08 || opcode == 0x10 || opcode == 0x11 || opcode == 0x20 || opcode == 0x21) continue;
    const Status status = decode_words({opcode << 24, 0});
    EXPECT_EQ(status.code, StatusCode::kUnsupported) << "opcode " << opcode;
    EXPECT_EQ(status.where, 0u);
  }
}

// ---- targets

TEST_F(DecodeTest, ATargetBringsItsMemoryAndResetsViewportScissorAndDepth) {
  ASSERT_TRUE(decode_packets(kGoodTarget, kGoodDepth, SetScissor{1, 1, 2, 2}, SetViewport{1, 1, 2, 2, 0.25f, 0.5f},
                             kGoodTarget, Clear{kClearColour, {}, 1})
                  .ok());
  EXPECT_EQ(sink.last.colour_memory.data(), memory.ram.data());
  EXPECT_EQ(sink.last.colour_memory.size(), 128u);
  EXPECT_TRUE(sink.last.depth_memory.empty());
  EXPECT_EQ(sink.last.scissor.width, 8u);
  EXPECT_EQ(sink.last.scissor.height, 4u);
  EXPECT_EQ(sink.last.viewport.width, 8.0f);
  EXPECT_EQ(sink.last.viewport.far_depth, 1.0f);
}

TEST_F(DecodeTest, TheLastRowMayEndAtItsLastPixel) {
  // 0x200 bytes of RAM: rows of 8 bytes, 0x80 apart, from 0x78 on: the fourth ends exactly at the end.
  EXPECT_TRUE(decode_packets(SetColourTarget{kTarget + 0x78, 0x80, 2, 4, PixelFormat::kXrgb8888}).ok());
  EXPECT_FALSE(decode_packets(SetColourTarget{kTarget + 0x7C, 0x80, 2, 4, PixelFormat::kXrgb8888}).ok());
}

TEST_F(DecodeTest, ColourTargetsAreChecked) {
  const auto with = [](auto change) {
    SetColourTarget t = kGoodTarget;
    change(t);
    return t;
  };
  expect_refused(with([](auto& t) { t.format = static_cast<PixelFormat>(2); }), "format");
  expect_refused(with([](auto& t) { t.width = 0; }), "no width");
  expect_refused(with([](auto& t) { t.height = 0; }), "no height");
  expect_refused(with([](auto& t) { t.width = 4097; }), "too wide");
  expect_refused(with([](auto& t) { t.height = 4097; }), "too high");
  expect_refused(with([](auto& t) { t.base += 2; }), "base");
  expect_refused(with([](auto& t) { t.stride_bytes += 2; }), "stride unaligned");
  expect_refused(with([](auto& t) { t.stride_bytes = 28; }), "stride shorter than a row");
  expect_refused(with([](auto& t) { t.height = 17; }), "beyond memory");
  expect_refused(with([](auto& t) { t.base = kReadOnly, t.height = 1; }), "read-only memory");
}

TEST_F(DecodeTest, TargetsAbove4096AreRefusedForTheirSizeAlone) {
  const SetColourTarget wide{kTarget, 4 * 4097, 4097, 1, PixelFormat::kXrgb8888};
  EXPECT_STREQ(decode_packets(wide).message, "colour target: width and height must be 1 to 4096");
  const SetColourTarget high{kTarget, 32, 8, 4097, PixelFormat::kXrgb8888};
  EXPECT_STREQ(decode_packets(high).message, "colour target: width and height must be 1 to 4096");
}

TEST_F(DecodeTest, DepthTargetsAreChecked) {
  expect_refused(SetDepthTarget{kDepth, 32, static_cast<DepthFormat>(3)}, "format");
  expect_refused(SetDepthTarget{kDepth + 2, 32, DepthFormat::kUnorm24}, "base");
  expect_refused(SetDepthTarget{kDepth, 30, DepthFormat::kUnorm16}, "stride unaligned");
  expect_refused(SetDepthTarget{kDepth, 28, DepthFormat::kUnorm24}, "stride shorter than a row");
  expect_refused(SetDepthTarget{kTarget + 0x1C0, 32, DepthFormat::kUnorm24}, "beyond memory");
  expect_refused(SetDepthTarget{kTarget + 124, 32, DepthFormat::kUnorm24}, "overlaps the colour target's last pixel");
  EXPECT_EQ(decode_packets(kGoodDepth).code, StatusCode::kFailedPrecondition) << "no colour target to measure by";
  EXPECT_TRUE(decode_packets(SetDepthTarget{}).ok()) << "no depth needs no colour";
}

TEST_F(DecodeTest, ScissorIsClippedToTheTargetWithoutOverflow) {
  constexpr std::uint32_t kHuge = 0xFFFFFFFFu;
  ASSERT_TRUE(decode_packets(kGoodTarget, SetScissor{2, 1, kHuge, kHuge}, Clear{kClearColour, {}, 1}).ok());
  EXPECT_EQ(sink.last.scissor.x, 2u);
  EXPECT_EQ(sink.last.scissor.width, 6u);
  EXPECT_EQ(sink.last.scissor.height, 3u);
  ASSERT_TRUE(decode_packets(kGoodTarget, SetScissor{kHuge, 4, kHuge, 1}, Clear{kClearColour, {}, 1}).ok());
  EXPECT_EQ(sink.last.scissor.width, 0u);
  EXPECT_EQ(sink.last.scissor.height, 0u);
}

// ---- state

TEST_F(DecodeTest, ViewportsAreChecked) {
  EXPECT_TRUE(decode_packets(SetViewport{-8192, 8192, 8192, 0.5f, 1, 0}).ok());
  expect_refused(SetViewport{0, 0, 0, 4, 0, 1}, "no width");
  expect_refused(SetViewport{0, 0, 8, -4, 0, 1}, "negative height");
  expect_refused(SetViewport{8193, 0, 8, 4, 0, 1}, "too far out");
  expect_refused(SetViewport{kNan, 0, 8, 4, 0, 1}, "not a number");
  expect_refused(SetViewport{0, 0, kInfinity, 4, 0, 1}, "infinite");
  expect_refused(SetViewport{0, 0, 8, 4, -0.01f, 1}, "near depth");
  expect_refused(SetViewport{0, 0, 8, 4, 0, 1.01f}, "far depth");
  expect_refused(SetViewport{0, 0, 8, 4, 0, kNan}, "depth not a number");
}

TEST_F(DecodeTest, EveryElementOfATransformMustBeFinite) {
  for (int i = 0; i < 16; ++i)
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
      SetTransform t;
      t.model_to_clip.m[i] = bad;
      expect_refused(t, "element " + std::to_string(i));
    }
}

TEST_F(DecodeTest, LightsAreChecked) {
  expect_refused(SetLight{2, {0, 0, 1}, {}, {}}, "enabled");
  expect_refused(SetLight{1, {kNan, 0, 1}, {}, {}}, "direction");
  expect_refused(SetLight{1, {0, 0, 1}, {-0.1f, 0, 0}, {}}, "negative ambient");
  expect_refused(SetLight{1, {0, 0, 1}, {}, {0, kInfinity, 0}}, "infinite diffuse");
  EXPECT_TRUE(decode_packets(SetLight{1, {0, 0, 1}, {2, 2, 2}, {3, 0, 0}}).ok()) << "above 1 is saturated, not refused";
}

TEST_F(DecodeTest, RasterStatesAreChecked) {
  const auto with = [](auto change) {
    SetRasterState r;
    change(r);
    return r;
  };
  expect_refused(with([](auto& r) { r.shade_model = static_cast<ShadeModel>(2); }), "shade model");
  expect_refused(with([](auto& r) { r.cull = static_cast<CullMode>(3); }), "cull");
  expect_refused(with([](auto& r) { r.front_face = static_cast<FrontFace>(2); }), "front face");
  expect_refused(with([](auto& r) { r.depth_function = static_cast<DepthFunction>(3); }), "depth function");
  expect_refused(with([](auto& r) { r.depth_test = 2; }), "depth test");
  expect_refused(with([](auto& r) { r.depth_write = 2; }), "depth write");
  expect_refused(with([](auto& r) { r.point_size = 0.5f; }), "point too small");
  expect_refused(with([](auto& r) { r.line_width = 64.5f; }), "line too wide");
  expect_refused(with([](auto& r) { r.point_size = kNan; }), "point size not a number");
}

TEST_F(DecodeTest, StreamsAreChecked) {
  const auto with = [](auto change) {
    SetVertexStreams s = good_streams();
    change(s);
    return s;
  };
  expect_refused(with([](auto& s) { s.vertex_count = 0; }), "no vertices");
  expect_refused(with([](auto& s) { s.positions = 0; }), "no positions");
  expect_refused(with([](auto& s) { s.positions += 2; }), "unaligned");
  expect_refused(with([](auto& s) { s.position_stride = 8; }), "stride shorter than an element");
  expect_refused(with([](auto& s) { s.position_stride = 14; }), "stride unaligned");
  expect_refused(with([](auto& s) { s.vertex_count = 22; }), "beyond memory: 22 * 12 > 256");
  expect_refused(with([](auto& s) { s.vertex_count = 0xFFFFFFFFu; }), "longer than the address space");
  expect_refused(with([](auto& s) { s.normals = 0x3000; }), "normals not in memory");
  expect_refused(with([](auto& s) { s.colours = kVertices, s.colour_stride = 0; }), "colour stride 0");
  EXPECT_TRUE(decode_packets(with([](auto& s) { s.positions = kReadOnly, s.vertex_count = 5; })).ok())
      << "60 of 64 bytes";
  expect_refused(with([](auto& s) { s.texture_coordinates = kVertices + 2; }), "texture coordinates unaligned");
  expect_refused(with([](auto& s) { s.texture_coordinates = kVertices, s.texture_coordinate_stride = 4; }),
                 "texture coordinate stride shorter than an element");
  expect_refused(with([](auto& s) { s.texture_coordinates = 0x3000; }), "texture coordinates not in memory");
}

TEST_F(DecodeTest, AFaultKeepsLaterDrawsFromTheEngine) {
  SetVertexStreams bad = good_streams();
  bad.positions = 0x3000;
  const Draw one{Topology::kPoints, IndexFormat::kNone, 0, 0, 1};
  EXPECT_EQ(decode_packets(kGoodTarget, good_streams(), one, bad, one).where, 23u);
  EXPECT_EQ(sink.draws.size(), 1u) << "what came before the fault is drawn";
}

// ---- clears and draws

TEST_F(DecodeTest, ClearsNeedTheirTargets) {
  EXPECT_EQ(decode_packets(Clear{kClearColour, {}, 1}).code, StatusCode::kFailedPrecondition);
  EXPECT_EQ(decode_packets(kGoodTarget, Clear{kClearDepth, {}, 1}).code, StatusCode::kFailedPrecondition);
  expect_refused(Clear{4, {}, 1}, "undefined plane");
  expect_refused(Clear{kClearDepth, {}, 1.5f}, "depth above 1");
  expect_refused(Clear{kClearDepth, {}, kNan}, "depth not a number");
  EXPECT_TRUE(sink.clears.empty());
  EXPECT_TRUE(decode_packets(kGoodTarget, kGoodDepth, Clear{kClearColour | kClearDepth, {}, 0}).ok());
  EXPECT_EQ(sink.clears.size(), 1u);
}

TEST_F(DecodeTest, DrawsNeedTargetStreamsAndDepth) {
  const Draw draw{Topology::kTriangles, IndexFormat::kNone, 0, 0, 3};
  EXPECT_EQ(decode_packets(good_streams(), draw).code, StatusCode::kFailedPrecondition);
  EXPECT_EQ(decode_packets(kGoodTarget, draw).code, StatusCode::kFailedPrecondition);
  SetRasterState depth_tested;
  depth_tested.depth_test = 1;
  EXPECT_EQ(decode_packets(kGoodTarget, good_streams(), depth_tested, draw).code, StatusCode::kFailedPrecondition);
  EXPECT_TRUE(decode_packets(kGoodTarget, kGoodDepth, good_streams(), depth_tested, draw).ok());
  EXPECT_EQ(sink.draws.size(), 1u);
}

TEST_F(DecodeTest, UnindexedDrawsMayReachTheLastVertexAndNotBeyond) {
  ASSERT_TRUE(decode_packets(kGoodTarget, good_streams(), Draw{Topology::kPoints, IndexFormat::kNone, 0, 5, 3}).ok());
  EXPECT_EQ(sink.draws[0].min_vertex, 5u);
  EXPECT_EQ(sink.draws[0].max_vertex, 7u);
  EXPECT_EQ(sink.draws[0].vertex(2), 7u);
  EXPECT_EQ(sink.draws[0].word, 17u);
  sink.draws.clear();
  expect_draw_refused({Topology::kPoints, IndexFormat::kNone, 0, 6, 3}, "one beyond");
  expect_draw_refused({Topology::kPoints, IndexFormat::kNone, 0, 9, 1}, "begins beyond");
  expect_draw_refused({Topology::kPoints, IndexFormat::kNone, 0, 1, 0xFFFFFFFFu}, "sum overflows");
}

TEST_F(DecodeTest, IndicesAreReadFromFirstOnAndRanged) {
  memory.store<std::uint16_t>(kIndices, {9999, 3, 1, 6});
  ASSERT_TRUE(
      decode_packets(kGoodTarget, good_streams(), Draw{Topology::kTriangles, IndexFormat::kU16, kIndices, 1, 3}).ok());
  EXPECT_EQ(sink.draws[0].min_vertex, 1u);
  EXPECT_EQ(sink.draws[0].max_vertex, 6u);
  EXPECT_EQ(sink.draws[0].vertex(0), 3u);
  EXPECT_EQ(sink.draws[0].vertex(2), 6u);
  memory.store<std::uint32_t>(kIndices, {7, 0, 2});
  ASSERT_TRUE(
      decode_packets(kGoodTarget, good_streams(), Draw{Topology::kTriangles, IndexFormat::kU32, kIndices, 0, 3}).ok());
  EXPECT_EQ(sink.draws[1].max_vertex, 7u);
  EXPECT_EQ(sink.draws[1].vertex(1), 0u);
}

TEST_F(DecodeTest, BadIndicesAreRefused) {
  memory.store<std::uint32_t>(kIndices, {7, 0, 8});
  expect_draw_refused({Topology::kTriangles, IndexFormat::kU32, kIndices, 0, 3}, "index 8 of 8 vertices");
  memory.store<std::uint16_t>(kIndices, {0, 1, 0xFFFF});
  expect_draw_refused({Topology::kTriangles, IndexFormat::kU16, kIndices, 0, 3}, "largest 16-bit index");
  expect_draw_refused({Topology::kTriangles, IndexFormat::kU16, kIndices + 1, 0, 2}, "16-bit unaligned");
  expect_draw_refused({Topology::kTriangles, IndexFormat::kU32, kIndices + 2, 0, 2}, "32-bit unaligned");
  expect_draw_refused({Topology::kTriangles, IndexFormat::kU32, kTarget + 0x1FC, 0, 2}, "beyond memory");
  expect_draw_refused({Topology::kTriangles, IndexFormat::kU32, kIndices, 0xFFFFFFFFu, 0xFFFFFFFFu}, "overflow");
  expect_draw_refused({Topology::kTriangles, IndexFormat::kU32, kIndices, 0xFFFFFFFFu, 2}, "sum overflows to 1");
  expect_draw_refused({static_cast<Topology>(5), IndexFormat::kNone, 0, 0, 3}, "topology");
  expect_draw_refused({Topology::kTriangles, static_cast<IndexFormat>(3), 0, 0, 3}, "index format");
}

// Indices are ranged several at a time; wherever the least, the greatest or a bad one lies, it is found.
TEST_F(DecodeTest, TheRangeOfIndicesSeesEveryPlaceOfEveryLength) {
  const auto put = [&](IndexFormat format, std::uint32_t place, std::uint32_t index) {
    if (format == IndexFormat::kU16)
      memory.store<std::uint16_t>(kIndices + 2 * place, {static_cast<std::uint16_t>(index)});
    else memory.store<std::uint32_t>(kIndices + 4 * place, {index});
  };
  for (const IndexFormat format : {IndexFormat::kU16, IndexFormat::kU32}) {
    const std::uint32_t most = format == IndexFormat::kU16 ? 64 : 32;  // what the memory holds
    for (std::uint32_t count = 1; count <= most; ++count) {
      const Draw draw{Topology::kPoints, format, kIndices, 0, count};
      for (std::uint32_t i = 0; i < count; ++i) put(format, i, 5);
      for (std::uint32_t place = 0; place < count; ++place) {
        SCOPED_TRACE(std::to_string(place) + " of " + std::to_string(count));
        for (const std::uint32_t index : {2u, 7u}) {
          sink.draws.clear();
          put(format, place, index);
          ASSERT_TRUE(decode_packets(kGoodTarget, good_streams(), draw).ok());
          const std::uint32_t others = count > 1 ? 5 : index;
          ASSERT_EQ(sink.draws[0].min_vertex, std::min(index, others));
          ASSERT_EQ(sink.draws[0].max_vertex, std::max(index, others));
        }
        for (const std::uint32_t bad : {8u, 0x8000u, 0xFFFFu, 0x80000000u, 0xFFFFFFFFu}) {
          if (format == IndexFormat::kU16 && bad > 0xFFFF) continue;
          put(format, place, bad);
          ASSERT_FALSE(decode_packets(kGoodTarget, good_streams(), draw).ok()) << bad;
        }
        put(format, place, 5);
      }
    }
  }
}

TEST_F(DecodeTest, VerticesAndIndicesMustNotLieInATarget) {
  SetVertexStreams in_colour = good_streams();
  in_colour.positions = kTarget + 116;  // the last 12 bytes of the colour target
  in_colour.vertex_count = 1;
  const Draw one{Topology::kPoints, IndexFormat::kNone, 0, 0, 1};
  EXPECT_EQ(decode_packets(kGoodTarget, in_colour, one).code, StatusCode::kInvalidArgument);
  EXPECT_EQ(
      decode_packets(kGoodTarget, kGoodDepth, good_streams(), Draw{Topology::kPoints, IndexFormat::kU16, kDepth, 0, 1})
          .code,
      StatusCode::kInvalidArgument);
  in_colour.positions = kTarget + 128;
  EXPECT_TRUE(decode_packets(kGoodTarget, in_colour, one).ok()) << "right behind it is free, when depth is off";
}

TEST_F(DecodeTest, ADrawOfNothingIsNotPassedOn) {
  EXPECT_TRUE(
      decode_packets(kGoodTarget, good_streams(), Draw{Topology::kTriangles, IndexFormat::kU32, 0x3000, 0, 0}).ok());
  EXPECT_TRUE(sink.draws.empty());
}

TEST_F(DecodeTest, TheSinksFaultStopsTheListAtItsPacket) {
  sink.answer = {StatusCode::kResourceExhausted, "too large", 12345};
  const Status status = decode_packets(kGoodTarget, Clear{kClearColour, {}, 1}, Clear{kClearColour, {}, 1});
  EXPECT_EQ(status.code, StatusCode::kResourceExhausted);
  EXPECT_EQ(status.where, 6u);
  EXPECT_EQ(sink.clears.size(), 1u);
}

TEST_F(DecodeTest, StateHoldsFromPacketToPacket) {
  SetTransform moved;
  moved.model_to_clip.m[3] = 5;
  ASSERT_TRUE(decode_packets(kGoodTarget, good_streams(), moved, Draw{Topology::kPoints, IndexFormat::kNone, 0, 0, 1},
                             Draw{Topology::kPoints, IndexFormat::kNone, 0, 1, 1})
                  .ok());
  ASSERT_EQ(sink.draws.size(), 2u);
  EXPECT_EQ(sink.last.transform.model_to_clip.m[3], 5.0f);
  EXPECT_EQ(sink.last.positions.size(), 96u);
  EXPECT_TRUE(sink.last.normals.empty());
}

TEST(FaceCount, CountsTheTrianglesOfEachTopology) {
  EXPECT_EQ(face_count(Topology::kTriangles, 7), 2u);
  EXPECT_EQ(face_count(Topology::kTriangleStrip, 7), 5u);
  EXPECT_EQ(face_count(Topology::kTriangleFan, 3), 1u);
  EXPECT_EQ(face_count(Topology::kTriangleStrip, 2), 0u);
  EXPECT_EQ(face_count(Topology::kTriangleFan, 0), 0u);
  EXPECT_EQ(face_count(Topology::kLines, 6), 0u);
  EXPECT_EQ(face_count(Topology::kPoints, 6), 0u);
}

}  // namespace
}  // namespace usuzumi::gfx
