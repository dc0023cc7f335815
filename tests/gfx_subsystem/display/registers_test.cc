// The register page restated in literals, and what the CPU may do wrong with it.
#include <gtest/gtest.h>

#include "hal/registers/display.h"
#include "tests/gfx_subsystem/display/display_bench.h"

namespace usuzumi::gfx {
namespace {

struct Row {
  std::uint32_t offset, reset, writable;
};

// offset, reset, bits that read back what was written.
constexpr Row kPage[] = {
    {0x000, 0x31434455, 0}, {0x004, 0, 0x1FFF0000}, {0x008, 0, 0x00000FFF}, {0x00C, 0, 0x3FFF1FFF},
    {0x010, 0, 0x1FFF0000}, {0x014, 0, 0x0FFF1FFF}, {0x020, 0, 0},          {0x024, 0, 0x0000000F},
    {0x028, 0, 0},          {0x02C, 0, 0},          {0x030, 0, 0},          {0x034, 0, 0x00FFFFFF},
    {0x038, 0, 0x00000001}, {0x03C, 0, 0},          {0x100, 0, 0x810F3F00}, {0x240, 0, 0xFFFFFFFC},
    {0x244, 0, 0x1FFF1FFF}, {0x280, 0, 0x00000007}, {0x284, 0, 0x0FFF0FFF}, {0x288, 0, 0x0FFF0FFF},
    {0x28C, 0, 0xFFFFFFFF}, {0x290, 0, 0},          {0x294, 0, 0},          {0x298, 0, 0},
};
constexpr Row kLayerPage[] = {
    {0x00, 0x00FF0000, 0x00FF0033}, {0x04, 0, 0x0000FFFC}, {0x08, 0, 0xFFFFFFFC}, {0x0C, 0, 0xFFFFFFFC},
    {0x10, 0, 0x1FFF1FFF},          {0x14, 0, 0x0FFF0FFF}, {0x18, 0, 0x00FFFFFF}, {0x1C, 0, 0x00000001},
};

TEST(DisplayRegisters, OffsetsResetsAndWritableBitsAreThoseOfThePage) {
  TestMemory memory(64);
  CableTap cable;
  const auto check = [&](const Row& row, std::uint32_t base) {
    DisplayController controller(memory, cable, {});
    EXPECT_EQ(controller.read(base + row.offset), row.reset) << std::hex << base + row.offset;
    controller.write(base + row.offset, 0xFFFFFFFF);
    std::uint32_t after = controller.read(base + row.offset);
    if (base != 0 && row.offset == 0x1C) {
      EXPECT_EQ(after, 0x80000001u) << "a flip is pending";
      after &= 1;
    }
    EXPECT_EQ(after & row.writable, row.writable) << std::hex << base + row.offset;
    EXPECT_EQ(after & ~row.writable, row.writable != 0 ? 0u : row.reset) << std::hex << base + row.offset;
  };
  for (const Row& row : kPage) check(row, 0);
  for (std::uint32_t base : {0x140u, 0x180u, 0x1C0u, 0x200u})
    for (const Row& row : kLayerPage) check(row, base);
  EXPECT_EQ(std::size(kPage) + 4 * std::size(kLayerPage), DisplayController::kRegisterCount);
}

TEST(DisplayRegisters, FieldsLieWhereThePageSaysTheyDo) {
  using namespace display_registers;
  EXPECT_EQ(Htp::kHtp.put(0x1FFF), 0x1FFF0000u);
  EXPECT_EQ(Hdp::kHdp.put(0xFFF), 0x00000FFFu);
  EXPECT_EQ(Hsp::kHsp.put(0x1FFF) | Hsp::kHsw.put(0), 0x00001FFFu);
  EXPECT_EQ(Hsp::kHsw.put(0xFF), 0x00FF0000u);
  EXPECT_EQ(Hsp::kVsw.put(0x3F), 0x3F000000u);
  EXPECT_EQ(Vtr::kVtr.put(0x1FFF), 0x1FFF0000u);
  EXPECT_EQ(Vdp::kVdp.put(0xFFF), 0x0FFF0000u);
  EXPECT_EQ(Vdp::kVsp.put(0x1FFF), 0x00001FFFu);
  EXPECT_EQ(Dcm1::kSc.put(63), 0x00003F00u);
  EXPECT_EQ(Dcm1::kLayers.put(15), 0x000F0000u);
  EXPECT_EQ(Dcm1::kCursor.put(1), 0x01000000u);
  EXPECT_EQ(Dcm1::kDen.put(1), 0x80000000u);
  EXPECT_EQ(LayerMode::kFmt.put(3) | LayerMode::kKey.put(1) | LayerMode::kPpa.put(1) | LayerMode::kGa.put(255),
            0x00FF0033u);
  EXPECT_EQ(LayerFlip::kBank.put(1) | LayerFlip::kShown.put(1) | LayerFlip::kPend.put(1), 0xC0000001u);
  EXPECT_EQ(CfgE::kTiming.put(1) | CfgE::kSignature.put(1) | CfgE::kLayers.put(15) | CfgE::kCursor.put(1), 0x010F0003u);
  EXPECT_EQ(kIntVerticalBlank, 1u);
  EXPECT_EQ(kIntFifoUnderflow, 2u);
  EXPECT_EQ(kIntSignatureMismatch, 4u);
  EXPECT_EQ(kIntConfigurationError, 8u);
  EXPECT_EQ(static_cast<std::uint32_t>(LayerFormat::kRgb565), 0u);
  EXPECT_EQ(static_cast<std::uint32_t>(LayerFormat::kXrgb8888), 1u);
  EXPECT_EQ(static_cast<std::uint32_t>(LayerFormat::kArgb8888), 2u);
  EXPECT_EQ(layer_register(3, LayerFlip::kOffset), 0x21Cu);
}

TEST(DisplayRegisters, SplitDisplayIsUnimplementedNotAGuestMistake) {
  SmallDisplay d;
  d.write(0x008, 5u << 16 | 7);
  EXPECT_EQ(d.read(0x008), 7u);
  EXPECT_EQ(d.controller.registers().unimplemented_count(), 1u);
  EXPECT_EQ(d.controller.registers().mistake_count(), 0u);
}

TEST(DisplayRegisters, GuestMistakesAreCountedAndChangeNothing) {
  SmallDisplay d;
  d.write(0x290, 1);
  d.write(0x300, 1);
  d.write(0x005, 1);
  d.write(0x148, 0x80000002);
  EXPECT_EQ(d.read(0x148), 0x80000000u);
  EXPECT_EQ(d.controller.registers().mistake_count(GuestMistake::kReadOnlyWrite), 1u);
  EXPECT_EQ(d.controller.registers().mistake_count(GuestMistake::kUnknownOffset), 1u);
  EXPECT_EQ(d.controller.registers().mistake_count(GuestMistake::kUnaligned), 1u);
  EXPECT_EQ(d.controller.registers().mistake_count(GuestMistake::kReservedBits), 1u);
}

// Timing{htp, hdp, hsp, hsw, vtr, vdp, vsp, vsw, sc}
using display_registers::Timing;
using display_registers::timing_fault;

TEST(TimingLegality, TheSmallestLegalTimingAndEachStepBelowIt) {
  constexpr Timing good{4, 1, 2, 0, 4, 1, 2, 0, 0};
  EXPECT_EQ(timing_fault(good), nullptr);
  EXPECT_NE(timing_fault({3, 1, 2, 0, 4, 1, 2, 0, 0}), nullptr) << "HTP = HSP + HSW + 1";
  EXPECT_NE(timing_fault({4, 0, 2, 0, 4, 1, 2, 0, 0}), nullptr) << "HDP = 0";
  EXPECT_NE(timing_fault({4, 2, 2, 0, 4, 1, 2, 0, 0}), nullptr) << "HSP = HDP";
  EXPECT_NE(timing_fault({4, 1, 2, 1, 4, 1, 2, 0, 0}), nullptr) << "the sync reaches the line's end";
  EXPECT_NE(timing_fault({4, 1, 2, 0, 3, 1, 2, 0, 0}), nullptr) << "VTR = VSP + VSW + 1";
  EXPECT_NE(timing_fault({4, 1, 2, 0, 4, 0, 2, 0, 0}), nullptr) << "VDP = 0";
  EXPECT_NE(timing_fault({4, 1, 2, 0, 4, 2, 2, 0, 0}), nullptr) << "VSP = VDP";
  EXPECT_NE(timing_fault({4, 1, 2, 0, 4, 1, 2, 1, 0}), nullptr) << "the sync reaches the frame's end";
  EXPECT_NE(timing_fault({4, 1, 2, 0, 4, 1, 2, 0, 64}), nullptr) << "SC has six bits";
}

TEST(TimingLegality, ValuesBeyondTheirFieldsAreRefused) {
  EXPECT_EQ(timing_fault({8191, 4095, 4096, 255, 8191, 4095, 4096, 63, 63}), nullptr);
  EXPECT_NE(timing_fault({8192, 4095, 4096, 255, 8191, 4095, 4096, 63, 63}), nullptr);
  EXPECT_NE(timing_fault({8191, 4096, 4097, 255, 8191, 4095, 4096, 63, 63}), nullptr);
  EXPECT_NE(timing_fault({8191, 4095, 4096, 256, 8191, 4095, 4096, 63, 63}), nullptr);
  EXPECT_NE(timing_fault({8191, 4095, 4096, 255, 8192, 4095, 4096, 63, 63}), nullptr);
  EXPECT_NE(timing_fault({8191, 4095, 4096, 255, 8191, 4096, 4097, 63, 63}), nullptr);
  EXPECT_NE(timing_fault({8191, 4095, 4096, 255, 8191, 4095, 4096, 64, 63}), nullptr);
  EXPECT_NE(timing_fault({8191, 0xFFFFFFFF, 4096, 255, 8191, 4095, 4096, 63, 63}), nullptr) << "0 - 1";
  EXPECT_NE(timing_fault({8191, 4095, 4096, 0xFFFFFFFF, 8191, 4095, 4096, 63, 63}), nullptr) << "0 - 1";
}

}  // namespace
}  // namespace usuzumi::gfx
