// A workbench for the engine's tests: memory on a bus, a target, and lists written packet by packet.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "gfx_subsystem/engine_soft/soft_engine.h"
#include "hal/command_list.h"

namespace usuzumi::gfx::test {

using namespace command;

inline constexpr BusAddress kRam = 0x10000, kVram = 0x40000000;

/// VRAM begins at a cache line, as a device's does: only then are tiles stored past the caches.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kLine)); }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, kLine); }
  friend bool operator==(LineAllocator, LineAllocator) { return true; }
};
using Vram = std::vector<std::byte, LineAllocator<std::byte>>;

class FlatMemory final : public BusMemory {
 public:
  FlatMemory(std::size_t ram_bytes, std::size_t vram_bytes) : ram(ram_bytes), vram(vram_bytes) {}
  std::vector<std::byte> ram;
  Vram vram;

 private:
  std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const override {
    auto* self = const_cast<FlatMemory*>(this);
    if (address >= kVram) return self->window(self->vram, address - kVram, size);
    return address >= kRam ? self->window(self->ram, address - kRam, size) : std::span<std::byte>{};
  }
  std::span<std::byte> do_write_window(BusAddress address, std::size_t size) override {
    if (address >= kVram) return window(vram, address - kVram, size);
    return address >= kRam ? window(ram, address - kRam, size) : std::span<std::byte>{};
  }
  template <class Bytes>
  static std::span<std::byte> window(Bytes& m, std::size_t at, std::size_t size) {
    return at > m.size() || size > m.size() - at ? std::span<std::byte>{} : std::span<std::byte>(m.data() + at, size);
  }
};

/// How an engine under test is put together.
struct EngineSetup {
  std::size_t work_bytes = 1u << 20;
  ParallelRunner* runner = nullptr;
  const soft::Kernels* kernels = nullptr;
  std::size_t streaming_bytes = soft::kStreamingBytes;
};

/// A picture of `width` x `height`: colour plane at the start of VRAM, depth plane behind it.
class Bench {
 public:
  Bench(std::uint32_t width, std::uint32_t height, PixelFormat format = PixelFormat::kXrgb8888,
        DepthFormat depth = DepthFormat::kNone, std::uint32_t extra_stride = 0, std::size_t ram_bytes = 1u << 20)
      : width_(width), height_(height), format_(format), depth_(depth), memory_(ram_bytes, 0) {
    stride_ = (width * bytes_per_pixel(format) + 3) / 4 * 4 + extra_stride;
    depth_stride_ = depth == DepthFormat::kNone ? 0 : (width * bytes_per_depth(depth) + 3) / 4 * 4 + extra_stride;
    depth_base_ = stride_ * height;
    memory_.vram.resize(std::size_t{depth_base_} + std::size_t{depth_stride_} * height);
    words_.resize(1 << 16);
    begin();
  }

  /// Starts a new list that sets the targets and orthographic pixel coordinates: (x, y, z) with y down and z = depth.
  void begin() {
    used_ = 0;
    put(SetColourTarget{kVram, stride_, width_, height_, format_});
    if (depth_ != DepthFormat::kNone) put(SetDepthTarget{kVram + depth_base_, depth_stride_, depth_});
    put(SetTransform{pixel_transform()});
  }
  Mat4 pixel_transform() const {
    const float w = static_cast<float>(width_), h = static_cast<float>(height_);
    return {{2 / w, 0, 0, -1, 0, -2 / h, 0, 1, 0, 0, 2, -1, 0, 0, 0, 1}};
  }

  template <class Packet>
  Bench& put(const Packet& p) {
    if (used_ + 2 + kPayloadWords<Packet> > words_.size()) words_.resize(words_.size() * 2);
    words_[used_] = header_word(OpcodeOf<Packet>::value, kPayloadWords<Packet>);
    std::memcpy(&words_[used_ + 1], static_cast<const void*>(&p), sizeof p);
    used_ += 1 + kPayloadWords<Packet>;
    return *this;
  }
  Bench& raw(std::uint32_t word) {
    words_[used_++] = word;
    return *this;
  }

