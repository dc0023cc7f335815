// The 3D engine as the bus sees it: registers (hal/registers/engine.h) outside, an Engine inside.
//
// The doorbell executes the list at once, in no virtual time; the end of it then becomes visible after the engine
// clocks that the cost model charges for what was done. Pixels are thus in the target a little before the interrupt
// says so: software that waits for the interrupt, as it must, cannot tell.
#pragma once

#include <cstdint>
#include <limits>

#include "gfx_subsystem/engine/engine.h"
#include "gfx_subsystem/register_file.h"
#include "hal/bus.h"
#include "hal/registers/engine.h"

namespace usuzumi::gfx {

class EngineDevice {
 public:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::size_t kRegisterCount = 16;

  struct Config {
    std::uint64_t time_hz = 400'000'000;    // unit of every time below
    std::uint64_t engine_hz = 200'000'000;  // engine clock
    bool hangs = false;                     // fault injection: a list is executed but never ends
  };

  /// `log` may be null; all references outlive the device.
  EngineDevice(Engine& engine, BusMemory& memory, const Config& config, RegisterLog* log = nullptr);

  std::uint32_t read(std::uint32_t offset) { return registers_.read(*this, offset); }
  /// At the time of the last advance_to().
  void write(std::uint32_t offset, std::uint32_t value) { registers_.write(*this, offset, value); }

  /// Ends the running list when its time has come. `now` never falls.
  void advance_to(std::uint64_t now);
  /// When the running list ends; kNever when none does.
  std::uint64_t next_event() const { return busy_ ? done_time_ : kNever; }
  bool interrupt_asserted() const;

  /// Fault injection, as Config::hangs, from the next doorbell on.
  void inject_hang(bool hangs) { config_.hangs = hangs; }

  bool busy() const { return busy_; }
  /// Of the running list, or of the last one: doorbell and end. done_time is kNever for a list that hangs.
  std::uint64_t start_time() const { return start_time_; }
  std::uint64_t done_time() const { return done_time_; }

  /// For the host's statistics, not on the bus: what the last list made the engine do, known from the doorbell on.
  const ExecutionReport& last_report() const { return report_; }
  std::uint64_t last_cycles() const { return cycles_; }
  std::uint64_t lists_executed() const { return lists_executed_; }

  const RegisterFile<EngineDevice, kRegisterCount>& registers() const { return registers_; }

 private:
  static const RegisterFile<EngineDevice, kRegisterCount>::Table kTable;

  void on_control(std::uint32_t written, std::uint32_t before);
  void on_doorbell(std::uint32_t written, std::uint32_t before);
  /// Fetches the list named by the registers and executes it; the code that ECODE will show.
  engine_registers::ErrorCode execute_list();
  engine_registers::ErrorCode refuse_list(engine_registers::ErrorCode code, const char* message);
  void finish_list();

  Engine& engine_;
  BusMemory& memory_;
  Config config_;
  RegisterFile<EngineDevice, kRegisterCount> registers_;
  std::uint64_t now_ = 0;
  std::uint64_t start_time_ = 0;
  std::uint64_t done_time_ = 0;
  std::uint64_t cycles_ = 0;
  std::uint64_t lists_executed_ = 0;
  ExecutionReport report_;
  engine_registers::ErrorCode error_code_ = engine_registers::ErrorCode::kNone;
  bool busy_ = false;
};

}  // namespace usuzumi::gfx
