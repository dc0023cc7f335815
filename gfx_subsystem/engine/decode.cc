// Command decoder: proves every packet sound before an engine sees it.
#include <cmath>

#include "gfx_subsystem/engine/state.h"
#include "gfx_subsystem/engine/texture_layout.h"

namespace usuzumi::gfx {
namespace {

using namespace command;

constexpr std::uint32_t kMaxTargetSize = 4096;
constexpr float kMaxPrimitiveSize = 64;

/// Indices of either size that a compiler keeps in a vector register where the processor has one.
using Indices16 = std::uint16_t __attribute__((vector_size(16)));
using Indices32 = std::uint32_t __attribute__((vector_size(16)));

bool in_unit(float v) { return v >= 0 && v <= 1; }  // false for NaN
bool finite_non_negative(Vec3 v) { return is_finite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0; }

class Decoder {
 public:
  Decoder(std::span<const std::uint32_t> list, BusMemory& memory, CommandSink& sink)
      : list_(list), memory_(memory), sink_(sink) {}

  Status run(std::uint64_t& command_words) {
    while (word_ < list_.size()) {
      const std::uint32_t header = list_[word_];
      const auto payload = header & 0xFFFF;
      if ((header & 0x00FF0000) != 0) return fault(StatusCode::kDataLoss, "packet header has bits 23-16 set");
      if (payload > list_.size() - word_ - 1)
        return fault(StatusCode::kDataLoss, "packet runs past the end of the list");
      if (static_cast<Opcode>(header >> 24) == Opcode::kEnd) {
        command_words = word_ + 1;
        return payload == 0 ? ok_status() : fault(StatusCode::kDataLoss, "end packet has a payload");
      }
      Status status = packet(static_cast<Opcode>(header >> 24), payload);
      if (!status.ok()) {
        command_words = word_;
        return status;
      }
      word_ += 1 + payload;
    }
    command_words = word_;
    return fault(StatusCode::kDataLoss, "command list has no end packet");
  }

 private:
  Status fault(StatusCode code, const char* message) const {
    return {code, message, static_cast<std::uint32_t>(word_)};
  }
  Status refuse(const char* message) const { return fault(StatusCode::kInvalidArgument, message); }

  Status packet(Opcode opcode, std::uint32_t payload) {
    switch (opcode) {
      case Opcode::kSetColourTarget: return take<SetColourTarget>(payload);
      case Opcode::kSetDepthTarget: return take<SetDepthTarget>(payload);
      case Opcode::kSetScissor: return take<SetScissor>(payload);
      case Opcode::kSetViewport: return take<SetViewport>(payload);
      case Opcode::kSetTransform: return take<SetTransform>(payload);
      case Opcode::kSetLight: return take<SetLight>(payload);
      case Opcode::kSetRasterState: return take<SetRasterState>(payload);
      case Opcode::kSetVertexStreams: return take<SetVertexStreams>(payload);
      case Opcode::kClear: return take<Clear>(payload);
      case Opcode::kDraw: return take<Draw>(payload);
      case Opcode::kSetTexture: return take<SetTexture>(payload);
      case Opcode::kSetFragmentState: return take<SetFragmentState>(payload);
      case Opcode::kEnd: break;
    }
    return fault(StatusCode::kUnsupported, "unknown opcode");
  }

  template <class Packet>
  Status take(std::uint32_t payload) {
    if (payload != kPayloadWords<Packet>)
      return fault(StatusCode::kDataLoss, "packet has the wrong length for its opcode");
    Packet p;
    std::memcpy(static_cast<void*>(&p), &list_[word_ + 1], sizeof p);
    return apply(p);
  }

  Status apply(const SetColourTarget& p) {
    if (p.format > PixelFormat::kXrgb8888) return refuse("colour target: unknown pixel format");
    if (p.width == 0 || p.height == 0 || p.width > kMaxTargetSize || p.height > kMaxTargetSize)
      return refuse("colour target: width and height must be 1 to 4096");
    if (p.base % 4 != 0 || p.stride_bytes % 4 != 0)
      return refuse("colour target: base and stride must be multiples of 4");
    auto window = plane(p.base, p.stride_bytes, p.width * bytes_per_pixel(p.format), p.height);
    if (window.data() == nullptr)
      return refuse("colour target is not all in writable memory, or its stride is shorter than a row");
    state_.colour_target = p;
    state_.colour_memory = window;
    state_.viewport = {0, 0, static_cast<float>(p.width), static_cast<float>(p.height), 0, 1};
    state_.scissor = {0, 0, p.width, p.height};
    state_.depth_target = {};
    state_.depth_memory = {};
    return ok_status();
  }

