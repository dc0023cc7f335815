// usuzumi-goldens BUNDLE: the player of the golden pictures, which prints the lines of tests/golden/manifest. It needs
// neither pins nor display: qemu-aarch64 runs it on the host's kernel.
#include <cstdio>
#include <cstring>
#include <string_view>

#include "boards/common/run.h"
#include "boards/linux-arm64/mapped_memory.h"
#include "tests/golden/player/player.h"

namespace {

class Output final : public usuzumi::golden::LineSink {
  void do_line(std::string_view text) override { std::fwrite(text.data(), 1, text.size(), stdout); }
};

}  // namespace

int main(int count, char** arguments) {
  using namespace usuzumi;
  if (count != 2) {
    std::fputs("error: give the path of a bundle, as usuzumi_golden_record writes it\n", stderr);
    return boards::kExitUsage;
  }
  linux_arm64::MappedMemory memory;
  int error = memory.map();
  if (error == 0) error = memory.map_rom(arguments[1]);
  if (error != 0) {
    std::fprintf(stderr, "error: %s: %s\n", arguments[1], std::strerror(error));
    return boards::kExitBadInput;
  }
  const boards::BoardMemory& m = memory.memory();
  Output output;
  const Status played = golden::play(
      m.rom.bytes, {.ram = m.ram.bytes, .vram = m.vram.bytes, .engine_work = m.engine_work}, "linux-arm64", output);
  if (played.ok()) return boards::kExitOk;
  std::fprintf(stderr, "error: %s %u\n", played.message, played.where);
  return boards::exit_code_of(played);
}
