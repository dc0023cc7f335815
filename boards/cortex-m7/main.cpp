// The cortex-m7 board put together.
#include <cstdint>

#include "boards/bare_metal/semihosting.h"
#include "boards/common/run.h"
#include "boards/common/text_line.h"
#include "boards/cortex-m7/cortex_m7_board.h"
#include "boards/cortex-m7/high_water.h"
#include "boards/cortex-m7/memory_map.h"
#include "boards/cortex-m7/options.h"

namespace {

using namespace usuzumi;
using namespace usuzumi::boards;
using namespace usuzumi::boards::cortex_m7;

/// "memory stack=5120/32768 firmware=200000/327680 engine=212992/212992 free=81920": bytes ever used of each part of
/// RAM, and what no part has.
void print_memory(CortexM7Board& board) {
  TextLine line;
  line.text("memory stack=").number(deepest_stack_bytes()).text("/").number(stack_memory().size());
  line.text(" firmware=").number(touched_bytes(firmware_memory())).text("/").number(firmware_memory().size());
  line.text(" engine=").number(touched_bytes(engine_memory())).text("/").number(engine_memory().size());
  line.text(" free=").number(static_cast<std::uint64_t>(ram().data() + ram().size() - __firmware_end));
  board.print(line.finish());
}

}  // namespace

int main() {
  RunConfig config;
  config.instrument.device = {.board = "cortex-m7",
                              .width = 480,
                              .height = 272,
                              .pixel_format = command::PixelFormat::kRgb565,
                              .depth_format = command::DepthFormat::kUnorm16};
  PinScript pins;
  static char command_line[512];
  const std::string_view wrong = read_options(semihosting::command_line(command_line), config, pins);
  CortexM7Board board(pins);
  if (!wrong.empty()) {
    board.print(TextLine().text("error: option ").text(wrong).text(" is wrong; there are ").text(kUsage).finish());
    return kExitUsage;
  }
  const int code = run(board,
                       {.rom = identity_region(rom(), false),
                        .ram = identity_region(firmware_memory()),
                        .vram = identity_region(vram()),
                        .engine_work = engine_memory()},
                       config);
  print_memory(board);
  return code;
}
