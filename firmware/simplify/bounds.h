// What coordinates may be, in drawing data and in all that is made of them.
#pragma once

namespace usuzumi::firmware {

/// Largest magnitude of a coordinate. The squared length of a face's area vector, a fourth power of distances up to
/// twice this, reaches 2e34: finite in single precision, with room for sums of many faces and for the camera's
/// matrices.
inline constexpr float kMaxCoordinate = 1e8f;
/// Largest magnitude of a texture coordinate: how often an image may repeat across a mesh. Times the largest size of an
/// image (4096) it is below 2^26, so that the number of a texel fits 32 bits with room for fractions; a single tells
/// 1024 places of an image apart there.
inline constexpr float kMaxTextureCoordinate = 1e4f;

}  // namespace usuzumi::firmware
