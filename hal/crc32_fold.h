// Folding long messages by carry-less multiplication, where the processor has it; crc32.cc finishes what is left.
#pragma once

#include <cstddef>
#include <cstdint>

namespace usuzumi {

/// Shortest message worth folding, bytes.
inline constexpr std::size_t kCrc32FoldMin = 128;

/// Carry-less multiplication is there.
bool crc32_fold_supported();

/// Folds the first `size` bytes (a multiple of 64, at least 64) onto 16: the plain division register (no inversions)
/// after `size` bytes starting from `state` equals that after these 16 starting from 0.
void crc32_fold(std::uint32_t state, const std::byte* bytes, std::size_t size, std::byte (&folded)[16]);

}  // namespace usuzumi
