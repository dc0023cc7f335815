// A block of the RAM copy while it is built. Private to this folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "firmware/thinning/ram_copy.h"

namespace usuzumi::firmware {

/// A block under construction in the copy's free memory. Appending fails, and stays failed, when the memory ends.
class BlockWriter {
 public:
  explicit BlockWriter(std::span<std::byte> memory) : memory_(memory) {}

  /// The offset at which `source` now stands; it may overlap from above. kNoStream for an empty stream.
  template <class T>
  std::uint32_t append(std::span<const T> source) {
    if (source.empty()) return kNoStream;
    std::byte* p = extend(source.size_bytes());
    if (p == nullptr) return kNoStream;
    std::memmove(p, source.data(), source.size_bytes());
    return static_cast<std::uint32_t>(p - memory_.data());
  }

  std::byte* extend(std::size_t bytes) {
    const std::size_t padded = (bytes + 3) / 4 * 4;
    if (full_ || padded > memory_.size() - used_) {
      full_ = true;
      return nullptr;
    }
    std::byte* p = memory_.data() + used_;
    used_ += padded;
    return p;
  }

  bool full() const { return full_; }
  std::uint32_t bytes() const { return static_cast<std::uint32_t>(used_); }
  std::span<std::byte> rest() const { return memory_.subspan(used_); }

 private:
  std::span<std::byte> memory_;
  std::size_t used_ = 0;
  bool full_ = false;
};

}  // namespace usuzumi::firmware
