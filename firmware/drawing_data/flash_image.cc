#include "firmware/drawing_data/flash_image.h"

#include <cstdint>
#include <cstring>

#include "firmware/drawing_data/format.h"

namespace usuzumi::firmware {
namespace {

std::uint32_t word_at(std::span<const std::byte> flash, std::size_t offset) {
  std::uint32_t v;
  std::memcpy(&v, flash.data() + offset, sizeof v);
  return v;
}

std::size_t bare_bytes(std::span<const std::byte> flash) {
  constexpr std::size_t kRecordHeadBytes = 8, kVertexBytes = 12;
  std::size_t at = 4;
  for (std::uint32_t left = word_at(flash, 0); left > 0; --left) {
    if (flash.size() - at < kRecordHeadBytes) return flash.size();
    const std::uint64_t bytes = kRecordHeadBytes + std::uint64_t{word_at(flash, at)} * kVertexBytes;
    if (bytes > flash.size() - at) return flash.size();
    at += static_cast<std::size_t>(bytes);
  }
  return at;
}

}  // namespace

std::span<const std::byte> image_in_flash(std::span<const std::byte> flash) {
  if (flash.size() < sizeof(format::Header)) return flash;
  const std::uint32_t first = word_at(flash, 0);
  if (first == 0 || first == 0xFFFFFFFFu) return {};
  std::size_t bytes = flash.size();
  if (first == format::kMagic) bytes = word_at(flash, offsetof(format::Header, file_bytes));
  else if (first <= format::kMaxMeshes) bytes = bare_bytes(flash);
  return flash.first(bytes < flash.size() ? bytes : flash.size());
}

}  // namespace usuzumi::firmware
