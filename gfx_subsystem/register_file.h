// A block of 32-bit device registers described by a table: the table states names, resets and which bits can be
// written; this code does the rest, and calls the device only where a register has an effect of its own.
//
// A device keeps a `static constexpr std::array<RegisterInfo<Device>, N>` and a `RegisterFile<Device, N>`:
//
//   {.name = "CONTROL", .offset = 0x00, .reset = 1, .writable = 0x3, .strobe = 0x80, .on_write = &Device::on_control},
//   {.name = "STATUS",  .offset = 0x04, .write_1_to_clear = 0x7, .on_write = &Device::on_status},
//   {.name = "COUNT",   .offset = 0x08, .read_only = 0xFFFFFFFF, .on_read = &Device::on_count},
//
// Two classes of trouble are kept apart. A *guest mistake* is the firmware's fault: an access the register page
// forbids. An *unimplemented* access is ours: the page of a real part allows it and this model does not do it. Neither
// stops the machine, as on hardware; both are counted and shown to a RegisterLog.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace usuzumi::gfx {

enum class GuestMistake : std::uint8_t {
  kUnaligned,      // offset is no multiple of 4: reads zero, the write is dropped
  kUnknownOffset,  // no register there: reads zero, the write is dropped
  kReadOnlyWrite,  // a register with nothing to write: dropped
  kReservedBits,   // ones written to reserved bits: those bits are dropped, the others take effect
  kIllegalValue,   // reported by the device: a value the register page forbids
  kCount
};

constexpr const char* guest_mistake_name(GuestMistake mistake) {
  switch (mistake) {
    case GuestMistake::kUnaligned: return "unaligned access";
    case GuestMistake::kUnknownOffset: return "no register at this offset";
    case GuestMistake::kReadOnlyWrite: return "write to a read-only register";
    case GuestMistake::kReservedBits: return "ones written to reserved bits";
    case GuestMistake::kIllegalValue: return "value not allowed";
    case GuestMistake::kCount: break;
  }
  return "guest mistake out of range";
}

/// One access that went wrong. `name` is the register's, or "" where there is none.
struct RegisterEvent {
  const char* name = "";
  std::uint32_t offset = 0;
  std::uint32_t value = 0;  // as written; 0 for reads
  bool is_write = false;
};

/// Shows what goes wrong to whoever runs the machine. Default: silence.
class RegisterLog {
 public:
  void guest_mistake(GuestMistake mistake, const RegisterEvent& event) { do_guest_mistake(mistake, event); }
  void unimplemented(const RegisterEvent& event) { do_unimplemented(event); }

 protected:
  ~RegisterLog() = default;

 private:
  virtual void do_guest_mistake(GuestMistake, const RegisterEvent&) {}
  virtual void do_unimplemented(const RegisterEvent&) {}
};

/// One register. A bit in none of the masks is reserved: it reads zero and must be written zero.
template <class Device>
struct RegisterInfo {
  const char* name = "";
  std::uint32_t offset = 0;
  std::uint32_t reset = 0;
  std::uint32_t writable = 0;          // read and write
  std::uint32_t write_1_to_clear = 0;  // set by the device; a written one clears it
  std::uint32_t strobe = 0;            // write only: seen by on_write, never stored, reads zero
  std::uint32_t read_only = 0;         // set by the device; writing is ignored
  std::uint32_t unimplemented = 0;     // a real part has these bits, this model does not: ones written are reported
  /// After the stored value has changed. `written` is the raw word, `before` the value that was stored.
  void (Device::*on_write)(std::uint32_t written, std::uint32_t before) = nullptr;
  /// Gives the value read in place of the stored one.
  std::uint32_t (Device::*on_read)(std::uint32_t stored) const = nullptr;

  constexpr bool is_read_only() const { return (writable | write_1_to_clear | strobe | unimplemented) == 0; }
};

/// The laws of a table: offsets aligned and rising; no bit in two classes; resets only in bits that are stored.
template <class Device, std::size_t N>
constexpr bool is_well_formed(const std::array<RegisterInfo<Device>, N>& table) {
  for (std::size_t i = 0; i < N; ++i) {
    const auto& r = table[i];
    if (r.offset % 4 != 0 || (i > 0 && r.offset <= table[i - 1].offset)) return false;
    const std::uint32_t masks[] = {r.writable, r.write_1_to_clear, r.strobe, r.read_only, r.unimplemented};
    std::uint32_t seen = 0;
    for (const std::uint32_t mask : masks) {
      if ((seen & mask) != 0) return false;
      seen |= mask;
    }
    if ((r.reset & ~(r.writable | r.write_1_to_clear | r.read_only)) != 0) return false;
  }
  return true;
}

