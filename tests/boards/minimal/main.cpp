// The least that a port is: five functions, its memories, and how the processor starts. Stands in for a board that has
// a timer, and a display that shows whatever its one register points at.
#include "boards/bare_metal/semihosting.h"
#include "boards/bare_metal/start.h"
#include "boards/bare_metal/trap.h"
#include "boards/common/run.h"
#include "tests/golden/player/bundle.h"
#include "tests/golden/player/player.h"

namespace {

using namespace usuzumi;

volatile std::uint32_t& device_register(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

class MinimalBoard final : public boards::Board {
  static constexpr std::uintptr_t kTimerValue = 0x40002004, kTimerControl = 0x40002008;  // CMSDK dual timer, 25 MHz

 public:
  MinimalBoard() { device_register(kTimerControl) = 0x82; }  // enabled, 32 bits, running down

 private:
  std::uint64_t do_now_ns() override {
    const std::uint32_t value = device_register(kTimerValue);
    ticks_ += last_ - value;  // right across a wrap
    last_ = value;
    return ticks_ * 40;
  }
  Status do_start(const Scanout& scanout) override {
    scanout_ = scanout;
    return ok_status();
  }
  Status do_show(std::uint32_t picture, const PictureRectangle*) override {
    display_address_ = scanout_.picture[picture];
    return ok_status();
  }
  PinInputs do_read() override { return {.ignition = true}; }
  void do_set_backlight(bool) override {}
  void do_print(std::string_view line) override { boards::semihosting::print(line); }

  Scanout scanout_;
  volatile std::uint32_t display_address_ = 0;
  std::uint64_t ticks_ = 0;
  std::uint32_t last_ = 0xFFFFFFFF;
};

constexpr std::uintptr_t kPsram = 0x21000000, kFlash = 0x21800000;
constexpr std::size_t kVramBytes = 8 << 20, kFlashBytes = 8 << 20;
alignas(64) std::byte ram[2 << 20], engine_work[1 << 20];

std::span<std::byte> memory_at(std::uintptr_t address, std::size_t bytes) {
  return {reinterpret_cast<std::byte*>(address), bytes};
}

class Console final : public golden::LineSink {
  void do_line(std::string_view line) override { boards::semihosting::print(line); }
};

/// The flash holds goldens in place of drawing data. Those too big for a cortex-a9 are too big for this board.
int play_goldens(std::span<const std::byte> bundle) {
  Console console;
  const std::span<std::byte> vram = memory_at(kPsram, kVramBytes);
  const Status played = golden::play(bundle, {ram, vram, engine_work}, "cortex-a9", console);
  if (!played.ok()) boards::semihosting::print(played.message);
  return boards::exit_code_of(played);
}

}  // namespace

int main() {
  if (device_register(kFlash) == golden::bundle::kMagic) return play_goldens(memory_at(kFlash, kFlashBytes));
  static MinimalBoard board;
  boards::RunConfig config;
  config.frames = 4;
  config.orbit = true;
  config.instrument.device = {.board = "minimal",
                              .width = 480,
                              .height = 272,
                              .pixel_format = command::PixelFormat::kRgb565,
                              .depth_format = command::DepthFormat::kUnorm16};
  return boards::run(board,
                     {.rom = identity_region(memory_at(kFlash, kFlashBytes), false),
                      .ram = identity_region(ram),
                      .vram = identity_region(memory_at(kPsram, kVramBytes)),
                      .engine_work = engine_work},
                     config);
}

extern "C" {
extern std::uint32_t __stack_top[];
[[noreturn]] void reset();
[[noreturn]] void fault();

void reset() {
  device_register(0xE000ED88) |= 0xFu << 20;  // CPACR: the FPU may be used
  asm volatile("dsb\n isb" ::: "memory");
  usuzumi::boards::start_program();
}
void fault() { usuzumi::boards::trap("processor fault", std::uintptr_t{0}); }
}

/// Stack, reset and the faults; this board takes no interrupt.
struct Vectors {
  std::uint32_t* stack;
  void (*handler[15])();
};
[[gnu::section(".vectors"), gnu::used]] const Vectors vectors{__stack_top, {reset, fault, fault, fault, fault, fault}};
