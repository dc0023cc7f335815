#include "hal/crc32.h"

#include <array>

#if defined(USUZUMI_CRC32_FOLD)
#include "hal/crc32_fold.h"
#endif

namespace usuzumi {
namespace {

// Eight tables let the loop take eight bytes a step: table[k][b] is the CRC of byte b followed by k zero bytes.
constexpr auto kTables = [] {
  std::array<std::array<std::uint32_t, 256>, 8> t{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t c = b;
    for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ ((c & 1) != 0 ? 0xEDB88320u : 0u);
    t[0][b] = c;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t b = 0; b < 256; ++b) t[k][b] = (t[k - 1][b] >> 8) ^ t[0][t[k - 1][b] & 0xFF];
  return t;
}();

std::uint32_t load_le32(const std::byte* p) {
  return std::to_integer<std::uint32_t>(p[0]) | std::to_integer<std::uint32_t>(p[1]) << 8 |
         std::to_integer<std::uint32_t>(p[2]) << 16 | std::to_integer<std::uint32_t>(p[3]) << 24;
}

/// The division register after `bytes`, without the inversions at both ends.
std::uint32_t divide(std::uint32_t c, std::span<const std::byte> bytes) {
  const std::byte* p = bytes.data();
  std::size_t n = bytes.size();
  for (; n >= 8; n -= 8, p += 8) {
    const std::uint32_t lo = c ^ load_le32(p), hi = load_le32(p + 4);
    c = kTables[7][lo & 0xFF] ^ kTables[6][(lo >> 8) & 0xFF] ^ kTables[5][(lo >> 16) & 0xFF] ^ kTables[4][lo >> 24] ^
        kTables[3][hi & 0xFF] ^ kTables[2][(hi >> 8) & 0xFF] ^ kTables[1][(hi >> 16) & 0xFF] ^ kTables[0][hi >> 24];
  }
  for (; n > 0; --n, ++p) c = (c >> 8) ^ kTables[0][(c ^ std::to_integer<std::uint32_t>(*p)) & 0xFF];
  return c;
}

#if defined(USUZUMI_CRC32_FOLD)
const bool kFold = crc32_fold_supported();
#endif

}  // namespace

std::uint32_t crc32(std::uint32_t crc, std::span<const std::byte> bytes) {
  std::uint32_t c = ~crc;
#if defined(USUZUMI_CRC32_FOLD)
  if (kFold && bytes.size() >= kCrc32FoldMin) {
    std::byte folded[16];
    const std::size_t size = bytes.size() / 64 * 64;
    crc32_fold(c, bytes.data(), size, folded);
    c = divide(0, folded);
    bytes = bytes.subspan(size);
  }
#endif
  return ~divide(c, bytes);
}

}  // namespace usuzumi