  /// Copies data into RAM; its bus address.
  template <class T>
  BusAddress upload(const std::vector<T>& data) {
    ram_used_ = (ram_used_ + 15) & ~std::size_t{15};
    std::memcpy(memory_.ram.data() + ram_used_, data.data(), data.size() * sizeof(T));
    const auto at = static_cast<BusAddress>(kRam + ram_used_);
    ram_used_ += data.size() * sizeof(T);
    return at;
  }

  /// Positions with a colour for each, or one for all.
  Bench& streams(const std::vector<Vec3>& positions, const std::vector<Rgba8>& colours = {}, Rgba8 constant = {}) {
    SetVertexStreams s;
    s.vertex_count = static_cast<std::uint32_t>(positions.size());
    s.positions = upload(positions);
    if (!colours.empty()) s.colours = upload(colours);
    s.constant_colour = constant;
    return put(s);
  }
  Bench& draw(Topology topology, std::uint32_t count, std::uint32_t first = 0) {
    return put(Draw{topology, IndexFormat::kNone, 0, first, count});
  }
  Bench& draw_indexed(Topology topology, const std::vector<std::uint32_t>& indices) {
    return put(Draw{topology, IndexFormat::kU32, upload(indices), 0, static_cast<std::uint32_t>(indices.size())});
  }

  ExecutionReport run(const EngineSetup& setup = {}) {
    std::vector<std::byte> work(setup.work_bytes);
    SoftEngine engine({work, setup.runner, setup.kernels, setup.streaming_bytes});
    return run_on(engine);
  }
  ExecutionReport run_on(Engine& engine) {
    words_[used_] = 0;
    return engine.execute({words_.data(), used_ + 1}, memory_);
  }

  std::uint32_t pixel(std::uint32_t x, std::uint32_t y) const {
    std::uint32_t v = 0;
    std::memcpy(&v, memory_.vram.data() + std::size_t{stride_} * y + std::size_t{bytes_per_pixel(format_)} * x,
                bytes_per_pixel(format_));
    return v;
  }
  std::uint32_t depth(std::uint32_t x, std::uint32_t y) const {
    std::uint32_t v = 0;
    std::memcpy(
        &v,
        memory_.vram.data() + depth_base_ + std::size_t{depth_stride_} * y + std::size_t{bytes_per_depth(depth_)} * x,
        bytes_per_depth(depth_));
    return v;
  }
  void fill_vram(std::uint8_t byte) { std::fill(memory_.vram.begin(), memory_.vram.end(), std::byte{byte}); }
  std::uint32_t covered(std::uint32_t background = 0) const {
    std::uint32_t n = 0;
    for (std::uint32_t y = 0; y < height_; ++y)
      for (std::uint32_t x = 0; x < width_; ++x) n += pixel(x, y) != background;
    return n;
  }
  /// One character per pixel: '.' where the pixel is `background`, '#' elsewhere.
  std::string picture(std::uint32_t background = 0) const {
    std::string s;
    for (std::uint32_t y = 0; y < height_; ++y) {
      for (std::uint32_t x = 0; x < width_; ++x) s += pixel(x, y) == background ? '.' : '#';
      s += '\n';
    }
    return s;
  }

  FlatMemory& memory() { return memory_; }
  const Vram& vram() const { return memory_.vram; }
  std::uint32_t used_words() const { return used_; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::uint32_t stride() const { return stride_; }

 private:
  std::uint32_t width_, height_;
  PixelFormat format_;
  DepthFormat depth_;
  std::uint32_t stride_ = 0, depth_stride_ = 0, depth_base_ = 0;
  FlatMemory memory_;
  std::vector<std::uint32_t> words_;
  std::uint32_t used_ = 0;
  std::size_t ram_used_ = 0;
};

/// A small reproducible generator (xorshift32).
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed) {}
  std::uint32_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }
  float in(float low, float high) { return low + (high - low) * static_cast<float>(next() >> 8) / 16777216.0f; }
  std::uint32_t below(std::uint32_t n) { return next() % n; }

 private:
  std::uint32_t state_;
};

}  // namespace usuzumi::gfx::test
