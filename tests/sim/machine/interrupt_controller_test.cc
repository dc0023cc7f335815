// The interrupt controller by its registers; offsets and bits are literals here.
#include "sim/machine/interrupt_controller.h"

#include <gtest/gtest.h>

namespace usuzumi::sim {
namespace {

constexpr std::uint32_t kId = 0x00, kLine = 0x04, kPend = 0x08, kEn = 0x0C, kAck = 0x10;
constexpr std::uint32_t kEngine = 1, kBlank = 2, kFault = 4;

struct InterruptControllerTest : ::testing::Test {
  InterruptController controller;
};

TEST_F(InterruptControllerTest, HasTheResetsOfThePage) {
  EXPECT_EQ(controller.read(kId), 0x43495A55u);  // "UZIC", first letter in the lowest byte
  for (const std::uint32_t offset : {kLine, kPend, kEn, kAck}) EXPECT_EQ(controller.read(offset), 0u);
  EXPECT_EQ(controller.registers().mistake_count(), 0u);
}

TEST_F(InterruptControllerTest, GivesEachLineTheBitOfItsNumber) {
  controller.set_line(Interrupt::kEngineDone, true);
  EXPECT_EQ(controller.read(kLine), kEngine);
  controller.set_line(Interrupt::kVerticalBlank, true);
  EXPECT_EQ(controller.read(kLine), kEngine | kBlank);
  controller.set_line(Interrupt::kDisplayFault, true);
  EXPECT_EQ(controller.read(kLine), kEngine | kBlank | kFault);
}

TEST_F(InterruptControllerTest, LatchesARiseWhetherEnabledOrNot) {
  controller.set_line(Interrupt::kVerticalBlank, true);
  EXPECT_EQ(controller.read(kPend), kBlank);
  EXPECT_FALSE(controller.interrupts_cpu(Interrupt::kVerticalBlank));
  controller.write(kEn, kBlank);
  EXPECT_TRUE(controller.interrupts_cpu(Interrupt::kVerticalBlank));
  EXPECT_FALSE(controller.interrupts_cpu(Interrupt::kEngineDone));
}

TEST_F(InterruptControllerTest, AcknowledgedLineStaysQuietUntilItRisesAnew) {
  controller.write(kEn, 7);
  controller.set_line(Interrupt::kEngineDone, true);
  controller.set_line(Interrupt::kDisplayFault, true);
  controller.write(kAck, kEngine);
  EXPECT_EQ(controller.read(kPend), kFault);
  EXPECT_EQ(controller.read(kLine), kEngine | kFault) << "the device still holds its line";
  controller.set_line(Interrupt::kEngineDone, true);
  EXPECT_EQ(controller.read(kPend), kFault) << "no rise, no interrupt";
  controller.set_line(Interrupt::kEngineDone, false);
  controller.set_line(Interrupt::kEngineDone, true);
  EXPECT_EQ(controller.read(kPend), kEngine | kFault);
}

TEST_F(InterruptControllerTest, AWithdrawnCauseIsNotPending) {
  controller.set_line(Interrupt::kEngineDone, true);
  controller.set_line(Interrupt::kEngineDone, false);
  EXPECT_EQ(controller.read(kPend), 0u);
}

TEST_F(InterruptControllerTest, OnlyThePagesBitsCanBeWritten) {
  controller.write(kEn, 0xFFFFFFFFu);
  EXPECT_EQ(controller.read(kEn), 7u);
  controller.write(kAck, 8);
  EXPECT_EQ(controller.registers().mistake_count(gfx::GuestMistake::kReservedBits), 2u);
  controller.write(kPend, 7);
  controller.write(kLine, 7);
  controller.write(kId, 7);
  EXPECT_EQ(controller.registers().mistake_count(gfx::GuestMistake::kReadOnlyWrite), 3u);
  EXPECT_EQ(controller.read(0x14), 0u);
  EXPECT_EQ(controller.registers().mistake_count(gfx::GuestMistake::kUnknownOffset), 1u);
}

}  // namespace
}  // namespace usuzumi::sim
