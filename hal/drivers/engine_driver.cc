#include "hal/drivers/engine_driver.h"

#include "hal/registers/engine.h"

namespace usuzumi {
namespace {

namespace reg = registers::engine;
using reg::ErrorCode;

constexpr std::uint32_t kEndInterrupts = reg::irq::kDone.mask() | reg::irq::kError.mask();
constexpr std::uint32_t kAllInterrupts = kEndInterrupts | reg::irq::kDoorbellIgnored.mask();

/// An interrupt latched for an earlier list can wake one wait that is not meant. More than this many are a fault.
constexpr int kMaxSpuriousWakes = 4;

Status engine_fault(std::uint32_t code, std::uint32_t word) {
  switch (static_cast<ErrorCode>(code)) {
    case ErrorCode::kListUnaligned: return {StatusCode::kInvalidArgument, "engine: the list's address is no multiple of 4", word};
    case ErrorCode::kListEmpty: return {StatusCode::kInvalidArgument, "engine: the list has no words", word};
    case ErrorCode::kListNotMemory: return {StatusCode::kInvalidArgument, "engine: the list does not lie in memory", word};
    case ErrorCode::kListCorrupt: return {StatusCode::kDataLoss, "engine: malformed packet at this word of the list", word};
    case ErrorCode::kUnknownCommand: return {StatusCode::kUnsupported, "engine: unknown command at this word of the list", word};
    case ErrorCode::kValueOutOfRange:
      return {StatusCode::kInvalidArgument, "engine: value or address out of range in the packet at this word of the list", word};
    case ErrorCode::kStateMissing:
      return {StatusCode::kFailedPrecondition, "engine: the packet at this word of the list needs a target or stream first", word};
    case ErrorCode::kOutOfInternalMemory:
      return {StatusCode::kResourceExhausted, "engine: the draw at this word of the list is too large for the engine", word};
    case ErrorCode::kInternal:
      return {StatusCode::kUnavailable, "engine: the engine itself failed at this word of the list", word};
    case ErrorCode::kNone: break;
  }
  return {StatusCode::kUnavailable, "engine: stopped with an error code this driver does not know; `where` is the code", code};
}

}  // namespace

void EngineDriver::reset_and_enable() {
  write(reg::kControl, reg::control::kSoftReset.put(1));
  write(reg::kIrqEnable, kEndInterrupts);
  started_ = false;
}

Status EngineDriver::probe() {
  probed_ = false;
  const std::uint32_t id = read(reg::kId);
  if (id != reg::kIdValue) return {StatusCode::kUnavailable, "engine: no 3D engine answers at this address", id};
  const std::uint32_t version = read(reg::kVersion);
  if (reg::version::kMajor.get(version) != reg::version::kMajor.get(reg::kVersionValue))
    return {StatusCode::kUnsupported, "engine: rasterizer of another major version", version};
  reset_and_enable();
  probed_ = true;
  return ok_status();
}

Status EngineDriver::start(BusAddress list, std::uint32_t words) {
  if (!probed_) return {StatusCode::kFailedPrecondition, "engine: start before a successful probe", 0};
  if (list == 0 || list % 4 != 0) return {StatusCode::kInvalidArgument, "engine: list address is 0 or no multiple of 4", list};
  if (words == 0 || words > reg::list_words::kCount.max())
    return {StatusCode::kInvalidArgument, "engine: list of 0 words or more than 0xFFFFFF", words};
  if (reg::status::kBusy.get(read(reg::kStatus)) != 0)
    return {StatusCode::kUnavailable, "engine: still busy with the last list; wait for it first", 0};
  write(reg::kIrqStatus, kAllInterrupts);
  write(reg::kListAddress, list);
  write(reg::kListWords, words);
  write(reg::kDoorbell, reg::doorbell::kRing.put(1));
  started_ = true;
  return ok_status();
}

Status EngineDriver::wait_done(std::uint32_t timeout_us) {
  if (!started_) return {StatusCode::kFailedPrecondition, "engine: wait without a started list", 0};
  for (int wake = 0; wake <= kMaxSpuriousWakes; ++wake) {
    const Status waited = interrupts_.wait(Interrupt::kEngineDone, timeout_us);
    const std::uint32_t ended = read(reg::kIrqStatus) & kEndInterrupts;
    if (ended != 0) {  // even when the wait timed out: the list may have ended just then
      write(reg::kIrqStatus, ended);
      started_ = false;
      return reg::irq::kError.get(ended) != 0 ? engine_fault(read(reg::kErrorCode), read(reg::kErrorWord)) : ok_status();
    }
    if (waited.code == StatusCode::kDeadlineExceeded) {
      reset_and_enable();
      return {StatusCode::kDeadlineExceeded, "engine: list not done in this many microseconds; engine reset", timeout_us};
    }
    if (!waited.ok()) return waited;
  }
  reset_and_enable();
  return {StatusCode::kUnavailable, "engine: interrupts arrive but no list ends; engine reset", 0};
}

std::uint64_t EngineDriver::cycles() {
  return std::uint64_t{read(reg::kCyclesHigh)} << 32 | read(reg::kCyclesLow);
}
std::uint32_t EngineDriver::faces_drawn() { return read(reg::kFacesDrawn); }
std::uint32_t EngineDriver::faces_in() { return read(reg::kFacesIn); }
std::uint32_t EngineDriver::vertices() { return read(reg::kVertices); }
std::uint32_t EngineDriver::error_code() { return read(reg::kErrorCode); }
std::uint32_t EngineDriver::rasterizer_version() { return read(reg::kVersion); }

}  // namespace usuzumi
