// One line of text, put together without a heap.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace usuzumi::boards {

/// What does not fit is left out; the line end always fits.
class TextLine {
 public:
  static constexpr std::size_t kCapacity = 640;  // a frame's line with the longest fault a driver has words for

  TextLine& text(std::string_view s) {
    for (const char c : s)
      if (size_ < kCapacity - 1) bytes_[size_++] = c;
    return *this;
  }
  TextLine& number(std::uint64_t n) { return digits(n, 10, 1); }
  /// Eight digits.
  TextLine& hex(std::uint32_t n) { return digits(n, 16, 8); }
  /// The line with its end; text may be added to it no more.
  std::string_view finish() {
    bytes_[size_++] = '\n';
    return {bytes_.data(), size_};
  }

 private:
  TextLine& digits(std::uint64_t n, int base, std::size_t least) {
    std::array<char, 24> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), n, base).ptr;
    const auto length = static_cast<std::size_t>(end - buffer.data());
    for (std::size_t i = length; i < least; ++i) text("0");
    return text({buffer.data(), length});
  }

  std::array<char, kCapacity> bytes_;
  std::size_t size_ = 0;
};

}  // namespace usuzumi::boards
