// The cortex-a9 board put together.
#include "boards/bare_metal/semihosting.h"
#include "boards/common/run.h"
#include "boards/common/text_line.h"
#include "boards/cortex-a9/cortex_a9_board.h"
#include "boards/cortex-a9/memory_map.h"
#include "boards/cortex-a9/options.h"

int main() {
  using namespace usuzumi;
  using namespace usuzumi::boards;
  using namespace usuzumi::boards::cortex_a9;

  static CortexA9Board board;
  board.start();

  Options options;
  options.run.instrument.device = {.board = "cortex-a9", .width = 800, .height = 480};
  static char command_line[256];
  const std::string_view wrong = read_options(semihosting::command_line(command_line), options);
  if (!wrong.empty()) {
    board.print(TextLine().text("error: option ").text(wrong).text(" is wrong; there are ").text(kUsage).finish());
    return kExitUsage;
  }
  if (options.hold) board.hold();
  return run(board,
             {.rom = identity_region(rom(), false),
              .ram = identity_region(ram()),
              .vram = identity_region(vram()),
              .engine_work = engine_memory()},
             options.run);
}
