#include "boards/cortex-a9/sp804.h"

namespace usuzumi::boards::cortex_a9 {
namespace {

// DDI 0271, section 3.2; the second timer's registers lie 0x20 higher.
constexpr std::uint32_t kLoad = 0x00, kValue = 0x04, kControl = 0x08, kIntClr = 0x0C, kMis = 0x14, kBgLoad = 0x18;
constexpr std::uint32_t kOneShot = 1u << 0, kSize32 = 1u << 1, kIntEnable = 1u << 5, kPeriodic = 1u << 6;
constexpr std::uint32_t kEnable = 1u << 7;  // bits 3:2, the prescaler: 0, by one

}  // namespace

void Sp804::start() {
  counter_.write(kControl, 0);
  alarm_.write(kControl, 0);
  counter_.write(kLoad, kFirstWrapUs);
  counter_.write(kControl, kSize32 | kPeriodic | kEnable);
  counter_.write(kBgLoad, 0xFFFFFFFFu);  // what it goes on from at zero; earlier, QEMU would begin with it
  last_count_ = counter_.read(kValue);
  elapsed_us_ = 0;
}

std::uint64_t Sp804::now_ns() {
  const std::uint32_t count = counter_.read(kValue);
  elapsed_us_ += last_count_ - count;  // it counts down, and the difference is right through zero too
  last_count_ = count;
  return elapsed_us_ * (1'000'000'000u / kClockHz);
}

void Sp804::set_alarm(std::uint32_t us) {
  cancel_alarm();
  alarm_.write(kLoad, us > 0 ? us : 1);
  alarm_.write(kControl, kOneShot | kSize32 | kIntEnable | kEnable);
}

void Sp804::cancel_alarm() {
  alarm_.write(kControl, 0);
  alarm_.write(kIntClr, 1);
  alarm_rang_ = false;
}

void Sp804::on_interrupt() {
  if (alarm_.read(kMis) == 0) return;
  alarm_.write(kIntClr, 1);
  alarm_rang_ = true;
}

}  // namespace usuzumi::boards::cortex_a9