  Status apply(const SetDepthTarget& p) {
    if (p.format > DepthFormat::kUnorm24) return refuse("depth target: unknown format");
    state_.depth_target = {};
    state_.depth_memory = {};
    if (p.format == DepthFormat::kNone) return ok_status();
    if (state_.colour_memory.empty())
      return fault(StatusCode::kFailedPrecondition, "depth target set before a colour target");
    if (p.base % 4 != 0 || p.stride_bytes % 4 != 0)
      return refuse("depth target: base and stride must be multiples of 4");
    auto window = plane(p.base, p.stride_bytes, state_.colour_target.width * bytes_per_depth(p.format),
                        state_.colour_target.height);
    if (window.data() == nullptr)
      return refuse("depth target is not all in writable memory, or its stride is shorter than a row");
    const auto* colour = state_.colour_memory.data();
    if (window.data() < colour + state_.colour_memory.size() && colour < window.data() + window.size())
      return refuse("depth target overlaps the colour target");
    state_.depth_target = p;
    state_.depth_memory = window;
    return ok_status();
  }

  std::span<std::byte> plane(BusAddress base, std::uint32_t stride, std::uint32_t row_bytes, std::uint32_t rows) {
    if (stride < row_bytes) return {};
    return memory_.write_window(base, std::size_t{stride} * (rows - 1) + row_bytes);
  }

  Status apply(const SetScissor& p) {
    const auto clip = [](std::uint32_t start, std::uint32_t size, std::uint32_t limit, std::uint32_t& out_start,
                         std::uint32_t& out_size) {
      out_start = start < limit ? start : limit;
      out_size = size < limit - out_start ? size : limit - out_start;
    };
    clip(p.x, p.width, state_.colour_target.width, state_.scissor.x, state_.scissor.width);
    clip(p.y, p.height, state_.colour_target.height, state_.scissor.y, state_.scissor.height);
    return ok_status();
  }

  Status apply(const SetViewport& p) {
    constexpr float kLimit = 8192;
    const auto sane = [](float v) { return v >= -kLimit && v <= kLimit; };
    if (!sane(p.x) || !sane(p.y) || !sane(p.width) || !sane(p.height) || p.width <= 0 || p.height <= 0)
      return refuse("viewport: position and size must be finite, within 8192 pixels, sizes above 0");
    if (!in_unit(p.near_depth) || !in_unit(p.far_depth)) return refuse("viewport: depths must be in [0, 1]");
    state_.viewport = p;
    return ok_status();
  }

  Status apply(const SetTransform& p) {
    for (float v : p.model_to_clip.m)
      if (!std::isfinite(v)) return refuse("transform has an element that is not finite");
    state_.transform = p;
    return ok_status();
  }

  Status apply(const SetLight& p) {
    if (p.enabled > 1 || !is_finite(p.to_light) || !finite_non_negative(p.ambient) || !finite_non_negative(p.diffuse))
      return refuse("light: values must be finite, colours not negative, enabled 0 or 1");
    state_.light = p;
    return ok_status();
  }

  Status apply(const SetRasterState& p) {
    if (p.shade_model > ShadeModel::kGouraud || p.cull > CullMode::kFront || p.front_face > FrontFace::kClockwise ||
        p.depth_function > DepthFunction::kLessEqual || p.depth_test > 1 || p.depth_write > 1)
      return refuse("raster state: a field holds an undefined value");
    const auto size_ok = [](float v) { return v >= 1 && v <= kMaxPrimitiveSize; };
    if (!size_ok(p.point_size) || !size_ok(p.line_width))
      return refuse("raster state: point size and line width must be 1 to 64 pixels");
    state_.raster = p;
    return ok_status();
  }

