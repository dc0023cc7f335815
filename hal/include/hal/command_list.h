// The command list: what the firmware writes into RAM and the 3D engine executes after the doorbell rings.
//
// A list is a run of 32-bit little-endian words. Each packet is a header word
//     bits 31-24 opcode, bits 23-16 zero, bits 15-0 number of payload words that follow
// and its payload, the struct below of the opcode's name, word by word. State packets hold until the next of their
// kind; a list begins with no target, no streams, identity transform, lighting off and the defaults written in the
// structs. The list ends with kEnd. Unknown opcodes, wrong lengths and values out of range stop the engine with an
// error that names the word; what was drawn before stays drawn.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "hal/bus.h"
#include "hal/status.h"
#include "hal/vec.h"

namespace usuzumi::command {

enum class Opcode : std::uint8_t {
  kEnd = 0x00,
  kSetColourTarget = 0x01,
  kSetDepthTarget = 0x02,
  kSetScissor = 0x03,
  kSetViewport = 0x04,
  kSetTransform = 0x05,
  kSetLight = 0x06,
  kSetRasterState = 0x07,
  kSetVertexStreams = 0x08,
  kClear = 0x10,
  kDraw = 0x11,
  kSetTexture = 0x20,
  kSetFragmentState = 0x21,
};

enum class PixelFormat : std::uint32_t {
  kRgb565 = 0,    // 16 bits: red 15-11, green 10-5, blue 4-0
  kXrgb8888 = 1,  // 32 bits: red 23-16, green 15-8, blue 7-0; the engine writes 0xFF to bits 31-24
};
constexpr std::uint32_t bytes_per_pixel(PixelFormat f) { return f == PixelFormat::kRgb565 ? 2 : 4; }

enum class DepthFormat : std::uint32_t {
  kNone = 0,
  kUnorm16 = 1,  // 2 bytes; depth d in [0,1] is stored as floor(d * 65535 + 0.5)
  kUnorm24 = 2,  // 4 bytes, bits 23-0; floor(d * 16777215 + 0.5); bits 31-24 zero
};
constexpr std::uint32_t bytes_per_depth(DepthFormat f) {
  return f == DepthFormat::kNone ? 0 : (f == DepthFormat::kUnorm16 ? 2 : 4);
}

enum class ShadeModel : std::uint32_t { kFlat = 0, kGouraud = 1 };  // flat takes the last vertex of each primitive
enum class CullMode : std::uint32_t { kNone = 0, kBack = 1, kFront = 2 };
enum class FrontFace : std::uint32_t { kCounterClockwise = 0, kClockwise = 1 };  // as seen on the panel
enum class DepthFunction : std::uint32_t { kAlways = 0, kLess = 1, kLessEqual = 2 };
enum class Topology : std::uint32_t { kPoints = 0, kLines = 1, kTriangles = 2, kTriangleStrip = 3, kTriangleFan = 4 };
enum class TextureFormat : std::uint32_t {
  kNone = 0,      // no texture: a fragment has the interpolated colour alone
  kRgb565 = 1,    // as PixelFormat's; texels are opaque
  kXrgb8888 = 2,  // as PixelFormat's; texels are opaque
  kArgb8888 = 3,  // 32 bits: alpha 31-24 (not multiplied into the colours), then as kXrgb8888
};
constexpr std::uint32_t bytes_per_texel(TextureFormat f) { return f == TextureFormat::kRgb565 ? 2 : 4; }
enum class TextureFilter : std::uint32_t { kNearest = 0, kBilinear = 1 };  // within a level; the nearest level is taken
enum class TextureWrap : std::uint32_t { kRepeat = 0, kClamp = 1, kMirror = 2 };  // clamp: to the edge's texels
enum class BlendMode : std::uint32_t { kNone = 0, kAlpha = 1 };  // alpha: colour * a + what is there * (1 - a)
enum class IndexFormat : std::uint32_t { kNone = 0, kU16 = 1, kU32 = 2 };

/// Colour target. Rows of `width` pixels, `stride_bytes` apart, top row first. width and height 1..4096; base and
/// stride multiples of 4 bytes; setting it resets viewport and scissor to the whole target.
struct SetColourTarget {
  BusAddress base = 0;
  std::uint32_t stride_bytes = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  PixelFormat format = PixelFormat::kXrgb8888;
};

/// Depth target, of the colour target's width and height; kNone switches depth off.
struct SetDepthTarget {
  BusAddress base = 0;
  std::uint32_t stride_bytes = 0;
  DepthFormat format = DepthFormat::kNone;
};

/// Pixels outside are neither cleared nor drawn. Clipped to the target; may be empty.
struct SetScissor {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// Window x = x + (clip.x / clip.w + 1) * width / 2; window y = y + (1 - clip.y / clip.w) * height / 2 (y runs down);
/// depth = near_depth + (clip.z / clip.w + 1) / 2 * (far_depth - near_depth). A pixel's centre lies at +0.5.
struct SetViewport {
  float x = 0, y = 0, width = 0, height = 0;  // pixels
  float near_depth = 0, far_depth = 1;        // each in [0, 1]
};

/// Model space to clip space (OpenGL's: visible where -w <= x, y, z <= w).
struct SetTransform {
  Mat4 model_to_clip;
};

/// Per-vertex light, in model space: colour = base * min(1, ambient + diffuse * max(0, normal . to_light)), per
/// channel. Where lighting is off, or the streams have no normals, colour = base.
struct SetLight {
  std::uint32_t enabled = 0;
  Vec3 to_light{0, 0, 1};     // unit, from the surface towards the light
  Vec3 ambient{1, 1, 1};      // each channel >= 0
  Vec3 diffuse{0, 0, 0};
};

struct SetRasterState {
  ShadeModel shade_model = ShadeModel::kGouraud;
  CullMode cull = CullMode::kNone;
  FrontFace front_face = FrontFace::kCounterClockwise;
  DepthFunction depth_function = DepthFunction::kLess;
  std::uint32_t depth_test = 0;   // 0 or 1; without it depth is neither compared nor written
  std::uint32_t depth_write = 1;  // 0 or 1
  float point_size = 1;           // pixels, 1..64: an axis-aligned square around the vertex
  float line_width = 1;  // pixels, 1..64: a parallelogram, widened along the minor axis; of the pixels at its ends
                         // those are drawn whose centre lies within it (OpenGL's diamond-exit rule is not applied)
};

/// Where vertex data lies. Strides are multiples of 4. A zero address means the stream is absent (positions must be
/// there).
struct SetVertexStreams {
  std::uint32_t vertex_count = 0;
  BusAddress positions = 0;        // 3 singles each
  std::uint32_t position_stride = 12;
  BusAddress normals = 0;          // PackedNormal each
  std::uint32_t normal_stride = 4;
  BusAddress colours = 0;          // Rgba8 each
  std::uint32_t colour_stride = 4;
  Rgba8 constant_colour{};         // base colour where the colour stream is absent
  BusAddress texture_coordinates = 0;  // TexCoord each; needed where a texture is set
  std::uint32_t texture_coordinate_stride = 8;
};

/// The image that following draws are covered with, and how it is sampled: fragment = texel * interpolated colour, per
/// channel, alpha included. Level i is max(1, width >> i) by max(1, height >> i) texels, top row first, every row
/// padded to a multiple of 4 bytes; levels follow one another without gaps.
struct SetTexture {
  TextureFormat format = TextureFormat::kNone;
  BusAddress base = 0;            // of level 0; a multiple of 4
  std::uint32_t width = 0;        // texels, 1..4096, of level 0; any size, not powers of two alone
  std::uint32_t height = 0;
  std::uint32_t level_count = 1;  // 1 .. floor(log2(max(width, height))) + 1
  TextureFilter filter = TextureFilter::kBilinear;
  TextureWrap wrap_s = TextureWrap::kRepeat;
  TextureWrap wrap_t = TextureWrap::kRepeat;
};

/// What becomes of a fragment after texturing. Its alpha is the interpolated colour's (the vertex's or the constant
/// one's) times the texel's.
struct SetFragmentState {
  std::uint32_t alpha_test = 0;       // 0 or 1: a fragment whose alpha is below the reference is not drawn at all
  std::uint32_t alpha_reference = 0;  // 0..255
  BlendMode blend = BlendMode::kNone;
};

inline constexpr std::uint32_t kClearColour = 1, kClearDepth = 2;

/// Fills the scissor rectangle.
struct Clear {
  std::uint32_t planes = 0;      // kClearColour | kClearDepth
  Rgba8 colour{};
  float depth = 1;               // [0, 1]
};

/// Everything is cut off at the edges of the viewport, points and wide lines too.
///
/// Draws `count` vertices (kNone: first .. first + count - 1 of the streams) or indices (`index_address` + first...).
/// Triangles of a strip alternate their winding, the first as given. Indices >= vertex_count are an error.
struct Draw {
  Topology topology = Topology::kTriangles;
  IndexFormat index_format = IndexFormat::kNone;
  BusAddress index_address = 0;  // aligned to the index size
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

template <class Packet> struct OpcodeOf;
template <> struct OpcodeOf<SetColourTarget> { static constexpr Opcode value = Opcode::kSetColourTarget; };
template <> struct OpcodeOf<SetDepthTarget> { static constexpr Opcode value = Opcode::kSetDepthTarget; };
template <> struct OpcodeOf<SetScissor> { static constexpr Opcode value = Opcode::kSetScissor; };
template <> struct OpcodeOf<SetViewport> { static constexpr Opcode value = Opcode::kSetViewport; };
template <> struct OpcodeOf<SetTransform> { static constexpr Opcode value = Opcode::kSetTransform; };
template <> struct OpcodeOf<SetLight> { static constexpr Opcode value = Opcode::kSetLight; };
template <> struct OpcodeOf<SetRasterState> { static constexpr Opcode value = Opcode::kSetRasterState; };
template <> struct OpcodeOf<SetVertexStreams> { static constexpr Opcode value = Opcode::kSetVertexStreams; };
template <> struct OpcodeOf<Clear> { static constexpr Opcode value = Opcode::kClear; };
template <> struct OpcodeOf<SetTexture> { static constexpr Opcode value = Opcode::kSetTexture; };
template <> struct OpcodeOf<SetFragmentState> { static constexpr Opcode value = Opcode::kSetFragmentState; };
template <> struct OpcodeOf<Draw> { static constexpr Opcode value = Opcode::kDraw; };

template <class Packet> inline constexpr std::uint32_t kPayloadWords = sizeof(Packet) / 4;

constexpr std::uint32_t header_word(Opcode opcode, std::uint32_t payload_words) {
  return static_cast<std::uint32_t>(opcode) << 24 | payload_words;
}

/// Appends packets to a caller's words. The first packet that does not fit, and all after it, are left out and
/// finish() says so.
class Writer {
 public:
  explicit Writer(std::span<std::uint32_t> words) : words_(words) {}

  template <class Packet>
  void put(const Packet& packet) {
    static_assert(std::is_trivially_copyable_v<Packet> && sizeof(Packet) % 4 == 0);
    if (full_ || words_.size() - used_ < 2 + kPayloadWords<Packet>) {  // one word stays free for kEnd
      full_ = true;
      return;
    }
    words_[used_] = header_word(OpcodeOf<Packet>::value, kPayloadWords<Packet>);
    std::memcpy(&words_[used_ + 1], &packet, sizeof packet);
    used_ += 1 + kPayloadWords<Packet>;
  }

  /// Ends the list; its words, or kResourceExhausted with the words' count in `where`.
  Result<std::span<const std::uint32_t>> finish() {
    if (full_ || used_ >= words_.size())
      return Status{StatusCode::kResourceExhausted, "command list is full; give it more words",
                    static_cast<std::uint32_t>(words_.size())};
    words_[used_++] = header_word(Opcode::kEnd, 0);
    return std::span<const std::uint32_t>(words_.first(used_));
  }

 private:
  std::span<std::uint32_t> words_;
  std::size_t used_ = 0;
  bool full_ = false;
};

static_assert(std::endian::native == std::endian::little, "drawing data and command lists are little-endian in place");

}  // namespace usuzumi::command
