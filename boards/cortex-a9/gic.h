// Interrupts of the Cortex-A9: Arm Generic Interrupt Controller (IHI 0048), one processor, one priority.
#pragma once

#include <cstdint>

namespace usuzumi::boards::cortex_a9 {

/// What an interrupt calls, with its lines masked at the processor and `context` as it was given.
struct InterruptHandler {
  void (*function)(void* context) = nullptr;
  void* context = nullptr;
};

/// Before the first connect_interrupt(); nothing interrupts yet.
void start_interrupts();
/// Interrupt `id`, level sensitive, from now on. `id` is one that memory_map.h names.
void connect_interrupt(std::uint32_t id, InterruptHandler handler);
template <class Device>
void connect_interrupt(std::uint32_t id, Device& device) {
  connect_interrupt(id, {[](void* context) { static_cast<Device*>(context)->on_interrupt(); }, &device});
}

/// Interrupts are masked at the processor while it lives.
class InterruptLock {
 public:
  InterruptLock() { asm volatile("mrs %0, cpsr\n\tcpsid i" : "=r"(before_)::"memory"); }
  ~InterruptLock() { asm volatile("msr cpsr_c, %0" ::"r"(before_) : "memory"); }
  InterruptLock(const InterruptLock&) = delete;
  InterruptLock& operator=(const InterruptLock&) = delete;

  /// Sleeps until an interrupt is pending, and serves it. One that became pending since the lock began is not missed:
  /// it wakes the processor though it is masked.
  void sleep() const { asm volatile("dsb\n\twfi\n\tcpsie i\n\tisb\n\tcpsid i" ::: "memory"); }

 private:
  std::uint32_t before_;
};

}  // namespace usuzumi::boards::cortex_a9
