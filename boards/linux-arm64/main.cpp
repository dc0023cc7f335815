// usuzumi-device: puts the instrument together on embedded Linux.
#include <cstdio>
#include <cstring>

#include "boards/common/run.h"
#include "boards/linux-arm64/linux_board.h"
#include "boards/linux-arm64/mapped_memory.h"
#include "boards/linux-arm64/options.h"

using namespace usuzumi;
using namespace usuzumi::linux_arm64;

namespace {

volatile std::sig_atomic_t stop = 0;

/// SIGTERM and SIGINT end the program after the step at hand; calls that sleep are woken.
void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop = 1; };
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // nobody reads the lines: no reason to stop
}

int refused(const Status& status) {
  std::printf("error: %s %u\n", status.message, status.where);
  return boards::kExitDevice;
}

}  // namespace

int main(int count, char** arguments) {
  setvbuf(stdout, nullptr, _IOLBF, 0);
  Options options;
  if (!parse_options(count, arguments, options)) return boards::kExitUsage;
  if (options.help) {
    std::fputs(kUsage, stdout);
    return boards::kExitOk;
  }
  stop_on_signals();

  MappedMemory memory;
  int error = memory.map();
  if (error != 0) return refused({StatusCode::kResourceExhausted, "no memory for RAM, VRAM and engine; errno",
                                  static_cast<std::uint32_t>(error)});
  error = memory.map_rom(options.rom);
  if (error != 0) std::printf("note: --rom %s: %s; usuzumi pack makes one\n", options.rom, std::strerror(error));
  error = memory.lock();
  if (error != 0) std::printf("note: memory may be swapped out: %s; raise LimitMEMLOCK\n", std::strerror(error));

  LinuxBoard board(linux_hal::running_kernel(), stop);
  if (options.pause) board.pause_after_steps();
  if (options.frames == 0) board.print_only_changes();
  const Status opened = board.open(
      options.pins, {options.card, options.width, options.height, memory.memory().vram});
  if (!opened.ok()) return refused(opened);

  boards::RunConfig config;
  config.instrument.device.board = "linux-arm64";
  config.instrument.device.width = options.width;
  config.instrument.device.height = options.height;
  if (options.rgb565) config.instrument.device.pixel_format = command::PixelFormat::kRgb565;
  config.frames = options.frames;
  config.signature = options.frames != 0;  // nobody compares a service's pictures, and a card's memory is slow to read
  config.orbit = options.orbit;
  const int code = boards::run(board, memory.memory(), config);
  board.close();
  return code;
}
