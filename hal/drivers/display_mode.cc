#include "hal/drivers/display_mode.h"

namespace usuzumi {
namespace {

constexpr std::uint32_t kMinSize = 16, kTargetHz = 60;

// Modest blanking, otherwise arbitrary. The back porches are lower bounds.
constexpr std::uint32_t kHFrontPorch = 16, kHSync = 32, kHBackPorchMin = 32;
constexpr std::uint32_t kVFrontPorch = 4, kVSync = 4, kVBackPorchMin = 6;

constexpr DisplayMode kKnownModes[] = {kMode480x272, kMode800x480, kMode1280x480, kMode1920x720};
static_assert([] {
  for (const DisplayMode& m : kKnownModes)
    if (display_registers::timing_fault(timing_of(m)) != nullptr) return false;
  return true;
}());

}  // namespace

Result<DisplayMode> make_display_mode(std::uint32_t width, std::uint32_t height) {
  using display_registers::kMaxSize;
  using display_registers::kReferenceClockHz;
  if (width < kMinSize || height < kMinSize || width > kMaxSize || height > kMaxSize)
    return Status{StatusCode::kInvalidArgument, "display size must be from 16x16 to 4096x4096"};
  for (const DisplayMode& m : kKnownModes)
    if (m.width == width && m.height == height) return m;

  DisplayMode mode{width, height, kHFrontPorch, kHSync, kHBackPorchMin, kVFrontPorch, kVSync, kVBackPorchMin, 1};
  // Largest divider for which the shortest frame still comes 60 times a second.
  const std::uint64_t ticks_per_frame = kReferenceClockHz / kTargetHz;
  const std::uint64_t divider = ticks_per_frame / mode.frame_ticks();
  mode.clock_divider = static_cast<std::uint32_t>(divider < 1 ? 1 : (divider > 64 ? 64 : divider));
  // Whole lines, then whole pixels, up to just above 60 Hz; none are added when even the shortest frame takes longer.
  const std::uint64_t line_ticks = std::uint64_t{mode.line_pixels()} * mode.clock_divider;
  const std::uint64_t lines = ticks_per_frame / line_ticks;
  if (lines > mode.frame_lines()) mode.v_back_porch += static_cast<std::uint32_t>(lines) - mode.frame_lines();
  const std::uint64_t pixels = ticks_per_frame / (std::uint64_t{mode.frame_lines()} * mode.clock_divider);
  if (pixels > mode.line_pixels()) mode.h_back_porch += static_cast<std::uint32_t>(pixels) - mode.line_pixels();
  return mode;
}

}  // namespace usuzumi
