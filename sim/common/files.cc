#include "sim/common/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "sim/common/error.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  /// False, with errno, when the system reports a late write error.
  bool close() {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0;
  }

 private:
  int fd_;
};

[[noreturn]] void cannot_write(const fs::path& path, const std::string& why) {
  throw Error(ExitCode::kCannotWrite,
              fmt::format("{}: cannot write: {}; choose another place or free this one", path.string(), why));
}

/// False with errno on failure.
bool write_all(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

/// mkstemp makes files private; the result shall have the permissions of any new file.
mode_t new_file_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

void write_directly(const fs::path& path, std::span<const std::byte> bytes) {
  Descriptor out(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (out.get() < 0 || !write_all(out.get(), bytes) || !out.close()) cannot_write(path, std::strerror(errno));
}

void write_and_rename(const fs::path& path, std::span<const std::byte> bytes) {
  std::string temporary = path.string() + ".part-XXXXXX";
  Descriptor out(::mkostemp(temporary.data(), O_CLOEXEC));
  if (out.get() < 0) cannot_write(path, std::strerror(errno));
  if (!write_all(out.get(), bytes) || ::fchmod(out.get(), new_file_mode()) != 0 || !out.close() ||
      ::rename(temporary.c_str(), path.c_str()) != 0) {
    const std::string why = std::strerror(errno);
    ::unlink(temporary.c_str());
    cannot_write(path, why);
  }
}

}  // namespace

std::vector<std::byte> read_file(const fs::path& path, std::uint64_t max_bytes) {
  auto fail = [&](const std::string& why) {
    throw Error(ExitCode::kBadInput, fmt::format("{}: cannot read: {}; check the name", path.string(), why));
  };
  Descriptor in(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (in.get() < 0) fail(std::strerror(errno));
  struct stat info {};
  if (::fstat(in.get(), &info) != 0) fail(std::strerror(errno));
  if (S_ISDIR(info.st_mode)) fail("it is a folder");
  auto check_size = [&](std::uint64_t size) {
    if (size > max_bytes)
      throw Error(ExitCode::kBadInput, fmt::format("{}: larger than {} bytes, the most that is read here; split it",
                                                   path.string(), max_bytes));
  };
  check_size(static_cast<std::uint64_t>(info.st_size));
  std::vector<std::byte> bytes;
  std::size_t filled = 0;
  for (;;) {
    // One byte beyond the expected size shows the end without growing.
    if (filled == bytes.size()) bytes.resize(filled == 0 ? static_cast<std::size_t>(info.st_size) + 1 : filled * 2);
    const ssize_t n = ::read(in.get(), bytes.data() + filled, bytes.size() - filled);
    if (n < 0) {
      if (errno == EINTR) continue;
      fail(std::strerror(errno));
    }
    if (n == 0) break;
    filled += static_cast<std::size_t>(n);
    check_size(filled);
  }
  bytes.resize(filled);
  return bytes;
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (fs::is_directory(status)) cannot_write(path, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_directly(path, bytes);
  // A symbolic link keeps pointing: what it points to is replaced.
  const fs::path target = fs::is_symlink(fs::symlink_status(path, none)) ? fs::weakly_canonical(path, none) : path;
  write_and_rename(target.empty() ? path : target, bytes);
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace usuzumi::sim
