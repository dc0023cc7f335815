// The player of the golden pictures on the cortex-a9 board: prints the lines of tests/golden/manifest.
#include <string_view>

#include "boards/common/run.h"
#include "boards/common/text_line.h"
#include "boards/cortex-a9/cortex_a9_board.h"
#include "boards/cortex-a9/memory_map.h"
#include "tests/golden/player/player.h"

namespace {

using namespace usuzumi;
using namespace usuzumi::boards;
using namespace usuzumi::boards::cortex_a9;

class Console final : public golden::LineSink {
 public:
  explicit Console(Board& board) : board_(board) {}

 private:
  void do_line(std::string_view text) override { board_.print(text); }

  Board& board_;
};

}  // namespace

/// The bundle lies in the flash of the drawing data.
int main() {
  static CortexA9Board board;
  board.start();
  Console console(board);
  const golden::PlayerMemory memory{.ram = ram(), .vram = vram(), .engine_work = engine_memory()};
  const Status played = golden::play(rom(), memory, "cortex-a9", console);
  if (played.ok()) return kExitOk;
  board.print(TextLine().text("error: ").text(played.message).text(" ").number(played.where).finish());
  return exit_code_of(played);
}