template <class Device, std::size_t N>
class RegisterFile {
 public:
  using Table = std::array<RegisterInfo<Device>, N>;

  /// `table` lives as long as the file; `log` may be null.
  constexpr explicit RegisterFile(const Table& table, RegisterLog* log = nullptr) : table_(table), log_(log) {
    reset();
  }

  /// Every register to its reset value; counts of mistakes stay.
  constexpr void reset() {
    for (std::size_t i = 0; i < N; ++i) values_[i] = table_[i].reset;
  }

  /// What the CPU reads.
  std::uint32_t read(const Device& device, std::uint32_t offset) {
    const std::size_t i = find(offset);
    if (i == N) {
      report(offset % 4 != 0 ? GuestMistake::kUnaligned : GuestMistake::kUnknownOffset, {"", offset, 0, false});
      return 0;
    }
    return table_[i].on_read != nullptr ? (device.*table_[i].on_read)(values_[i]) : values_[i];
  }

  /// What the CPU writes.
  void write(Device& device, std::uint32_t offset, std::uint32_t written) {
    const std::size_t i = find(offset);
    if (i == N) {
      report(offset % 4 != 0 ? GuestMistake::kUnaligned : GuestMistake::kUnknownOffset, {"", offset, written, true});
      return;
    }
    const RegisterInfo<Device>& r = table_[i];
    const RegisterEvent event{r.name, offset, written, true};
    if (r.is_read_only()) {
      report(GuestMistake::kReadOnlyWrite, event);
      return;
    }
    if ((written & r.unimplemented) != 0) {
      ++unimplemented_count_;
      if (log_ != nullptr) log_->unimplemented(event);
    }
    if ((written & ~(r.writable | r.write_1_to_clear | r.strobe | r.read_only | r.unimplemented)) != 0)
      report(GuestMistake::kReservedBits, event);
    const std::uint32_t before = values_[i];
    values_[i] = ((before & ~r.writable) | (written & r.writable)) & ~(written & r.write_1_to_clear);
    if (r.on_write != nullptr) (device.*r.on_write)(written, before);
  }

  /// The stored value, for the device itself; the offset must be in the table (0 and no effect otherwise).
  constexpr std::uint32_t value(std::uint32_t offset) const {
    const std::size_t i = find(offset);
    return i < N ? values_[i] : 0;
  }
  constexpr void set_value(std::uint32_t offset, std::uint32_t value) {
    const std::size_t i = find(offset);
    if (i < N) values_[i] = value;
  }
  constexpr void set_bits(std::uint32_t offset, std::uint32_t bits) { set_value(offset, value(offset) | bits); }

  /// A mistake that only the device can see.
  void report_illegal_value(std::uint32_t offset, std::uint32_t written) {
    const std::size_t i = find(offset);
    report(GuestMistake::kIllegalValue, {i < N ? table_[i].name : "", offset, written, true});
  }

  std::uint32_t mistake_count(GuestMistake mistake) const { return mistakes_[static_cast<std::size_t>(mistake)]; }
  std::uint32_t mistake_count() const {
    std::uint32_t sum = 0;
    for (const std::uint32_t n : mistakes_) sum += n;
    return sum;
  }
  std::uint32_t unimplemented_count() const { return unimplemented_count_; }

 private:
  /// Index of the register at `offset`, N when there is none. Tables are sorted.
  constexpr std::size_t find(std::uint32_t offset) const {
    std::size_t first = 0, count = N;
    while (count > 0) {
      const std::size_t half = count / 2;
      if (table_[first + half].offset < offset) {
        first += half + 1;
        count -= half + 1;
      } else {
        count = half;
      }
    }
    return first < N && table_[first].offset == offset ? first : N;
  }

  void report(GuestMistake mistake, const RegisterEvent& event) {
    ++mistakes_[static_cast<std::size_t>(mistake)];
    if (log_ != nullptr) log_->guest_mistake(mistake, event);
  }

  const Table& table_;
  RegisterLog* log_ = nullptr;
  std::array<std::uint32_t, N> values_{};
  std::array<std::uint32_t, static_cast<std::size_t>(GuestMistake::kCount)> mistakes_{};
  std::uint32_t unimplemented_count_ = 0;
};

}  // namespace usuzumi::gfx
