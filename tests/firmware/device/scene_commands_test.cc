#include "firmware/device/scene_commands.h"

#include <gtest/gtest.h>

#include "firmware/device/vram_layout.h"
#include "gfx_subsystem/engine/state.h"
#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using testing::container_rom;
using testing::hills;
using testing::square;
using testing::ThinningBench;

/// RAM at 0x50000000 as the copy's memory, VRAM of zeros at 0x80000000.
class TestBus final : public BusMemory, public AddressTranslation {
 public:
  TestBus(const std::byte* ram, std::size_t ram_bytes) : ram_(ram), ram_bytes_(ram_bytes), vram_(1 << 20) {}

 private:
  std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const override {
    if (address >= 0x50000000 && address - 0x50000000 + size <= ram_bytes_)
      return {ram_ + (address - 0x50000000), size};
    return {};
  }
  std::span<std::byte> do_write_window(BusAddress address, std::size_t size) override {
    if (address >= 0x80000000 && address - 0x80000000 + size <= vram_.size())
      return {vram_.data() + (address - 0x80000000), size};
    return {};
  }
  BusAddress do_bus_address(const void* pointer) const override {
    const auto offset = static_cast<const std::byte*>(pointer) - ram_;
    return offset >= 0 && static_cast<std::size_t>(offset) < ram_bytes_ ? 0x50000000 + static_cast<BusAddress>(offset)
                                                                        : 0;
  }
  const std::byte* ram_;
  std::size_t ram_bytes_;
  std::vector<std::byte> vram_;
};

struct Recorded {
  command::Draw draw;
  std::uint32_t vertex_count;
  command::CullMode cull;
  bool has_normals, has_colours;
};

class Recorder final : public gfx::CommandSink {
 public:
  Status clear(const gfx::EngineState&, const command::Clear& c) override {
    clears.push_back(c);
    return ok_status();
  }
  Status draw(const gfx::EngineState& state, const gfx::DrawCall& call) override {
    draws.push_back(
        {call.draw, state.streams.vertex_count, state.raster.cull, !state.normals.empty(), !state.colours.empty()});
    return ok_status();
  }
  std::vector<command::Clear> clears;
  std::vector<Recorded> draws;
};

constexpr firmware::FrameTarget kTarget{0x80000000, 448, command::PixelFormat::kXrgb8888,
                                        0x80040000, 448, command::DepthFormat::kUnorm24};

TEST(SceneCommands, DrawEveryMeshOfTheCopyInOrderAfterOneClear) {
  auto coloured = square(0.5f, 1);
  coloured.colours.assign(4, rgba8(1, 2, 3));
  coloured.flags = firmware::format::kFlagTwoSided;
  ThinningBench bench(container_rom({coloured, square(1, 2), hills(4, 3), square(0.1f, 4)}));
  ASSERT_TRUE(bench.update().ok());
  TestBus bus(bench.copy().block(0), bench.copy().used_bytes());
  std::vector<std::uint32_t> words(firmware::scene_command_words(bench.thinning.data()));
  const auto list = write_scene(bench.thinning, testing::flat_view(), {}, kTarget, bus, words);
  ASSERT_TRUE(list.ok()) << list.status().message;

  Recorder recorder;
  std::uint64_t consumed = 0;
  const Status status = gfx::decode(*list, bus, recorder, consumed);
  ASSERT_TRUE(status.ok()) << status.message << " at word " << status.where;
  EXPECT_EQ(consumed, list->size());
  ASSERT_EQ(recorder.clears.size(), 1u);
  EXPECT_EQ(recorder.clears[0].planes, command::kClearColour | command::kClearDepth);
  ASSERT_EQ(recorder.draws.size(), 3u) << "the level-2 mesh is not there";
  EXPECT_EQ(recorder.draws[0].draw.topology, command::Topology::kTriangleStrip);
  EXPECT_EQ(recorder.draws[0].vertex_count, 4u);
  EXPECT_EQ(recorder.draws[0].cull, command::CullMode::kNone);
  EXPECT_TRUE(recorder.draws[0].has_colours);
  EXPECT_TRUE(recorder.draws[0].has_normals);
  EXPECT_EQ(recorder.draws[1].draw.topology, command::Topology::kTriangles);
  EXPECT_EQ(recorder.draws[1].draw.index_format, command::IndexFormat::kU16)
      << "indices of a small mesh take two bytes";
  EXPECT_EQ(recorder.draws[1].draw.count, 3 * bench.copy().mesh(2).faces);
  EXPECT_EQ(recorder.draws[1].cull, command::CullMode::kBack);
  EXPECT_EQ(recorder.draws[2].draw.topology, command::Topology::kPoints);
}

