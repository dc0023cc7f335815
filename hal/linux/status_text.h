// The text of a Status that names what only the running system knows: a path, a size, a line number.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/status.h"

namespace usuzumi::linux_hal {

/// Belongs to the driver whose errors it words, and outlives them as that driver does. What does not fit is left out.
class StatusText {
 public:
  static constexpr std::size_t kCapacity = 280;

  void clear() { size_ = 0; }
  bool empty() const { return size_ == 0; }
  StatusText& text(std::string_view s) {
    for (const char c : s)
      if (size_ < kCapacity) bytes_[size_++] = c;
    return *this;
  }
  StatusText& number(std::uint64_t n) {
    std::array<char, 20> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), n).ptr;
    return text({digits.data(), static_cast<std::size_t>(end - digits.data())});
  }
  StatusText& size(std::uint32_t width, std::uint32_t height) { return number(width).text("x").number(height); }
  std::size_t room() const { return kCapacity - size_; }

  /// The text so far. Holds until the next clear().
  const char* c_str() {
    bytes_[size_] = '\0';
    return bytes_.data();
  }
  Status status(StatusCode code, std::uint32_t where) { return {code, c_str(), where}; }
  /// The text, "; errno" and the number.
  Status errno_status(int negative_errno) {
    return text("; errno").status(StatusCode::kUnavailable, static_cast<std::uint32_t>(-negative_errno));
  }

 private:
  std::array<char, kCapacity + 1> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace usuzumi::linux_hal
