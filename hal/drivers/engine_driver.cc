#include "hal/drivers/engine_driver.h"

#include "hal/registers/engine.h"

namespace usuzumi {
namespace {

namespace reg = engine_registers;
using reg::ErrorCode;

constexpr std::uint32_t kEndInterrupts = reg::kIntDone | reg::kIntError;

/// An interrupt latched for an earlier list can wake one wait that is not meant. More than this many are a fault.
constexpr int kMaxSpuriousWakes = 4;

Status engine_fault(std::uint32_t code, std::uint32_t word) {
  switch (static_cast<ErrorCode>(code)) {
    case ErrorCode::kListUnaligned:
      return {StatusCode::kInvalidArgument, "engine: the list's address is no multiple of 4", word};
    case ErrorCode::kListEmpty: return {StatusCode::kInvalidArgument, "engine: the list has no words", word};
    case ErrorCode::kListNotMemory:
      return {StatusCode::kInvalidArgument, "engine: the list does not lie in memory", word};
    case ErrorCode::kListCorrupt:
      return {StatusCode::kDataLoss, "engine: malformed packet at this word of the list", word};
    case ErrorCode::kUnknownCommand:
      return {StatusCode::kUnsupported, "engine: unknown command at this word of the list", word};
    case ErrorCode::kValueOutOfRange:
      return {StatusCode::kInvalidArgument,
              "engine: value or address out of range in the packet at this word of the list", word};
    case ErrorCode::kStateMissing:
      return {StatusCode::kFailedPrecondition,
              "engine: the packet at this word of the list needs a target or stream first", word};
    case ErrorCode::kOutOfInternalMemory:
      return {StatusCode::kResourceExhausted, "engine: the draw at this word of the list is too large for the engine",
              word};
    case ErrorCode::kInternal:
      return {StatusCode::kUnavailable, "engine: the engine itself failed at this word of the list", word};
    case ErrorCode::kNone: break;
  }
  return {StatusCode::kUnavailable, "engine: stopped with an error code this driver does not know; `where` is the code",
          code};
}

}  // namespace

void EngineDriver::reset_and_enable() {
  write(reg::Ctrl::kOffset, reg::Ctrl::kRst.put(1));
  write(reg::IntEn::kOffset, kEndInterrupts);
  started_ = false;
}

Status EngineDriver::probe() {
  probed_ = false;
  const std::uint32_t id = read(reg::Id::kOffset);
  if (id != reg::Id::kReset) return {StatusCode::kUnavailable, "engine: no 3D engine answers at this address", id};
  const std::uint32_t version = read(reg::Ver::kOffset);
  if (reg::Ver::kMajor.get(version) != reg::Ver::kMajor.get(reg::Ver::kReset))
    return {StatusCode::kUnsupported, "engine: rasterizer of another major version", version};
  reset_and_enable();
  probed_ = true;
  return ok_status();
}

Status EngineDriver::start(BusAddress list, std::uint32_t words) {
  if (!probed_) return {StatusCode::kFailedPrecondition, "engine: start before a successful probe", 0};
  if (list == 0 || list % 4 != 0)
    return {StatusCode::kInvalidArgument, "engine: list address is 0 or no multiple of 4", list};
  if (words == 0 || words > reg::Lwrd::kWords.max())
    return {StatusCode::kInvalidArgument, "engine: list of 0 words or more than 0xFFFFFF", words};
  if (reg::Stat::kBusy.get(read(reg::Stat::kOffset)) != 0)
    return {StatusCode::kUnavailable, "engine: still busy with the last list; wait for it first", 0};
  write(reg::IntSt::kOffset, reg::kIntAll);
  write(reg::Ladr::kOffset, list);
  write(reg::Lwrd::kOffset, words);
  write(reg::Bell::kOffset, reg::Bell::kRing.put(1));
  started_ = true;
  return ok_status();
}

Status EngineDriver::wait_done(std::uint32_t timeout_us) {
  if (!started_) return {StatusCode::kFailedPrecondition, "engine: wait without a started list", 0};
  for (int wake = 0; wake <= kMaxSpuriousWakes; ++wake) {
    const Status waited = interrupts_.wait(Interrupt::kEngineDone, timeout_us);
    const std::uint32_t ended = read(reg::IntSt::kOffset) & kEndInterrupts;
    if (ended != 0) {  // even when the wait timed out: the list may have ended just then
      write(reg::IntSt::kOffset, ended);
      started_ = false;
      return (ended & reg::kIntError) != 0 ? engine_fault(read(reg::ECode::kOffset), read(reg::EWord::kOffset))
                                           : ok_status();
    }
    if (waited.code == StatusCode::kDeadlineExceeded) {
      reset_and_enable();
      return {StatusCode::kDeadlineExceeded, "engine: list not done in this many microseconds; engine reset",
              timeout_us};
    }
    if (!waited.ok()) return waited;
  }
  reset_and_enable();
  return {StatusCode::kUnavailable, "engine: interrupts arrive but no list ends; engine reset", 0};
}

std::uint64_t EngineDriver::cycles() {
  return std::uint64_t{read(reg::CycH::kOffset)} << 32 | read(reg::CycL::kOffset);
}
std::uint32_t EngineDriver::faces_drawn() { return read(reg::FDraw::kOffset); }
std::uint32_t EngineDriver::faces_in() { return read(reg::FIn::kOffset); }
std::uint32_t EngineDriver::vertices() { return read(reg::Vtx::kOffset); }
std::uint32_t EngineDriver::error_code() { return read(reg::ECode::kOffset); }
std::uint32_t EngineDriver::rasterizer_version() { return read(reg::Ver::kOffset); }

}  // namespace usuzumi
