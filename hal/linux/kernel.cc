#include "hal/linux/kernel.h"

#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace usuzumi::linux_hal {
namespace {

int result_of(int returned) { return returned < 0 ? -errno : returned; }

class RunningKernel final : public Kernel {
  int do_open(const char* path) override { return result_of(::open(path, O_RDWR | O_CLOEXEC)); }
  int do_close(int file) override { return result_of(::close(file)); }

  int do_control(int file, unsigned long request, void* argument) override {
    for (;;) {
      const int result = result_of(::ioctl(file, request, argument));
      if (result != -EINTR && result != -EAGAIN) return result;
    }
  }

  int do_map_at(void* address, std::size_t bytes, int file, std::uint64_t offset) override {
    const int flags = MAP_FIXED | (file < 0 ? MAP_PRIVATE | MAP_ANONYMOUS : MAP_SHARED);
    void* const at = ::mmap(address, bytes, PROT_READ | PROT_WRITE, flags, file, static_cast<off_t>(offset));
    return at == MAP_FAILED ? -errno : 0;
  }

  int do_wait_readable(int file, int timeout_ms) override {
    pollfd waiting{file, POLLIN, 0};
    const int result = result_of(::poll(&waiting, 1, timeout_ms));
    if (result > 0 && (waiting.revents & POLLIN) == 0) return -ENODEV;  // the device is gone
    return result;
  }

  std::ptrdiff_t do_read(int file, void* into, std::size_t bytes) override {
    const ssize_t result = ::read(file, into, bytes);
    return result < 0 ? -errno : result;
  }
};

}  // namespace

Kernel& running_kernel() {
  static constinit RunningKernel kernel;
  return kernel;
}

}  // namespace usuzumi::linux_hal
