#include "sim/common/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
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

/// A new file beside `path`, which takes its name once it is complete and vanishes otherwise.
class FileBeside {
 public:
  explicit FileBeside(const fs::path& path)
      : path_(path), name_(path.string() + ".part-XXXXXX"), out_(::mkostemp(name_.data(), O_CLOEXEC)) {
    if (out_.get() < 0) cannot_write(path_, std::strerror(errno));
  }
  ~FileBeside() {
    if (!renamed_) ::unlink(name_.c_str());
  }
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;

  void write_and_rename(std::span<const std::byte> bytes) {
    renamed_ = write_all(out_.get(), bytes) && ::fchmod(out_.get(), new_file_mode()) == 0 && out_.close() &&
               ::rename(name_.c_str(), path_.c_str()) == 0;
    if (!renamed_) cannot_write(path_, std::strerror(errno));
  }

 private:
  const fs::path& path_;
  std::string name_;
  Descriptor out_;
  bool renamed_ = false;
};

/// A device or pipe takes bytes and is not replaced. Throws Error kCannotWrite for a folder.
bool is_written_directly(const fs::path& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (fs::is_directory(status)) cannot_write(path, "it is a folder");
  return fs::exists(status) && !fs::is_regular_file(status);
}

/// A symbolic link keeps pointing: what it points to is replaced.
fs::path replaced_path(const fs::path& path) {
  std::error_code none;
  const fs::path target = fs::is_symlink(fs::symlink_status(path, none)) ? fs::weakly_canonical(path, none) : path;
  return target.empty() ? path : target;
}

}  // namespace

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

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

void check_output(const fs::path& path, std::string_view option, std::span<const fs::path> inputs) {
  if (is_written_directly(path)) {
    if (::access(path.c_str(), W_OK) != 0) cannot_write(path, std::strerror(errno));
    return;
  }
  for (const fs::path& input : inputs) {
    std::error_code none;
    if (fs::equivalent(input, path, none))
      throw Error(ExitCode::kUsage,
                  fmt::format("{} {}: is an input as well; choose another name", option, path.string()));
  }
  const fs::path target = replaced_path(path);
  const FileBeside trial(target);
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  if (is_written_directly(path)) return write_directly(path, bytes);
  const fs::path target = replaced_path(path);
  FileBeside(target).write_and_rename(bytes);
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace usuzumi::sim