  Status apply(const SetVertexStreams& p) {
    state_.streams = {};
    state_.positions = state_.normals = state_.colours = state_.texture_coordinates = {};
    if (p.vertex_count == 0) return refuse("vertex streams: vertex count is 0");
    Status status = stream(p.positions, p.position_stride, sizeof(Vec3), p.vertex_count, state_.positions);
    if (status.ok() && p.normals != 0) status = stream(p.normals, p.normal_stride, 4, p.vertex_count, state_.normals);
    if (status.ok() && p.colours != 0) status = stream(p.colours, p.colour_stride, 4, p.vertex_count, state_.colours);
    if (status.ok() && p.texture_coordinates != 0)
      status = stream(p.texture_coordinates, p.texture_coordinate_stride, sizeof(TexCoord), p.vertex_count,
                      state_.texture_coordinates);
    if (status.ok()) state_.streams = p;
    return status;
  }

  Status stream(BusAddress address, std::uint32_t stride, std::uint32_t element, std::uint32_t count,
                std::span<const std::byte>& out) {
    if (address % 4 != 0 || stride % 4 != 0 || stride < element)
      return refuse("vertex streams: address and stride must be multiples of 4, stride no shorter than an element");
    const std::uint64_t bytes = std::uint64_t{stride} * (count - 1) + element;
    if (bytes > 0xFFFFFFFFu) return refuse("vertex streams: stream is longer than the address space");
    out = memory_.read_window(address, static_cast<std::size_t>(bytes));
    return out.data() != nullptr ? ok_status() : refuse("vertex streams: a stream is not all in memory");
  }

  /// A refused texture, like a refused depth target, leaves none.
  Status apply(const SetTexture& p) {
    if (p.format > TextureFormat::kArgb8888) return refuse("texture: unknown format");
    state_.texture = {};
    state_.texels = {};
    if (p.format == TextureFormat::kNone) return ok_status();
    if (p.filter > TextureFilter::kBilinear || p.wrap_s > TextureWrap::kMirror || p.wrap_t > TextureWrap::kMirror)
      return refuse("texture: undefined filter or wrap mode");
    if (p.width == 0 || p.height == 0 || p.width > kMaxTextureSize || p.height > kMaxTextureSize)
      return refuse("texture: width and height must be 1 to 4096");
    if (p.level_count == 0 || p.level_count > full_level_count(p.width, p.height))
      return refuse("texture: level count must be 1 to that of the chain that ends with one texel");
    if (p.base % 4 != 0) return refuse("texture: base must be a multiple of 4");
    const auto texels = memory_.read_window(p.base, static_cast<std::size_t>(texture_bytes(p)));
    if (texels.data() == nullptr) return refuse("texture is not all in memory");
    state_.texture = p;
    state_.texels = texels;
    return ok_status();
  }

  Status apply(const SetFragmentState& p) {
    if (p.alpha_test > 1 || p.alpha_reference > 255 || p.blend > BlendMode::kAlpha)
      return refuse("fragment state: alpha test must be 0 or 1, its reference 0 to 255, the blend mode a defined one");
    state_.fragment = p;
    return ok_status();
  }

  Status apply(const Clear& p) {
    if (state_.colour_memory.empty())
      return fault(StatusCode::kFailedPrecondition, "clear before a colour target is set");
    if ((p.planes & ~(kClearColour | kClearDepth)) != 0 || !in_unit(p.depth))
      return refuse("clear: undefined plane, or depth outside [0, 1]");
    if ((p.planes & kClearDepth) != 0 && state_.depth_memory.empty())
      return fault(StatusCode::kFailedPrecondition, "clear of depth without a depth target");
    return at_this_word(sink_.clear(state_, p));
  }

  Status apply(const Draw& p) {
    if (state_.colour_memory.empty())
      return fault(StatusCode::kFailedPrecondition, "draw before a colour target is set");
    if (state_.positions.data() == nullptr)
      return fault(StatusCode::kFailedPrecondition, "draw before vertex streams are set");
    if (state_.raster.depth_test != 0 && state_.depth_memory.empty())
      return fault(StatusCode::kFailedPrecondition, "depth test without a depth target");
    if (!state_.texels.empty() && state_.texture_coordinates.empty())
      return fault(StatusCode::kFailedPrecondition, "draw with a texture, but the streams have no texture coordinates");
    if (p.topology > Topology::kTriangleFan || p.index_format > IndexFormat::kU32)
      return refuse("draw: undefined topology or index format");
    DrawCall call;
    call.draw = p;
    call.word = static_cast<std::uint32_t>(word_);
    if (p.count == 0) return ok_status();
    Status status = p.index_format == IndexFormat::kNone ? resolve_range(call) : resolve_indices(call);
    if (status.ok() && touches_target(call)) status = refuse("draw: vertices, indices or texels lie in the target");
    return status.ok() ? at_this_word(sink_.draw(state_, call)) : status;
  }

