// A fixed piece of memory that is handed out from the front and given back by rewinding; the only allocator on the
// device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace usuzumi {

/// Hands out memory in order. Running out is an ordinary answer (an empty span), never a crash.
class Arena {
 public:
  constexpr Arena() = default;
  constexpr explicit Arena(std::span<std::byte> memory) : memory_(memory) {}

  /// `count` objects of T, uninitialised, aligned to `alignment` bytes; a span with data() == nullptr when they do not
  /// fit. Zero objects succeed (empty span, data() != nullptr unless the arena has no memory at all).
  template <class T>
  std::span<T> allocate(std::size_t count, std::size_t alignment = alignof(T)) {
    static_assert(std::is_trivially_destructible_v<T>, "nothing in an arena is ever destroyed");
    void* p = allocate_bytes(count, sizeof(T), alignment);
    return {static_cast<T*>(p), p != nullptr ? count : 0};
  }

  std::size_t capacity() const { return memory_.size(); }
  std::size_t used() const { return used_; }
  std::size_t available() const { return memory_.size() - used_; }
  /// Most bytes ever in use, alignment included, over all rewinds.
  std::size_t high_water() const { return high_water_; }
  std::byte* base() const { return memory_.data(); }

  /// Gives back everything allocated after used() was `mark`.
  void rewind(std::size_t mark) { if (mark <= used_) used_ = mark; }
  void reset() { used_ = 0; }

 private:
  void* allocate_bytes(std::size_t count, std::size_t size, std::size_t alignment) {
    const auto base = reinterpret_cast<std::uintptr_t>(memory_.data());
    const std::size_t padding = (alignment - (base + used_) % alignment) % alignment;
    if (memory_.data() == nullptr || padding > available()) return nullptr;
    if (count > (available() - padding) / size) return nullptr;
    void* p = memory_.data() + used_ + padding;
    used_ += padding + count * size;
    if (used_ > high_water_) high_water_ = used_;
    return p;
  }

  std::span<std::byte> memory_{};
  std::size_t used_ = 0;
  std::size_t high_water_ = 0;
};

/// Rewinds the arena to where it stood when the scope began.
class ScratchScope {
 public:
  explicit ScratchScope(Arena& arena) : arena_(arena), mark_(arena.used()) {}
  ~ScratchScope() { arena_.rewind(mark_); }
  ScratchScope(const ScratchScope&) = delete;
  ScratchScope& operator=(const ScratchScope&) = delete;

 private:
  Arena& arena_;
  std::size_t mark_;
};

}  // namespace usuzumi
