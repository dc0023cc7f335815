#include "firmware/thinning/ram_copy.h"

#include <cstring>
#include <new>

namespace usuzumi::firmware {
namespace {

constexpr std::size_t kBlockAlignment = 4;
constexpr std::size_t kMaxCopyBytes = 0xFFFFFFFCu;  // offsets are 32 bits

template <class Index>
bool indices_below(const std::byte* indices, std::uint32_t count, std::uint32_t limit) {
  for (std::uint32_t i = 0; i < count; ++i) {
    Index v;
    std::memcpy(&v, indices + std::size_t{i} * sizeof v, sizeof v);
    if (v >= limit) return false;
  }
  return true;
}

std::uint32_t index_bytes(const CopyMesh& mesh) {
  switch (mesh.index_format) {
    case command::IndexFormat::kNone: return 0;
    case command::IndexFormat::kU16: return 2;
    case command::IndexFormat::kU32: return 4;
  }
  return 0;
}

bool stream_inside(std::uint32_t offset, std::uint64_t bytes, std::uint32_t block_bytes) {
  return offset % 4 == 0 && offset <= block_bytes && bytes <= block_bytes - offset;
}

/// Whether groups end one after the other and the last at `end`, or there are none.
bool ends_rise_to(std::span<const std::uint32_t> ends, std::uint32_t end) {
  std::uint32_t before = 0;
  for (const std::uint32_t group_end : ends) {
    if (group_end < before) return false;
    before = group_end;
  }
  return ends.empty() || before == end;
}

/// Whether the groups' live faces are the mesh's faces; where each group's slots begin is the chain's business.
bool live_add_up(std::span<const std::uint32_t> live, const CopyMesh& mesh) {
  std::uint64_t sum = 0;
  for (const std::uint32_t faces : live) sum += faces;
  return !live.empty() && sum == mesh.faces && sum <= mesh.index_count / 3;
}

}  // namespace

Status RamCopy::begin(std::uint32_t mesh_max, Arena& ram, bool rom_on_bus) {
  *this = {};
  rom_on_bus_ = rom_on_bus;
  const auto slots = ram.allocate<Slot>(mesh_max);
  if (slots.data() == nullptr)
    return {StatusCode::kResourceExhausted, "RAM has no room for the table of meshes; meshes", mesh_max};
  for (Slot& slot : slots) new (&slot) Slot{};
  const std::size_t rest = ram.available() / kBlockAlignment * kBlockAlignment;
  const auto memory = ram.allocate<std::byte>(rest > kBlockAlignment ? rest - kBlockAlignment : 0, kBlockAlignment);
  slots_ = slots;
  memory_ = memory.first(memory.size() < kMaxCopyBytes ? memory.size() : kMaxCopyBytes);
  first_ = last_ = mesh_max;
  return ok_status();
}

std::uint32_t RamCopy::group_words_offset(std::uint32_t n) const {
  const CopyMesh& m = slots_[n].mesh;
  const std::uint32_t bytes = slots_[n].bytes;
  if (!m.has_group_words) return bytes;
  const std::uint64_t begin = m.index_offset + (std::uint64_t{m.index_count} * index_bytes(m) + 3) / 4 * 4;
  return begin % 4 != 0 || begin >= bytes ? bytes : static_cast<std::uint32_t>(begin);
}

std::span<const std::uint32_t> RamCopy::group_words(std::uint32_t n) const {
  const std::uint32_t begin = group_words_offset(n);
  return {reinterpret_cast<const std::uint32_t*>(block(n) + begin), (slots_[n].bytes - begin) / 4};
}

std::span<std::uint32_t> RamCopy::live_faces(std::uint32_t n) {
  const std::uint32_t begin = group_words_offset(n);
  return {reinterpret_cast<std::uint32_t*>(block_memory(n).data() + begin), (slots_[n].bytes - begin) / 4};
}

std::uint64_t RamCopy::faces() const {
  std::uint64_t sum = 0;
  for (const Slot& slot : slots_)
    if (slot.present) sum += slot.mesh.faces;
  return sum;
}

void RamCopy::add(std::uint32_t n, const CopyMesh& mesh, std::uint32_t bytes) {
  Slot& slot = slots_[n];
  slot = {mesh, static_cast<std::uint32_t>(used_), bytes, mesh_max(), true};
  if (first_ == mesh_max()) first_ = n; else slots_[last_].next = n;
  last_ = n;
  ++present_;
  note_use(bytes);
  used_ += bytes;
}

void RamCopy::drop(std::uint32_t n) {
  if (!slots_[n].present) return;
  slots_[n].present = false;
  --present_;
  gaps_ = true;
}

void RamCopy::compact() {
  if (!gaps_) return;
  gaps_ = false;
  std::size_t target = 0;
  std::uint32_t previous = mesh_max();
  std::uint32_t first = mesh_max();
  for (std::uint32_t n = first_; n != mesh_max(); n = slots_[n].next) {
    Slot& slot = slots_[n];
    if (!slot.present) continue;
    if (slot.offset != target) std::memmove(memory_.data() + target, memory_.data() + slot.offset, slot.bytes);
    slot.offset = static_cast<std::uint32_t>(target);
    target += slot.bytes;
    if (previous == mesh_max()) first = n; else slots_[previous].next = n;
    previous = n;
  }
  if (previous != mesh_max()) slots_[previous].next = mesh_max();
  first_ = first;
  last_ = previous;
  used_ = target;
}

void RamCopy::note_use(std::size_t bytes_of_free_memory) {
  if (used_ + bytes_of_free_memory > peak_) peak_ = used_ + bytes_of_free_memory;
}

bool RamCopy::blocks_sound() const {
  std::size_t end = 0;
  std::uint32_t count = 0;
  for (std::uint32_t n = first_; n != mesh_max(); n = slots_[n].next) {
    const Slot& slot = slots_[n];
    const CopyMesh& m = slot.mesh;
    if (!slot.present || slot.offset < end || slot.bytes > used_ || slot.offset > used_ - slot.bytes) return false;
    end = std::size_t{slot.offset} + slot.bytes;
    ++count;
    const auto vertices_inside = [&](std::uint32_t offset, std::uint64_t bytes_each) {
      return offset == kNoStream || stream_inside(offset, m.vertex_count * bytes_each, slot.bytes);
    };
    if (m.vertex_count == 0 || (m.vertices_in_rom && !rom_on_bus_) ||
        !vertices_inside(m.vertices_in_rom ? kNoStream : 0, sizeof(Vec3)) ||
        !vertices_inside(m.normal_offset, sizeof(PackedNormal)) || !vertices_inside(m.colour_offset, sizeof(Rgba8)) ||
        !vertices_inside(m.texture_coordinate_offset, sizeof(TexCoord)))
      return false;
    if (m.index_format == command::IndexFormat::kNone) continue;
    const std::uint32_t size = index_bytes(m);
    if (!stream_inside(m.index_offset, std::uint64_t{m.index_count} * size, slot.bytes)) return false;
    if (!(m.layered ? live_add_up(group_words(n), m) : ends_rise_to(group_words(n), m.index_count / 3))) return false;
  }
  return count == present_ && end <= used_;
}

bool RamCopy::indices_sound(std::uint32_t n) const {
  const CopyMesh& m = slots_[n].mesh;
  if (m.index_format == command::IndexFormat::kNone) return true;
  const std::byte* indices = block(n) + m.index_offset;
  return index_bytes(m) == 2 ? indices_below<std::uint16_t>(indices, m.index_count, m.vertex_count)
                             : indices_below<std::uint32_t>(indices, m.index_count, m.vertex_count);
}

bool RamCopy::sound() const {
  if (!blocks_sound()) return false;
  for (std::uint32_t n = 0; n < mesh_max(); ++n)
    if (present(n) && !indices_sound(n)) return false;
  return true;
}

}  // namespace usuzumi::firmware
