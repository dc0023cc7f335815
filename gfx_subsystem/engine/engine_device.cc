#include "gfx_subsystem/engine/engine_device.h"

#include <array>
#include <cstddef>

#include "gfx_subsystem/engine/cost_model.h"

namespace usuzumi::gfx {
namespace {

namespace reg = engine_registers;
using reg::ErrorCode;

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

/// Engine clocks in units of virtual time, rounded up; no overflow while the result is below 2^64.
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
    {.name = "ID", .offset = reg::Id::kOffset, .reset = reg::Id::kReset, .read_only = kAllBits},
    {.name = "VER", .offset = reg::Ver::kOffset, .reset = reg::Ver::kReset, .read_only = kAllBits},
    {.name = "CTRL",
     .offset = reg::Ctrl::kOffset,
     .strobe = reg::Ctrl::kRst.mask(),
     .on_write = &EngineDevice::on_control},
    {.name = "STAT", .offset = reg::Stat::kOffset, .read_only = reg::Stat::kBusy.mask() | reg::Stat::kErr.mask()},
    {.name = "LADR", .offset = reg::Ladr::kOffset, .writable = kAllBits},
    {.name = "LWRD", .offset = reg::Lwrd::kOffset, .writable = reg::Lwrd::kWords.mask()},
    {.name = "BELL",
     .offset = reg::Bell::kOffset,
     .strobe = reg::Bell::kRing.mask(),
     .on_write = &EngineDevice::on_doorbell},
    {.name = "INTST", .offset = reg::IntSt::kOffset, .write_1_to_clear = reg::kIntAll},
    {.name = "INTEN", .offset = reg::IntEn::kOffset, .writable = reg::kIntAll},
    {.name = "ECODE", .offset = reg::ECode::kOffset, .read_only = kAllBits},
    {.name = "EWORD", .offset = reg::EWord::kOffset, .read_only = kAllBits},
    {.name = "CYCL", .offset = reg::CycL::kOffset, .read_only = kAllBits},
    {.name = "CYCH", .offset = reg::CycH::kOffset, .read_only = kAllBits},
    {.name = "FDRAW", .offset = reg::FDraw::kOffset, .read_only = kAllBits},
    {.name = "FIN", .offset = reg::FIn::kOffset, .read_only = kAllBits},
    {.name = "VTX", .offset = reg::Vtx::kOffset, .read_only = kAllBits},
}};

EngineDevice::EngineDevice(Engine& engine, BusMemory& memory, const Config& config, RegisterLog* log)
    : engine_(engine), memory_(memory), config_(config), registers_(kTable, log) {
  static_assert(is_well_formed(kTable));
}

bool EngineDevice::interrupt_asserted() const {
  return (registers_.value(reg::IntSt::kOffset) & registers_.value(reg::IntEn::kOffset)) != 0;
}

void EngineDevice::advance_to(std::uint64_t now) {
  if (busy_ && done_time_ <= now) finish_list();
  now_ = now;
}

void EngineDevice::on_control(std::uint32_t written, std::uint32_t) {
  if (reg::Ctrl::kRst.get(written) == 0) return;
  if (busy_) done_time_ = kNever;  // the list that was running never ends
  busy_ = false;
  registers_.reset();
}

void EngineDevice::on_doorbell(std::uint32_t written, std::uint32_t) {
  if (reg::Bell::kRing.get(written) == 0) return;
  if (busy_) {
    registers_.report_illegal_value(reg::Bell::kOffset, written);
    registers_.set_bits(reg::IntSt::kOffset, reg::kIntDoorbellIgnored);
    return;
  }
  report_ = {};
  error_code_ = execute_list();
  cycles_ = engine_cycles(report_.counters);
  start_time_ = now_;
  done_time_ = config_.hangs ? kNever : now_ + time_of(cycles_, config_);
  busy_ = true;
  registers_.set_value(reg::Stat::kOffset, reg::Stat::kBusy.put(1));
}

ErrorCode EngineDevice::execute_list() {
  const BusAddress address = registers_.value(reg::Ladr::kOffset);
  const std::size_t words = reg::Lwrd::kWords.get(registers_.value(reg::Lwrd::kOffset));
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
  registers_.set_value(reg::Stat::kOffset, failed ? reg::Stat::kErr.put(1) : 0);
  registers_.set_value(reg::ECode::kOffset, static_cast<std::uint32_t>(error_code_));
  registers_.set_value(reg::EWord::kOffset, failed ? report_.status.where : 0);
  registers_.set_value(reg::CycL::kOffset, low_word(cycles_));
  registers_.set_value(reg::CycH::kOffset, high_word(cycles_));
  registers_.set_value(reg::FDraw::kOffset, saturated(report_.counters.faces_drawn));
  registers_.set_value(reg::FIn::kOffset, saturated(report_.counters.faces_in));
  registers_.set_value(reg::Vtx::kOffset, saturated(report_.counters.vertices_transformed));
  registers_.set_bits(reg::IntSt::kOffset, failed ? reg::kIntError : reg::kIntDone);
}

}  // namespace usuzumi::gfx
