// What the command decoder's tests share: a small memory, a sink that remembers, and lists of good packets.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "gfx_subsystem/engine/state.h"

namespace usuzumi::gfx {

using namespace command;

inline constexpr BusAddress kTarget = 0x1000;    // 8 x 4 pixels of 4 bytes
inline constexpr BusAddress kDepth = 0x1080;     // and their depth
inline constexpr BusAddress kVertices = 0x1100;  // 8 positions
inline constexpr BusAddress kIndices = 0x1180;
inline constexpr BusAddress kReadOnly = 0x2000;  // 64 bytes that can only be read
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

class TestMemory final : public BusMemory {
 public:
  alignas(8) std::array<std::byte, 0x200> ram{};
  alignas(8) std::array<std::byte, 64> rom{};

  template <class T>
  void store(BusAddress address, std::initializer_list<T> values) {
    std::memcpy(ram.data() + (address - kTarget), values.begin(), values.size() * sizeof(T));
  }

 private:
  static bool inside(BusAddress base, std::size_t bytes, BusAddress address, std::size_t size) {
    return address >= base && address - base <= bytes && size <= bytes - (address - base);
  }
  std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const override {
    if (inside(kTarget, ram.size(), address, size)) return std::span(ram).subspan(address - kTarget, size);
    if (inside(kReadOnly, rom.size(), address, size)) return std::span(rom).subspan(address - kReadOnly, size);
    return {};
  }
  std::span<std::byte> do_write_window(BusAddress address, std::size_t size) override {
    if (inside(kTarget, ram.size(), address, size)) return std::span(ram).subspan(address - kTarget, size);
    return {};
  }
};

/// Remembers what came through.
class RecordingSink final : public CommandSink {
 public:
  std::vector<Clear> clears;
  std::vector<DrawCall> draws;
  EngineState last;
  Status answer;

 private:
  Status clear(const EngineState& state, const Clear& clear) override {
    last = state;
    clears.push_back(clear);
    return answer;
  }
  Status draw(const EngineState& state, const DrawCall& call) override {
    last = state;
    draws.push_back(call);
    return answer;
  }
};

inline constexpr SetColourTarget kGoodTarget{kTarget, 32, 8, 4, PixelFormat::kXrgb8888};
inline constexpr SetDepthTarget kGoodDepth{kDepth, 32, DepthFormat::kUnorm24};

inline SetVertexStreams good_streams() {
  SetVertexStreams s;
  s.vertex_count = 8;
  s.positions = kVertices;
  return s;
}

struct DecodeTest : ::testing::Test {
  TestMemory memory;
  RecordingSink sink;
  std::uint64_t words_consumed = 0;

  Status decode_words(std::vector<std::uint32_t> words) { return decode(words, memory, sink, words_consumed); }

  template <class... Packets>
  Status decode_packets(const Packets&... packets) {
    std::array<std::uint32_t, 256> words{};
    Writer writer(words);
    (writer.put(packets), ...);
    const auto list = writer.finish();
    EXPECT_TRUE(list.ok());
    return decode(*list, memory, sink, words_consumed);
  }

  /// After a good target (6 words) and depth target (4 words), so that a refused packet is word 10.
  template <class Packet>
  void expect_refused(const Packet& packet, const std::string& why) {
    const Status status = decode_packets(kGoodTarget, kGoodDepth, packet);
    EXPECT_EQ(status.code, StatusCode::kInvalidArgument) << why;
    EXPECT_EQ(status.where, 10u) << why;
    EXPECT_EQ(words_consumed, 10u) << why;
  }

  /// After target, depth target and streams (6 + 4 + 11 words).
  void expect_draw_refused(const Draw& draw, const std::string& why) {
    const Status status = decode_packets(kGoodTarget, kGoodDepth, good_streams(), draw);
    EXPECT_EQ(status.code, StatusCode::kInvalidArgument) << why;
    EXPECT_EQ(status.where, 21u) << why;
    EXPECT_TRUE(sink.draws.empty()) << why;
  }
};

}  // namespace usuzumi::gfx