  Status at_this_word(Status status) const {
    if (!status.ok()) status.where = static_cast<std::uint32_t>(word_);
    return status;
  }

  /// An engine may read vertices and texels long before or after it writes the pixels of other draws, so the two must
  /// not overlap.
  bool touches_target(const DrawCall& call) const {
    const auto overlaps = [](std::span<const std::byte> a, std::span<const std::byte> b) {
      return !a.empty() && !b.empty() && a.data() < b.data() + b.size() && b.data() < a.data() + a.size();
    };
    for (std::span<const std::byte> target :
         {std::span<const std::byte>(state_.colour_memory), std::span<const std::byte>(state_.depth_memory)})
      for (std::span<const std::byte> source : {state_.positions, state_.normals, state_.colours,
                                                state_.texture_coordinates, state_.texels, call.indices})
        if (overlaps(target, source)) return true;
    return false;
  }

  Status resolve_range(DrawCall& call) const {
    const auto& d = call.draw;
    if (d.first > state_.streams.vertex_count || d.count > state_.streams.vertex_count - d.first)
      return refuse("draw: vertices beyond the streams' end");
    call.min_vertex = d.first;
    call.max_vertex = d.first + d.count - 1;
    return ok_status();
  }

  Status resolve_indices(DrawCall& call) const {
    const auto& d = call.draw;
    const std::uint32_t size = d.index_format == IndexFormat::kU16 ? 2 : 4;
    if (d.index_address % size != 0) return refuse("draw: index address is not aligned to the index size");
    const std::uint64_t end = (std::uint64_t{d.first} + d.count) * size;
    if (end > 0xFFFFFFFFu) return refuse("draw: indices are longer than the address space");
    auto all = memory_.read_window(d.index_address, static_cast<std::size_t>(end));
    if (all.data() == nullptr) return refuse("draw: indices are not all in memory");
    call.indices = all.subspan(std::size_t{d.first} * size);
    if (size == 2) scan<std::uint16_t, Indices16>(call); else scan<std::uint32_t, Indices32>(call);
    if (call.max_vertex >= state_.streams.vertex_count) return refuse("draw: index beyond the streams' end");
    return ok_status();
  }

  /// Least and greatest index, sixteen bytes at a time: this looks at every index of a draw before any thread may
  /// start.
  template <class T, class Lanes>
  static void scan(DrawCall& call) {
    constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(T);
    constexpr std::size_t kAtOnce = 4;  // chains of comparisons that do not wait for each other
    const std::byte* p = call.indices.data();
    const std::size_t count = call.draw.count, in_lanes = count / (kLanes * kAtOnce) * (kLanes * kAtOnce);
    Lanes lows[kAtOnce], highs[kAtOnce];
    for (std::size_t k = 0; k < kAtOnce; ++k) {
      highs[k] = Lanes{};
      lows[k] = ~highs[k];
    }
    for (std::size_t i = 0; i < in_lanes; i += kLanes * kAtOnce) {
      for (std::size_t k = 0; k < kAtOnce; ++k) {
        Lanes v;
        std::memcpy(&v, p + (i + k * kLanes) * sizeof(T), sizeof v);
        lows[k] = v < lows[k] ? v : lows[k];
        highs[k] = v > highs[k] ? v : highs[k];
      }
    }
    T low = static_cast<T>(-1), high = 0;
    const auto take = [&](T least, T most) {
      low = least < low ? least : low;
      high = most > high ? most : high;
    };
    for (std::size_t k = 0; k < kAtOnce; ++k)
      for (std::size_t lane = 0; lane < kLanes; ++lane) take(lows[k][lane], highs[k][lane]);
    for (std::size_t i = in_lanes; i < count; ++i) {
      T v;
      std::memcpy(&v, p + i * sizeof(T), sizeof(T));
      take(v, v);
    }
    call.min_vertex = low;
    call.max_vertex = high;
  }

  std::span<const std::uint32_t> list_;
  BusMemory& memory_;
  CommandSink& sink_;
  EngineState state_;
  std::size_t word_ = 0;
};

}  // namespace

Status decode(std::span<const std::uint32_t> list, BusMemory& memory, CommandSink& sink, std::uint64_t& command_words) {
  return Decoder(list, memory, sink).run(command_words);
}

}  // namespace usuzumi::gfx
