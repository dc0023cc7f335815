// Outcome of an operation that bad data, too little memory or hardware can make fail.
//
// A Status says what went wrong in words a person can act on. Our own mistakes are asserts, never a Status.
#pragma once

#include <cstdint>

namespace usuzumi {

enum class StatusCode : std::uint8_t {
  kOk = 0,
  kInvalidArgument,   // the caller's parameter is out of its documented range
  kDataLoss,          // drawing data or a command list is truncated, corrupt or contradicts itself
  kUnsupported,       // well formed, but of a version, format or feature this build does not know
  kResourceExhausted, // an arena, VRAM or a list is full
  kUnavailable,       // hardware is absent, busy or not yet configured
  kDeadlineExceeded,  // a wait ended by its timeout
  kFailedPrecondition // called in a state that does not allow it
};

/// Never owns memory: `message` points to a string literal, or to text that its driver keeps until its next error.
struct [[nodiscard]] Status {
  StatusCode code = StatusCode::kOk;
  const char* message = "";  ///< what is wrong and what to do, without a trailing period
  std::uint32_t where = 0;   ///< byte offset, word offset or mesh number; `message` says which

  constexpr bool ok() const { return code == StatusCode::kOk; }
};

constexpr Status ok_status() { return {}; }

/// The spelling of a code for logs: "data loss".
constexpr const char* status_code_name(StatusCode code) {
  switch (code) {
    case StatusCode::kOk: return "ok";
    case StatusCode::kInvalidArgument: return "invalid argument";
    case StatusCode::kDataLoss: return "data loss";
    case StatusCode::kUnsupported: return "unsupported";
    case StatusCode::kResourceExhausted: return "resource exhausted";
    case StatusCode::kUnavailable: return "unavailable";
    case StatusCode::kDeadlineExceeded: return "deadline exceeded";
    case StatusCode::kFailedPrecondition: return "failed precondition";
  }
  return "status code out of range";
}

/// A value, or the Status that says why there is none. T is default constructible.
template <class T>
class [[nodiscard]] Result {
 public:
  constexpr Result(T value) : value_(value) {}          // NOLINT(google-explicit-constructor): reads as `return value`
  constexpr Result(Status status) : status_(status) {}  // NOLINT(google-explicit-constructor): reads as `return status`

  constexpr bool ok() const { return status_.ok(); }
  constexpr const Status& status() const { return status_; }
  /// Only when ok(); the default T otherwise.
  constexpr const T& value() const { return value_; }
  constexpr T& value() { return value_; }
  constexpr const T& operator*() const { return value_; }
  constexpr const T* operator->() const { return &value_; }

 private:
  T value_{};
  Status status_{};
};

}  // namespace usuzumi
