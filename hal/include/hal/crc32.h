// CRC-32/ISO-HDLC (IEEE 802.3): reflected polynomial 0xEDB88320, start and final XOR 0xFFFFFFFF.
//
// One definition serves the ROM container, the display controller's signature unit and the goldens.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace usuzumi {

inline constexpr std::uint32_t kCrc32Start = 0;

/// Continues `crc` (kCrc32Start for a new one) over `bytes`; crc32("123456789") == 0xCBF43926.
std::uint32_t crc32(std::uint32_t crc, std::span<const std::byte> bytes);

}  // namespace usuzumi
