// Number formats, signs and the fill rule of the software engine, stated once; every stage keeps to them.
//
// Window space     x runs right, y runs DOWN, the centre of pixel (px, py) lies at (px + 0.5, py + 0.5).
// Snapped vertices 24.8 fixed point: X = x * 256 rounded to nearest, ties to even. |X| <= 2^22 because vertices beyond
//                  the guard band (kGuardPixels) are clipped in floating point before any conversion to an integer.
// Signed area      area = (X1 - X0)(Y2 - Y0) - (X2 - X0)(Y1 - Y0): twice the area in 1/65536 square pixel. With y down,
//                  area > 0 is CLOCKWISE as seen on the panel. The set-up swaps two vertices of the others, so that
//                  every triangle it describes has area > 0.
// Edge functions   from vertex i to j: E(X, Y) = A (X - Xi) + B (Y - Yi), A = Yi - Yj, B = Xj - Xi; E > 0 inside.
// Top-left rule    a pixel whose centre lies exactly on an edge belongs to the triangle when the edge is a left one (A
//                  > 0) or a horizontal top one (A == 0 and B > 0): then E >= 0 is inside; for every other edge E >= 1
//                  is, written as E - 1 >= 0. An edge shared by two triangles is left or top for exactly one of them.
// Per pixel        E at pixel centres changes by 256 A and 256 B per pixel, so floor(E / 256) changes by exactly A and
//                  B and has E's sign: the raster works on e = floor(E / 256) in 32 bits, pixel steps A and B.
// Colour           "lane units": 16 bits whose top bits are the channel of the target (8 of 8888, 5-6-5 of 565); a
//                  value carries +1/2 of the channel's step, so that dropping the low bits rounds to nearest.
//                  Arithmetic is modulo 2^16: a covered pixel's true value lies in range, and the error of the planes
//                  stays below the half step (see kMaxSpan), so nothing wraps that is seen.
// Depth            24.8 unsigned, or 16.8 for unorm16, with +1/2 as well, modulo 2^32. Linear in window space.
// Texture          s and t of a vertex are singles within kMaxTextureCoordinate: what lies beyond is drawn in to it,
//                  what is not a number becomes 0. A triangle's are first shifted by whole repeats (of a mirrored axis:
//                  by pairs of them) until its first corner lies in the first; s/w, t/w and 1/w are then planes in
//                  singles, and s = (s/w) * (1 / (1/w)) at each pixel. Wrapping makes of it a place along the image in
//                  [0, 1].
// Level            rho^2 = the larger of |d(s W, t H)/dx|^2 and |d(s W, t H)/dy|^2, W x H the size of level 0, from the
//                  planes' derivatives at the pixel; the level is floor(log2(rho) + 1/2), which is the exponent of
//                  rho^2 plus 1, halved. Held to the levels that there are.
// Nearest          texel floor(place * size).
// Bilinear         texel units in 24.8: floor(place * size * 256 + 1/2) - 128; the fraction f weighs two texels a, b in
//                  whole channels of 8 bits: (256 a + (b - a) f + 128) >> 8, along s first, then along t.
// Fragments        whole channels of 8 bits, alpha too. texel * colour is the product / 255 rounded to nearest; colours
//                  are lane units of 8 bits as above. The alpha test compares that alpha. Blending is (colour * a +
//                  there * (255 - a)) / 255 rounded to nearest, `there` of 5 or 6 bits made 8 by repeating the upper
//                  ones below; RGB565 then takes round(channel * 31 / 255) or 63.
#pragma once

#include <bit>
#include <cstdint>

namespace usuzumi::gfx::soft {

inline constexpr int kSubpixelBits = 8;
inline constexpr std::int32_t kSubpixelOne = 1 << kSubpixelBits;
inline constexpr std::int32_t kSubpixelHalf = kSubpixelOne / 2;

/// Window coordinates beyond are clipped away; 16000 * 256 < 2^22, with room for the rounding of the cut.
inline constexpr float kGuardPixels = 16000.0f;

/// 1.5 * 2^23: the sum with any |v| < 2^22 has v, rounded to nearest with ties to even, in its low bits.
inline constexpr float kRoundingBias = 12582912.0f;
inline constexpr std::int32_t kRoundingBits = 0x4B400000;
inline std::int32_t round_to_int(float v) { return std::bit_cast<std::int32_t>(v + kRoundingBias) - kRoundingBits; }

/// Side of a tile, and the largest width and height in pixels of a "small" triangle. A plane's
/// steps are rounded to 1/2 unit: over 64 + 64 pixels that makes at most 64 units, a quarter of an 8-bit channel's or a
/// depth's step. Changing it changes pixels (within that quarter), and with them the goldens.
inline constexpr std::int32_t kTileSize = 64;
inline constexpr std::int32_t kMaxSpan = 64;

/// A tile's pixels are stored as 4x4 blocks, block rows first; a block is 16 words: one cache line.
inline constexpr std::int32_t kBlockSize = 4;
inline constexpr std::int32_t kBlockPixels = kBlockSize * kBlockSize;
inline constexpr std::int32_t kBlocksPerRow = kTileSize / kBlockSize;
inline constexpr std::int32_t kTilePixels = kTileSize * kTileSize;

/// Clip-space values beyond (or NaN), and w below, make no triangle at all: the primitive is dropped.
inline constexpr float kMaxClipValue = 1e18f;
inline constexpr float kMinClipW = 1e-18f;

/// Largest |s| and |t| of a vertex: a single has 8 bits left below 1 there.
inline constexpr float kMaxTextureCoordinate = 65536.0f;
/// ... and of a pixel, where rounding may go beyond; its floor fits an integer.
inline constexpr float kMaxTexturePlace = 4194304.0f;  // 2^22

}  // namespace usuzumi::gfx::soft