TEST(SceneCommands, TheWordsAskedForAreEnoughAndOneFewerIsNot) {
  ThinningBench bench(container_rom({square(1, 1), square(1, 1), square(1, 1)}));
  ASSERT_TRUE(bench.update().ok());
  TestBus bus(bench.copy().block(0), bench.copy().used_bytes());
  std::vector<std::uint32_t> words(firmware::scene_command_words(bench.thinning.data()));
  EXPECT_TRUE(write_scene(bench.thinning, testing::flat_view(), {}, kTarget, bus, words).ok());
  words.resize(words.size() - 2);  // one is to spare
  EXPECT_EQ(write_scene(bench.thinning, testing::flat_view(), {}, kTarget, bus, words).status().code,
            StatusCode::kResourceExhausted);
}

TEST(SceneCommands, ACopyOutsideTheBusIsRefused) {
  ThinningBench bench(container_rom({square(1, 1)}));
  ASSERT_TRUE(bench.update().ok());
  const std::byte elsewhere[4] = {};
  TestBus bus(elsewhere, sizeof elsewhere);
  std::vector<std::uint32_t> words(firmware::scene_command_words(bench.thinning.data()));
  EXPECT_EQ(write_scene(bench.thinning, testing::flat_view(), {}, kTarget, bus, words).status().code,
            StatusCode::kFailedPrecondition);
}

Scanout picture_of(std::uint32_t width, std::uint32_t height, command::PixelFormat format) {
  return {width, height, format, default_stride_bytes(width, format), {}};
}

TEST(VramLayout, HoldsTwoPicturesAndDepthOnTheSmallBoard) {
  const auto layout = firmware::plan_vram(0x80000000, 1 << 20, picture_of(480, 272, command::PixelFormat::kRgb565),
                                          command::DepthFormat::kUnorm16);
  ASSERT_TRUE(layout.ok());
  EXPECT_EQ(layout->scanout.stride_bytes, 960u);  // 15 units of 64
  EXPECT_EQ(layout->scanout.picture[0], 0x80000000u);
  EXPECT_EQ(layout->scanout.picture[1], 0x80000000u + 64 * 4096);  // 960 * 272 bytes are 63.75 pages
  EXPECT_EQ(layout->depth, 0x80000000u + 2 * 64 * 4096);
  EXPECT_EQ(layout->used_bytes, 2u * 64 * 4096 + 960 * 272);
}

TEST(VramLayout, RoundsRowsUpToTheDisplaysUnit) {
  EXPECT_EQ(default_stride_bytes(100, command::PixelFormat::kXrgb8888), 448u);  // 400 bytes are six and a quarter
  const auto layout = firmware::plan_vram(0x1000, 1 << 20, picture_of(100, 10, command::PixelFormat::kXrgb8888),
                                          command::DepthFormat::kUnorm16);
  ASSERT_TRUE(layout.ok());
  EXPECT_EQ(layout->depth_stride_bytes, 256u);  // 200 bytes are three and an eighth
  EXPECT_EQ(layout->used_bytes, 2u * 2 * 4096 + 256 * 10);
}

TEST(VramLayout, SaysHowManyBytesAreMissing) {
  const auto layout = firmware::plan_vram(0x1000, 1 << 20, picture_of(480, 272, command::PixelFormat::kXrgb8888),
                                          command::DepthFormat::kUnorm24);
  EXPECT_EQ(layout.status().code, StatusCode::kResourceExhausted);
  EXPECT_EQ(layout.status().where, 2u * 128 * 4096 + 1920 * 272);  // 1920 * 272 bytes are 127.5 pages
  for (const auto& [width, height] : {std::pair{0u, 272u}, {4097u, 1u}})
    EXPECT_EQ(firmware::plan_vram(0x1000, 0xFFFFFFFF, picture_of(width, height, command::PixelFormat::kRgb565),
                                  command::DepthFormat::kNone)
                  .status()
                  .code,
              StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace usuzumi
