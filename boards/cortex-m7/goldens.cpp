// The player of the golden pictures on the cortex-m7 board: prints the lines of tests/golden/manifest.
#include "boards/bare_metal/semihosting.h"
#include "boards/common/run.h"
#include "boards/common/text_line.h"
#include "boards/cortex-m7/high_water.h"
#include "boards/cortex-m7/memory_map.h"
#include "tests/golden/player/player.h"

namespace {

using namespace usuzumi;
using namespace usuzumi::boards;
using namespace usuzumi::boards::cortex_m7;

class Console final : public golden::LineSink {
  void do_line(std::string_view text) override { semihosting::print(text); }
};

}  // namespace

/// The bundle lies in the flash of the drawing data.
int main() {
  Console console;
  const Status played = golden::play(
      rom(), {.ram = firmware_memory(), .vram = vram(), .engine_work = engine_memory()}, "cortex-m7", console);
  TextLine line;
  line.text("# memory stack=").number(deepest_stack_bytes()).text("/").number(stack_memory().size());
  semihosting::print(line.finish());
  if (played.ok()) return kExitOk;
  semihosting::print(
      TextLine().text("# error: ").text(played.message).text(" ").number(played.where).finish());
  return exit_code_of(played);
}
