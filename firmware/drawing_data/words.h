// The ROM as words by byte offset, and what the checks of drawing data share. Private to this folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "firmware/drawing_data/format.h"
#include "hal/status.h"

namespace usuzumi::firmware {

/// Words of the ROM by byte offset; callers have checked the bounds.
class Words {
 public:
  explicit Words(std::span<const std::byte> rom) : rom_(rom) {}
  std::uint32_t at(std::uint32_t offset) const {
    std::uint32_t v;
    std::memcpy(&v, rom_.data() + offset, 4);
    return v;
  }
  template <class T>
  T object(std::uint32_t offset) const {
    T v;
    std::memcpy(&v, rom_.data() + offset, sizeof v);
    return v;
  }
  template <class T>
  std::span<const T> array(std::uint32_t offset, std::uint32_t count) const {
    return {reinterpret_cast<const T*>(rom_.data() + offset), count};  // 4-byte aligned by the format and by open()
  }

 private:
  std::span<const std::byte> rom_;
};

inline constexpr std::uint32_t kRecordHeadBytes = 8;  // vertex count, level
inline constexpr std::uint32_t kVertexBytes = 12;

constexpr std::uint32_t record_bytes(std::uint32_t vertex_count) {
  return kRecordHeadBytes + vertex_count * kVertexBytes;
}

constexpr Status damaged(const char* message, std::uint32_t offset) { return {StatusCode::kDataLoss, message, offset}; }
constexpr Status unsupported(const char* message, std::uint32_t offset) {
  return {StatusCode::kUnsupported, message, offset};
}

struct Range {
  std::uint32_t begin = 0, end = 0;  // byte offsets; empty where the section is absent
  std::uint32_t bytes() const { return end - begin; }
  /// Whether `bytes` at `offset` (a multiple of 4) lie inside.
  bool holds(std::uint32_t offset, std::uint64_t bytes) const {
    return offset % 4 == 0 && offset >= begin && offset <= end && bytes <= end - offset;
  }
  /// Whether a text of `bytes` at `offset` lies inside, or there is none.
  bool holds_text(std::uint32_t offset, std::uint32_t bytes) const {
    if (offset == format::kAbsent) return bytes == 0;
    return offset >= begin && offset <= end && bytes <= end - offset;
  }
};

/// The container's section table, resolved.
struct Sections {
  Range records, meshes, indices, normals, colours, names, board;
  Range texture_coordinates, materials, textures, texels, methods, edge_values, layers, groups, solids;
};

}  // namespace usuzumi::firmware
