#include "gfx_subsystem/engine/engine_device.h"

#include <array>
#include <cstddef>

#include "gfx_subsystem/engine/cost_model.h"

namespace usuzumi::gfx {
namespace {

namespace reg = registers::engine;
using reg::ErrorCode;

constexpr std::uint32_t kIrqBits = reg::irq::kDone.mask() | reg::irq::kError.mask() | reg::irq::kDoorbellIgnored.mask();
constexpr std::uint32_t kAllBits = 0xFFFFFFFFu;

ErrorCode error_code_of(StatusCode code) {
  switch (code) {
    case StatusCode::kOk: return ErrorCode::kNone;
    case StatusCode::kDataLoss: return ErrorCode::kListCorrupt;
    case StatusCode::kUnsupported: return ErrorCode::kUnknownCommand;
    case StatusCode::kInvalidArgument: return ErrorCode::kValueOutOfRange;
    case StatusCode::kFailedPrecondition: return ErrorCode::kStateMissing;
    case StatusCode::kResourceExhausted: return ErrorCode::kOutOfInternalMemory;
    case StatusCode::kUnavailable:
    case StatusCode::kDeadlineExceeded: break;
  }
  return ErrorCode::kInternal;
}

/// Engine clocks in units of virtual time, rounded up, without overflow for any count below 2^64 / (time_hz / engine_hz).
std::uint64_t time_of(std::uint64_t cycles, const EngineDevice::Config& config) {
  const std::uint64_t seconds = cycles / config.engine_hz;
  const std::uint64_t rest = cycles % config.engine_hz;  // rest * time_hz < 2^64 for clocks below 4 GHz
  return seconds * config.time_hz + (rest * config.time_hz + config.engine_hz - 1) / config.engine_hz;
}

constexpr std::uint32_t low_word(std::uint64_t v) { return static_cast<std::uint32_t>(v); }
constexpr std::uint32_t high_word(std::uint64_t v) { return static_cast<std::uint32_t>(v >> 32); }
constexpr std::uint32_t saturated(std::uint64_t v) { return v > kAllBits ? kAllBits : static_cast<std::uint32_t>(v); }

}  // namespace

constexpr RegisterFile<EngineDevice, EngineDevice::kRegisterCount>::Table EngineDevice::kTable{{
    {.name = "ID", .offset = reg::kId, .reset = reg::kIdValue, .read_only = kAllBits},
    {.name = "VERSION", .offset = reg::kVersion, .reset = reg::kVersionValue, .read_only = kAllBits},
    {.name = "CONTROL", .offset = reg::kControl, .strobe = reg::control::kSoftReset.mask(), .on_write = &EngineDevice::on_control},
    {.name = "STATUS", .offset = reg::kStatus, .read_only = reg::status::kBusy.mask() | reg::status::kError.mask()},
    {.name = "LIST_ADDRESS", .offset = reg::kListAddress, .writable = kAllBits},
    {.name = "LIST_WORDS", .offset = reg::kListWords, .writable = reg::list_words::kCount.mask()},
    {.name = "DOORBELL", .offset = reg::kDoorbell, .strobe = reg::doorbell::kRing.mask(), .on_write = &EngineDevice::on_doorbell},
    {.name = "IRQ_STATUS", .offset = reg::kIrqStatus, .write_1_to_clear = kIrqBits},
    {.name = "IRQ_ENABLE", .offset = reg::kIrqEnable, .writable = kIrqBits},
    {.name = "ERROR_CODE", .offset = reg::kErrorCode, .read_only = kAllBits},
    {.name = "ERROR_WORD", .offset = reg::kErrorWord, .read_only = kAllBits},
    {.name = "CYCLES_LOW", .offset = reg::kCyclesLow, .read_only = kAllBits},
    {.name = "CYCLES_HIGH", .offset = reg::kCyclesHigh, .read_only = kAllBits},
    {.name = "FACES_DRAWN", .offset = reg::kFacesDrawn, .read_only = kAllBits},
    {.name = "FACES_IN", .offset = reg::kFacesIn, .read_only = kAllBits},
    {.name = "VERTICES", .offset = reg::kVertices, .read_only = kAllBits},
}};

EngineDevice::EngineDevice(Engine& engine, BusMemory& memory, const Config& config, RegisterLog* log)
    : engine_(engine), memory_(memory), config_(config), registers_(kTable, log) {
  static_assert(is_well_formed(kTable));
}

bool EngineDevice::interrupt_asserted() const {
  return (registers_.value(reg::kIrqStatus) & registers_.value(reg::kIrqEnable)) != 0;
}

void EngineDevice::advance_to(std::uint64_t now) {
  if (busy_ && done_time_ <= now) finish_list();
  now_ = now;
}

void EngineDevice::on_control(std::uint32_t written, std::uint32_t) {
  if (reg::control::kSoftReset.get(written) == 0) return;
  if (busy_) done_time_ = kNever;  // the list that was running never ends
  busy_ = false;
  registers_.reset();
}

void EngineDevice::on_doorbell(std::uint32_t written, std::uint32_t) {
  if (reg::doorbell::kRing.get(written) == 0) return;
  if (busy_) {
    registers_.report_illegal_value(reg::kDoorbell, written);
    registers_.set_bits(reg::kIrqStatus, reg::irq::kDoorbellIgnored.mask());
    return;
  }
  report_ = {};
  error_code_ = execute_list();
  cycles_ = engine_cycles(report_.counters);
  start_time_ = now_;
  done_time_ = config_.hangs ? kNever : now_ + time_of(cycles_, config_);
  busy_ = true;
  registers_.set_value(reg::kStatus, reg::status::kBusy.put(1));
}

ErrorCode EngineDevice::execute_list() {
  const BusAddress address = registers_.value(reg::kListAddress);
  const std::size_t words = reg::list_words::kCount.get(registers_.value(reg::kListWords));
  if (address % 4 != 0) return refuse_list(ErrorCode::kListUnaligned, "list address is no multiple of 4");
  if (words == 0) return refuse_list(ErrorCode::kListEmpty, "list of no words");
  const std::span<const std::byte> bytes = memory_.read_window(address, words * 4);
  if (bytes.data() == nullptr) return refuse_list(ErrorCode::kListNotMemory, "list does not lie in memory");
  // Memory behind the bus is as aligned as its addresses, so that a list can be read in place as words.
  report_ = engine_.execute({reinterpret_cast<const std::uint32_t*>(bytes.data()), words}, memory_);
  ++lists_executed_;
  return error_code_of(report_.status.code);
}

ErrorCode EngineDevice::refuse_list(ErrorCode code, const char* message) {
  report_.status = {StatusCode::kInvalidArgument, message, 0};
  return code;
}

void EngineDevice::finish_list() {
  const bool failed = error_code_ != ErrorCode::kNone;
  busy_ = false;
  registers_.set_value(reg::kStatus, failed ? reg::status::kError.put(1) : 0);
  registers_.set_value(reg::kErrorCode, static_cast<std::uint32_t>(error_code_));
  registers_.set_value(reg::kErrorWord, failed ? report_.status.where : 0);
  registers_.set_value(reg::kCyclesLow, low_word(cycles_));
  registers_.set_value(reg::kCyclesHigh, high_word(cycles_));
  registers_.set_value(reg::kFacesDrawn, saturated(report_.counters.faces_drawn));
  registers_.set_value(reg::kFacesIn, saturated(report_.counters.faces_in));
  registers_.set_value(reg::kVertices, saturated(report_.counters.vertices_transformed));
  registers_.set_bits(reg::kIrqStatus, failed ? reg::irq::kError.mask() : reg::irq::kDone.mask());
}

}  // namespace usuzumi::gfx
