// The generic register block: what the table says is what the CPU sees.
#include "gfx_subsystem/register_file.h"

#include <gtest/gtest.h>

#include <vector>

#include "hal/registers/field.h"

namespace usuzumi::gfx {
namespace {

/// A device with one register of each kind.
class Gadget {
 public:
  explicit Gadget(RegisterLog* log = nullptr) : registers(kTable, log) {}
  std::uint32_t read(std::uint32_t offset) { return registers.read(*this, offset); }
  void write(std::uint32_t offset, std::uint32_t value) { registers.write(*this, offset, value); }

  void on_control(std::uint32_t written, std::uint32_t before) {
    last_written = written;
    last_before = before;
  }
  std::uint32_t on_count(std::uint32_t) const { return 1234; }

  using Info = RegisterInfo<Gadget>;
  static constexpr std::array<Info, 4> kTable{{
      {.name = "CONTROL", .offset = 0x00, .reset = 0x5, .writable = 0xFF, .strobe = 0x100, .unimplemented = 0x200,
       .on_write = &Gadget::on_control},
      {.name = "STATUS", .offset = 0x04, .reset = 0x80000000, .write_1_to_clear = 0xF, .read_only = 0x80000000},
      {.name = "COUNT", .offset = 0x0C, .read_only = 0xFFFFFFFF, .on_read = &Gadget::on_count},
      {.name = "ID", .offset = 0x40, .reset = 0xCAFE, .read_only = 0xFFFF},
  }};

  RegisterFile<Gadget, 4> registers;
  std::uint32_t last_written = 0, last_before = 0;
};
static_assert(is_well_formed(Gadget::kTable));

class Recorder final : public RegisterLog {
 public:
  struct Entry {
    GuestMistake mistake;
    RegisterEvent event;
  };
  std::vector<Entry> mistakes;
  std::vector<RegisterEvent> unimplemented_events;

