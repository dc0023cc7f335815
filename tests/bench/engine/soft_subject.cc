#include "tests/bench/engine/soft_subject.h"

#include <cstring>
#include <stdexcept>

namespace usuzumi::bench {

using namespace command;

std::span<const std::byte> SoftSubject::Memory::do_read_window(BusAddress address, std::size_t size) const {
  const std::span<const std::byte> m = address >= kVram ? std::span<const std::byte>(vram) : ram;
  const std::size_t at = address - (address >= kVram ? kVram : kRam);
  return at > m.size() || size > m.size() - at ? std::span<const std::byte>{}
                                               : std::span<const std::byte>(m.data() + at, size);
}

std::span<std::byte> SoftSubject::Memory::do_write_window(BusAddress address, std::size_t size) {
  const auto window = do_read_window(address, size);
  return {const_cast<std::byte*>(window.data()), window.size()};
}

SoftSubject::SoftSubject(const BenchScene& scene, gfx::ParallelRunner* runner, const gfx::soft::Kernels* kernels)
    : work_(32u << 20), engine_({work_, runner, kernels}), words_(256) {
  const auto upload = [this](const auto& data) {
    const std::size_t at = (memory_.ram.size() + 15) & ~std::size_t{15}, bytes = data.size() * sizeof(data[0]);
    memory_.ram.resize(at + bytes);
    std::memcpy(memory_.ram.data() + at, data.data(), bytes);
    return static_cast<BusAddress>(kRam + at);
  };
  const std::uint32_t plane = scene.width * scene.height * 4;
  constexpr std::size_t kLine = 64;
  vram_.resize(std::size_t{2} * plane + kLine);
  memory_.vram = std::span(vram_).subspan((kLine - reinterpret_cast<std::uintptr_t>(vram_.data()) % kLine) % kLine,
                                          std::size_t{2} * plane);
  Writer list(words_);
  list.put(SetColourTarget{kVram, scene.width * 4, scene.width, scene.height, PixelFormat::kXrgb8888});
  list.put(SetDepthTarget{kVram + plane, scene.width * 4, DepthFormat::kUnorm24});
  list.put(Clear{kClearColour | kClearDepth, rgba8(26, 26, 31), 1});
  if (!scene.clear_only) {
    SetVertexStreams streams;
    streams.vertex_count = static_cast<std::uint32_t>(scene.positions.size());
    streams.positions = upload(scene.positions);
    streams.colours = upload(scene.colours);
    SetRasterState raster;
    raster.shade_model = scene.flat ? ShadeModel::kFlat : ShadeModel::kGouraud;
    raster.depth_test = 1;
    list.put(SetTransform{scene.transform});
    list.put(raster);
    if (scene.texture.width != 0) {
      streams.texture_coordinates = upload(scene.coordinates);
      const TextureFilter filter = scene.texture.bilinear ? TextureFilter::kBilinear : TextureFilter::kNearest;
      list.put(SetTexture{TextureFormat::kArgb8888, upload(scene.texture.texels), scene.texture.width,
                          scene.texture.height, scene.texture.levels, filter});
      list.put(SetFragmentState{0, 0, scene.blended ? BlendMode::kAlpha : BlendMode::kNone});
    }
    list.put(streams);
    list.put(Draw{Topology::kTriangles, IndexFormat::kU32, upload(scene.indices), 0,
                  static_cast<std::uint32_t>(scene.indices.size())});
  }
  const auto finished = list.finish();
  if (!finished.ok()) throw std::runtime_error(finished.status().message);
  list_ = *finished;
}

void SoftSubject::draw() {
  const auto report = engine_.execute(list_, memory_);
  if (!report.status.ok()) throw std::runtime_error(report.status.message);
}

}  // namespace usuzumi::bench
