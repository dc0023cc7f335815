// Bytes of a ROM while they are written.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace usuzumi::sim {

/// Little-endian words in rising order, whatever the host's order is.
class Bytes {
 public:
  std::uint32_t size() const { return static_cast<std::uint32_t>(bytes_.size()); }
  void u16(std::uint32_t v) {
    bytes_.push_back(static_cast<std::byte>(v & 0xFF));
    bytes_.push_back(static_cast<std::byte>(v >> 8 & 0xFF));
  }
  void u32(std::uint32_t v) {
    u16(v & 0xFFFF);
    u16(v >> 16);
  }
  void f32(float v) { u32(std::bit_cast<std::uint32_t>(v)); }
  void text(std::string_view s) {
    for (char c : s) bytes_.push_back(static_cast<std::byte>(c));
  }
  void pad_to_word() { bytes_.resize((bytes_.size() + 3) / 4 * 4); }
  void raw(std::span<const std::byte> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }
  void append(const Bytes& other) { bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end()); }
  void set_u32(std::uint32_t offset, std::uint32_t v) {
    for (unsigned i = 0; i < 4; ++i) bytes_[offset + i] = static_cast<std::byte>(v >> (8 * i) & 0xFF);
  }
  std::uint32_t u32_at(std::uint32_t offset) const {
    std::uint32_t v = 0;
    for (unsigned i = 0; i < 4; ++i) v |= std::to_integer<std::uint32_t>(bytes_[offset + i]) << (8 * i);
    return v;
  }
  std::span<const std::byte> from(std::uint32_t offset) const { return std::span(bytes_).subspan(offset); }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace usuzumi::sim