 private:
  void do_guest_mistake(GuestMistake m, const RegisterEvent& e) override { mistakes.push_back({m, e}); }
  void do_unimplemented(const RegisterEvent& e) override { unimplemented_events.push_back(e); }
};

TEST(RegisterField, PutsAndGetsItsOwnBitsOnly) {
  constexpr RegisterField field{8, 6};
  EXPECT_EQ(field.mask(), 0x3F00u);
  EXPECT_EQ(field.put(0x3F), 0x3F00u);
  EXPECT_EQ(field.put(0x7F), 0x3F00u);
  EXPECT_EQ(field.get(0xFFFF15FFu), 0x15u);
  EXPECT_EQ(field.replace(0xFFFFFFFFu, 1), 0xFFFFC1FFu);
  constexpr RegisterField whole{0, 32};
  EXPECT_EQ(whole.mask(), 0xFFFFFFFFu);
}

TEST(RegisterField, SignedFieldsKeepTheirSign) {
  constexpr RegisterField y{16, 13};
  EXPECT_EQ(y.put_signed(-1), 0x1FFF0000u);
  EXPECT_EQ(y.get_signed(0x1FFF0000u), -1);
  EXPECT_EQ(y.get_signed(0x0FFF0000u), 4095);
  EXPECT_EQ(y.get_signed(y.put_signed(-4096)), -4096);
}

TEST(RegisterFile, StartsAtTheResetValues) {
  Gadget g;
  EXPECT_EQ(g.read(0x00), 0x5u);
  EXPECT_EQ(g.read(0x04), 0x80000000u);
  EXPECT_EQ(g.read(0x40), 0xCAFEu);
}

TEST(RegisterFile, StoresWritableBitsOnlyAndTellsTheDeviceTheRawWord) {
  Gadget g;
  g.write(0x00, 0x1AB);
  EXPECT_EQ(g.read(0x00), 0xABu) << "the strobe bit is not stored";
  EXPECT_EQ(g.last_written, 0x1ABu);
  EXPECT_EQ(g.last_before, 0x5u);
  EXPECT_EQ(g.registers.mistake_count(), 0u);
}

TEST(RegisterFile, WrittenOnesClearAndWrittenZerosKeep) {
  Gadget g;
  g.registers.set_bits(0x04, 0xB);
  g.write(0x04, 0x80000002);
  EXPECT_EQ(g.read(0x04), 0x80000009u) << "the read-only bit ignores the write";
  g.write(0x04, 0);
  EXPECT_EQ(g.read(0x04), 0x80000009u);
  EXPECT_EQ(g.registers.mistake_count(), 0u);
}

TEST(RegisterFile, ReadHookGivesTheValue) {
  Gadget g;
  EXPECT_EQ(g.read(0x0C), 1234u);
}

TEST(RegisterFile, GuestMistakesChangeNothingAndAreCountedByKind) {
  Recorder log;
  Gadget g(&log);
  EXPECT_EQ(g.read(0x02), 0u);
  g.write(0x01, 7);
  EXPECT_EQ(g.read(0x08), 0u) << "a hole in the map";
  g.write(0x44, 7);
  g.write(0x40, 7);
  EXPECT_EQ(g.read(0x40), 0xCAFEu);
  g.write(0x00, 0x400 | 0x12);
  EXPECT_EQ(g.read(0x00), 0x12u);
  EXPECT_EQ(g.registers.mistake_count(GuestMistake::kUnaligned), 2u);
  EXPECT_EQ(g.registers.mistake_count(GuestMistake::kUnknownOffset), 2u);
  EXPECT_EQ(g.registers.mistake_count(GuestMistake::kReadOnlyWrite), 1u);
  EXPECT_EQ(g.registers.mistake_count(GuestMistake::kReservedBits), 1u);
  ASSERT_EQ(log.mistakes.size(), 6u);
  EXPECT_STREQ(log.mistakes[4].event.name, "ID");
  EXPECT_EQ(log.mistakes[4].event.offset, 0x40u);
  EXPECT_EQ(log.mistakes[4].event.value, 7u);
  EXPECT_TRUE(log.mistakes[4].event.is_write);
  EXPECT_TRUE(log.unimplemented_events.empty());
}

TEST(RegisterFile, UnimplementedFeaturesAreNotGuestMistakes) {
  Recorder log;
  Gadget g(&log);
  g.write(0x00, 0x200);
  EXPECT_EQ(g.registers.unimplemented_count(), 1u);
  EXPECT_EQ(g.registers.mistake_count(), 0u);
  ASSERT_EQ(log.unimplemented_events.size(), 1u);
  EXPECT_STREQ(log.unimplemented_events[0].name, "CONTROL");
  EXPECT_EQ(g.read(0x00), 0u);
}

TEST(RegisterFile, MalformedTablesAreRecognised) {
  using Table = std::array<RegisterInfo<Gadget>, 2>;
  EXPECT_FALSE(is_well_formed(Table{{{.offset = 4}, {.offset = 0}}})) << "not sorted";
  EXPECT_FALSE(is_well_formed(Table{{{.offset = 0}, {.offset = 6}}})) << "not aligned";
  EXPECT_FALSE(is_well_formed(Table{{{.offset = 0, .writable = 3, .strobe = 2}, {.offset = 4}}}))
      << "a bit in two classes";
  EXPECT_FALSE(is_well_formed(Table{{{.offset = 0, .reset = 1}, {.offset = 4}}})) << "a reset in a reserved bit";
  EXPECT_TRUE(is_well_formed(Table{{{.offset = 0}, {.offset = 4}}}));
}

TEST(RegisterFile, ResetRestoresEveryRegister) {
  Gadget g;
  g.write(0x00, 0xFF);
  g.registers.set_bits(0x04, 0x1);
  g.registers.reset();
  EXPECT_EQ(g.read(0x00), 0x5u);
  EXPECT_EQ(g.read(0x04), 0x80000000u);
}

}  // namespace
}  // namespace usuzumi::gfx
