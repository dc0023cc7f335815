// The command decoder on textures: which images, streams and fragment states it lets through, and which it refuses.
#include "gfx_subsystem/engine/texture_layout.h"
#include "tests/gfx_subsystem/engine/decode_fixture.h"

namespace usuzumi::gfx {
namespace {

/// 4 x 4 of 16 bits and two levels below: 32 + 8 + 4 of the read-only memory's 64 bytes.
SetTexture good_texture() {
  return {TextureFormat::kRgb565, kReadOnly, 4, 4, 3, TextureFilter::kNearest, TextureWrap::kClamp,
          TextureWrap::kMirror};
}

SetVertexStreams textured_streams() {
  SetVertexStreams s = good_streams();
  s.vertex_count = 4;
  s.texture_coordinates = kVertices + 48;
  return s;
}

constexpr Draw kOnePoint{Topology::kPoints, IndexFormat::kNone, 0, 0, 1};

TEST(TextureLayout, LevelsHalveDownToOneTexelInRowsOfWholeWords) {
  // 5 x 3 of 16 bits: rows of 12 bytes; then 2 x 1 in 4, then 1 x 1 in 4.
  const SetTexture t{TextureFormat::kRgb565, 0, 5, 3, 3, {}, {}, {}};
  EXPECT_EQ(full_level_count(5, 3), 3u);
  EXPECT_EQ(level_pitch(t, 0), 12u);
  EXPECT_EQ(level_offset(t, 1), 36u);
  EXPECT_EQ(level_pitch(t, 1), 4u);
  EXPECT_EQ(level_offset(t, 2), 40u);
  EXPECT_EQ(texture_bytes(t), 44u);
  EXPECT_EQ(full_level_count(1, 1), 1u);
  EXPECT_EQ(full_level_count(4096, 1), 13u);
  // 4^12 * 4 bytes and a third: the geometric sum of 13 levels.
  const SetTexture largest{TextureFormat::kArgb8888, 0, 4096, 4096, 13, {}, {}, {}};
  EXPECT_EQ(texture_bytes(largest), 4u * ((1u << 26) - 1) / 3);
}

TEST_F(DecodeTest, ATextureBringsAllItsLevels) {
  ASSERT_TRUE(decode_packets(kGoodTarget, textured_streams(), good_texture(), kOnePoint).ok());
  ASSERT_EQ(sink.draws.size(), 1u);
  EXPECT_EQ(sink.last.texels.data(), memory.rom.data());
  EXPECT_EQ(sink.last.texels.size(), 44u);
  EXPECT_EQ(sink.last.texture.wrap_t, TextureWrap::kMirror);
  EXPECT_EQ(sink.last.texture_coordinates.size(), 32u);
  EXPECT_EQ(sink.last.texture_coordinates.data(), memory.ram.data() + (kVertices + 48 - kTarget));
}

TEST_F(DecodeTest, AListBeginsWithoutTextureAlphaTestAndBlending) {
  ASSERT_TRUE(decode_packets(kGoodTarget, good_streams(), kOnePoint).ok());
  EXPECT_TRUE(sink.last.texels.empty());
  EXPECT_EQ(sink.last.fragment.alpha_test, 0u);
  EXPECT_EQ(sink.last.fragment.blend, BlendMode::kNone);
}

TEST_F(DecodeTest, NoTextureTakesTheTextureAwayWhateverElseThePacketSays) {
  ASSERT_TRUE(decode_packets(kGoodTarget, good_streams(), good_texture(),
                             SetTexture{TextureFormat::kNone, 3, 0, 9999, 77, {}, {}, {}}, kOnePoint)
                  .ok());
  EXPECT_TRUE(sink.last.texels.empty());
}

TEST_F(DecodeTest, TexturesAreChecked) {
  const auto with = [](auto change) {
    SetTexture t = good_texture();
    change(t);
    return t;
  };
  expect_refused(with([](auto& t) { t.format = static_cast<TextureFormat>(4); }), "format");
  expect_refused(with([](auto& t) { t.base += 2; }), "base unaligned");
  expect_refused(with([](auto& t) { t.width = 0; }), "no width");
  expect_refused(with([](auto& t) { t.height = 0; }), "no height");
  expect_refused(with([](auto& t) { t.width = 4097; }), "too wide");
  expect_refused(with([](auto& t) { t.height = 0xFFFFFFFFu; }), "too high");
  expect_refused(with([](auto& t) { t.level_count = 0; }), "no level");
  expect_refused(with([](auto& t) { t.level_count = 4; }), "more levels than down to 1 x 1");
  expect_refused(with([](auto& t) { t.filter = static_cast<TextureFilter>(2); }), "filter");
  expect_refused(with([](auto& t) { t.wrap_s = static_cast<TextureWrap>(3); }), "wrap s");
  expect_refused(with([](auto& t) { t.wrap_t = static_cast<TextureWrap>(3); }), "wrap t");
  expect_refused(with([](auto& t) { t.base = 0x3000; }), "nowhere");
  expect_refused(with([](auto& t) { t.base += 24; }), "the last level begins at the memory's end: 24 + 40 = 64");
  EXPECT_TRUE(decode_packets(with([](auto& t) { t.base += 20; })).ok()) << "44 of the last 44 bytes";
  expect_refused(with([](auto& t) { t.format = TextureFormat::kArgb8888; }), "64 bytes and levels below");
  EXPECT_TRUE(decode_packets(with([](auto& t) { t.format = TextureFormat::kArgb8888, t.level_count = 1; })).ok());
}

TEST_F(DecodeTest, FragmentStatesAreChecked) {
  expect_refused(SetFragmentState{2, 0, BlendMode::kNone}, "alpha test");
  expect_refused(SetFragmentState{1, 256, BlendMode::kNone}, "reference");
  expect_refused(SetFragmentState{0, 256, BlendMode::kNone}, "reference, even where it is not used");
  expect_refused(SetFragmentState{0, 0, static_cast<BlendMode>(2)}, "blend mode");
  ASSERT_TRUE(decode_packets(kGoodTarget, good_streams(), SetFragmentState{1, 255, BlendMode::kAlpha}, kOnePoint).ok());
  EXPECT_EQ(sink.last.fragment.alpha_reference, 255u);
}

TEST_F(DecodeTest, ATextureWithoutCoordinatesIsAMissingState) {
  const Status status = decode_packets(kGoodTarget, good_streams(), good_texture(), kOnePoint);
  EXPECT_EQ(status.code, StatusCode::kFailedPrecondition);
  EXPECT_EQ(status.where, 6u + 11u + 9u);
  EXPECT_TRUE(sink.draws.empty());
}

TEST_F(DecodeTest, NewStreamsWithoutCoordinatesForgetTheOldOnes) {
  EXPECT_EQ(decode_packets(kGoodTarget, textured_streams(), good_texture(), good_streams(), kOnePoint).code,
            StatusCode::kFailedPrecondition);
}

TEST_F(DecodeTest, TexelsAndCoordinatesInTheTargetAreRefused) {
  SetTexture in_target = good_texture();
  in_target.base = kTarget + 124;  // the last pixel of the colour target
  EXPECT_EQ(decode_packets(kGoodTarget, textured_streams(), in_target, kOnePoint).code, StatusCode::kInvalidArgument);
  in_target.base = kTarget + 128;
  EXPECT_TRUE(decode_packets(kGoodTarget, textured_streams(), in_target, kOnePoint).ok());
  in_target.base = kDepth;
  EXPECT_EQ(decode_packets(kGoodTarget, kGoodDepth, textured_streams(), in_target, kOnePoint).code,
            StatusCode::kInvalidArgument);
  SetVertexStreams streams = textured_streams();
  streams.texture_coordinates = kTarget;
  EXPECT_EQ(decode_packets(kGoodTarget, streams, kOnePoint).code, StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace usuzumi::gfx
