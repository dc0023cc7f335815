// The Linux kernel as these drivers call it: the few system calls they need, so that a test can stand in for it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace usuzumi::linux_hal {

/// Every call returns what the system call returns, and where that fails the negative errno. EINTR is left to the
/// caller but for control(), which begins anew.
class Kernel {
 public:
  int open(const char* path) { return do_open(path); }  // for reading and writing; not inherited by child processes
  int close(int file) { return do_close(file); }
  int control(int file, unsigned long request, void* argument) { return do_control(file, request, argument); }
  /// Maps `bytes` of `file` from `offset` exactly at `address`, in place of what is mapped there; file -1: fresh
  /// memory, zeros. Both are whole pages.
  int map_at(void* address, std::size_t bytes, int file, std::uint64_t offset) {
    return do_map_at(address, bytes, file, offset);
  }
  /// 1 when there is something to read, 0 when `timeout_ms` have passed.
  int wait_readable(int file, int timeout_ms) { return do_wait_readable(file, timeout_ms); }
  std::ptrdiff_t read(int file, void* into, std::size_t bytes) { return do_read(file, into, bytes); }

 protected:
  ~Kernel() = default;

 private:
  virtual int do_open(const char* path) = 0;
  virtual int do_close(int file) = 0;
  virtual int do_control(int file, unsigned long request, void* argument) = 0;
  virtual int do_map_at(void* address, std::size_t bytes, int file, std::uint64_t offset) = 0;
  virtual int do_wait_readable(int file, int timeout_ms) = 0;
  virtual std::ptrdiff_t do_read(int file, void* into, std::size_t bytes) = 0;
};

/// The kernel this program runs on.
Kernel& running_kernel();

}  // namespace usuzumi::linux_hal
