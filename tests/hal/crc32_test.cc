// CRC-32/ISO-HDLC against the catalogue's check value, zlib-known strings, and a bit-by-bit computation.
#include "hal/crc32.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace usuzumi {
namespace {

std::uint32_t crc_of(std::string_view text) { return crc32(kCrc32Start, std::as_bytes(std::span(text))); }

/// The definition: the polynomial division one bit at a time.
std::uint32_t crc_by_bits(std::span<const std::byte> bytes) {
  std::uint32_t c = 0xFFFFFFFFu;
  for (const std::byte b : bytes) {
    c ^= std::to_integer<std::uint32_t>(b);
    for (int i = 0; i < 8; ++i) c = (c & 1) != 0 ? c >> 1 ^ 0xEDB88320u : c >> 1;
  }
  return ~c;
}

TEST(Crc32, GivesTheCatalogueCheckValue) { EXPECT_EQ(crc_of("123456789"), 0xCBF43926u); }

TEST(Crc32, KnowsShortStrings) {
  EXPECT_EQ(crc_of(""), 0u);
  EXPECT_EQ(crc_of("a"), 0xE8B7BE43u);
  EXPECT_EQ(crc_of("The quick brown fox jumps over the lazy dog"), 0x414FA339u);
}

TEST(Crc32, EqualsTheDivisionBitByBitForEveryLengthAndAlignment) {
  std::mt19937 random(1);
  std::vector<std::byte> bytes(420);  // past the length from which x86-64 folds, and several folds on
  for (std::byte& b : bytes) b = static_cast<std::byte>(random() & 0xFF);
  for (std::size_t begin = 0; begin < 8; ++begin)
    for (std::size_t size = 0; size + begin <= bytes.size(); ++size) {
      const auto part = std::span<const std::byte>(bytes).subspan(begin, size);
      ASSERT_EQ(crc32(kCrc32Start, part), crc_by_bits(part)) << "begin " << begin << " size " << size;
    }
}

TEST(Crc32, ContinuesWhereItLeftOff) {
  std::string text;
  for (int i = 0; i < 12; ++i) text += "Continues where it left off, wherever that is. ";
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    const auto bytes = std::as_bytes(std::span(text));
    ASSERT_EQ(crc32(crc32(kCrc32Start, bytes.first(cut)), bytes.subspan(cut)), crc_of(text)) << "cut at " << cut;
  }
}

}  // namespace
}  // namespace usuzumi
