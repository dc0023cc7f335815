#include "firmware/layers/middle_layer.h"

namespace usuzumi::firmware {
namespace {

/// One stream of the store: the mesh's own entries, then the added ones.
template <class T>
struct Stream {
  std::span<const T> given, added;
  T operator[](std::uint32_t v) const {
    return v < given.size() ? given[v] : added[v - static_cast<std::uint32_t>(given.size())];
  }
};

template <class T>
void copy_stream(const Stream<T>& from, std::span<T> to) {
  for (std::uint32_t v = 0; v < to.size(); ++v) to[v] = from[v];
}

// Not a + (b - a) * w, which misses b at 1.
float mix(float a, float b, float w) { return a * (1 - w) + b * w; }

Vec3 mix(Vec3 a, Vec3 b, float w) { return {mix(a.x, b.x, w), mix(a.y, b.y, w), mix(a.z, b.z, w)}; }

TexCoord mix(TexCoord a, TexCoord b, float w) { return {mix(a.s, b.s, w), mix(a.t, b.t, w)}; }

// A direction at right angles to `n`, of unit length.
Vec3 across(Vec3 n) {
  const float x = n.x < 0 ? -n.x : n.x, y = n.y < 0 ? -n.y : n.y, z = n.z < 0 ? -n.z : n.z;
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : (y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  return normalized(cross(n, axis));
}

// Turns at an even speed, to a degree: on the straight way from a side to its back nearly all of the turn would fall
// into a few frames. By halving the turn, which takes none of the functions that differ from library to library.
PackedNormal mix(PackedNormal a, PackedNormal b, float w) {
  constexpr float kNearlyEven = 0.92f;  // cosine of 23 degrees, up to which the straight way will do
  constexpr float kCancelled = 0.01f;   // opposite but for rounding (1/511 a component): any way round will do
  if (a == b) return a;
  Vec3 from = normalized(unpack(a)), to = normalized(unpack(b));
  while (dot(from, to) < kNearlyEven) {
    const Vec3 sum = from + to;
    const Vec3 halfway = dot(sum, sum) < kCancelled * kCancelled ? across(from) : normalized(sum);
    const bool before = w < 0.5f;
    (before ? to : from) = halfway;
    w = before ? w * 2 : w * 2 - 1;
  }
  return pack_normal(normalized(mix(from, to, w)));
}

Rgba8 mix(Rgba8 a, Rgba8 b, float w) {
  const auto part = static_cast<std::uint32_t>(w * 256 + 0.5f);  // 0..256
  const auto channel = [&](std::uint32_t from, std::uint32_t to) {
    return (from * (256 - part) + to * part + 128) >> 8;
  };
  return rgba8(channel(a.r(), b.r()), channel(a.g(), b.g()), channel(a.b(), b.b()), channel(a.a(), b.a()));
}

/// The ends are exact: a sum with zero parts may change a zero's sign, and unit length a normal's last bit.
template <class T>
T between(T from, T to, float w) {
  return w <= 0 ? from : (w >= 1 ? to : mix(from, to, w));
}

template <class T>
void mix_attributes(std::span<const format::LayerPair> pairs, const Stream<T>& store, float w, std::span<T> out) {
  if (out.empty()) return;
  for (const format::LayerPair& pair : pairs) {
    const T from = store[pair.from];
    out[pair.from] = pair.place_only() ? from : between(from, store[pair.vertex()], w);
  }
}

}  // namespace

void write_store(const LayerChainView& chain, const VertexStreams& given, const StoreTarget& out) {
  const VertexStreams& added = chain.added();
  copy_stream<Vec3>({given.positions, added.positions}, out.positions);
  copy_stream<PackedNormal>({given.normals, added.normals}, out.normals);
  copy_stream<Rgba8>({given.colours, added.colours}, out.colours);
  copy_stream<TexCoord>({given.texture_coordinates, added.texture_coordinates}, out.texture_coordinates);
}

std::uint32_t write_middle_layer(const LayerChainView& chain, const VertexStreams& given, std::uint32_t n, float weight,
                                 const StoreTarget& out) {
  const float w = weight > 0 ? (weight < 1 ? weight : 1.0f) : 0.0f;
  const auto pairs = chain.pairs(n);
  const VertexStreams& added = chain.added();
  if (!out.positions.empty()) {
    const Stream<Vec3> positions{given.positions, added.positions};
    for (const format::LayerPair& pair : pairs)
      out.positions[pair.from] = between(positions[pair.from], positions[pair.vertex()], w);
  }
  mix_attributes<PackedNormal>(pairs, {given.normals, added.normals}, w, out.normals);
  mix_attributes<Rgba8>(pairs, {given.colours, added.colours}, w, out.colours);
  mix_attributes<TexCoord>(pairs, {given.texture_coordinates, added.texture_coordinates}, w, out.texture_coordinates);
  return static_cast<std::uint32_t>(pairs.size());
}

}  // namespace usuzumi::firmware
