#include "sim/pack/isolate.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <span>

#include "sim/common/error.h"
#include "sim/common/progress.h"

namespace usuzumi::sim {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr rlim_t kMemoryLimit = rlim_t{8}
                                << 30;  // bytes of address space; arbitrary, far above any model the format can hold

// The child's answer: this byte, then the work's bytes or the error line.
enum class Answer : char { kBytes = 'B', kError = 'E' };

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kAddressSpaceIsShadowed = true;  // AddressSanitizer reserves terabytes; a limit would stop it at once
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool kAddressSpaceIsShadowed = true;
#else
constexpr bool kAddressSpaceIsShadowed = false;
#endif
#else
constexpr bool kAddressSpaceIsShadowed = false;
#endif

void send(int fd, std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void send_error(int fd, ExitCode code, const std::string& line) {
  const std::array<char, 2> head{static_cast<char>(Answer::kError), static_cast<char>(code)};
  send(fd, head);
  send(fd, line);
}

[[noreturn]] void child(int fd, const std::string& what, const std::function<std::vector<std::byte>()>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit memory{kMemoryLimit, kMemoryLimit};
  if (!kAddressSpaceIsShadowed) ::setrlimit(RLIMIT_AS, &memory);
  const int nowhere = ::open("/dev/null", O_RDWR);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  try {
    const std::vector<std::byte> bytes = work();
    const std::array<char, 1> head{static_cast<char>(Answer::kBytes)};
    send(fd, head);
    send(fd, std::span(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  } catch (const Error& e) {
    send_error(fd, e.code(), e.what());
  } catch (const std::bad_alloc&) {
    send_error(
        fd, ExitCode::kBadInput,
        fmt::format("{}: reading it takes more than {} GiB of memory; its counts are damaged, or it must be split",
                    what, kMemoryLimit >> 30));
  } catch (const std::exception& e) {
    send_error(fd, ExitCode::kBadInput, fmt::format("{}: cannot be read: {}; export it again", what, e.what()));
  }
  ::_exit(0);
}

/// Reads until the child closes its end; false when the deadline passes first.
bool receive(int fd, SteadyClock::time_point deadline, std::vector<std::byte>& bytes) {
  constexpr int kLookMs = 100;
  std::array<std::byte, 1 << 16> block;
  while (SteadyClock::now() < deadline) {
    pollfd readable{fd, POLLIN, 0};
    if (::poll(&readable, 1, kLookMs) <= 0) continue;
    const ssize_t n = ::read(fd, block.data(), block.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    bytes.insert(bytes.end(), block.begin(), block.begin() + n);
  }
  return false;
}

int wait_for(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

}  // namespace

std::vector<std::byte> run_isolated(const std::string& what, std::chrono::seconds time_limit,
                                    const std::function<std::vector<std::byte>()>& work) {
  auto refuse = [&](const std::string& why) { throw Error(ExitCode::kBadInput, fmt::format("{}: {}", what, why)); };
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse(fmt::format("cannot start reading: {}", std::strerror(errno)));
  const pid_t pid = ::fork();
  if (pid < 0) {
    const std::string why = std::strerror(errno);
    ::close(ends[0]);
    ::close(ends[1]);
    refuse(fmt::format("cannot start reading: {}", why));
  }
  if (pid == 0) {
    ::close(ends[0]);
    child(ends[1], what, work);
  }
  ::close(ends[1]);
  const Progress progress("reading " + what);
  std::vector<std::byte> answer;
  const bool in_time = receive(ends[0], SteadyClock::now() + time_limit, answer);
  ::close(ends[0]);
  if (!in_time) ::kill(pid, SIGKILL);
  const int status = wait_for(pid);

  if (!in_time)
    refuse(fmt::format(
        "still being read after {} s; it is damaged or very large: convert it to .glb, or raise --time-limit",
        time_limit.count()));
  if (WIFSIGNALED(status))
    refuse(fmt::format("the importer crashed on it ({}); the file is damaged: export it again, best as .glb",
                       ::strsignal(WTERMSIG(status))));
  if (answer.size() >= 2 && answer[0] == std::byte{static_cast<unsigned char>(Answer::kError)})
    throw Error(static_cast<ExitCode>(answer[1]),
                std::string(reinterpret_cast<const char*>(answer.data()) + 2, answer.size() - 2));
  if (answer.empty() || WEXITSTATUS(status) != 0 || answer[0] != std::byte{static_cast<unsigned char>(Answer::kBytes)})
    refuse("the importer gave up on it without a word; the file is damaged: export it again, best as .glb");
  answer.erase(answer.begin());
  return answer;
}

}  // namespace usuzumi::sim
