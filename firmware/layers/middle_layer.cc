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

PackedNormal mix(PackedNormal a, PackedNormal b, float w) {
  // Shorter than this two normals are opposite but for rounding (1/511 a component) and have no direction between.
  constexpr float kCancelled = 0.01f;
  if (a == b) return a;
  const Vec3 n = mix(unpack(a), unpack(b), w);
  return dot(n, n) < kCancelled * kCancelled ? a : pack_normal(normalized(n));
}

Rgba8 mix(Rgba8 a, Rgba8 b, float w) {
  const auto part = static_cast<std::uint32_t>(w * 256 + 0.5f);  // 0..256
  const auto channel = [&](std::uint32_t from, std::uint32_t to) {
    return (from * (256 - part) + to * part + 128) >> 8;
  };
  return rgba8(channel(a.r(), b.r()), channel(a.g(), b.g()), channel(a.b(), b.b()), channel(a.a(), b.a()));
}

template <class T>
void mix_stream(std::span<const format::LayerPair> pairs, const Stream<T>& store, float w, std::span<T> out) {
  if (out.empty()) return;
  for (const format::LayerPair& pair : pairs) {
    const T from = store[pair.from];
    // The ends are exact: a sum with zero parts may change a zero's sign, and unit length a normal's last bit.
    out[pair.from] = w <= 0 ? from : (w >= 1 ? store[pair.to] : mix(from, store[pair.to], w));
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
  mix_stream<Vec3>(pairs, {given.positions, added.positions}, w, out.positions);
  mix_stream<PackedNormal>(pairs, {given.normals, added.normals}, w, out.normals);
  mix_stream<Rgba8>(pairs, {given.colours, added.colours}, w, out.colours);
  mix_stream<TexCoord>(pairs, {given.texture_coordinates, added.texture_coordinates}, w, out.texture_coordinates);
  return static_cast<std::uint32_t>(pairs.size());
}

}  // namespace usuzumi::firmware
