// Plays a bundle on this host and prints the manifest's lines: usuzumi_golden_play BUNDLE [BOARD]
//
// BOARD plays in that board's memory, passing over what the board does not have. Uses no library of the simulator, so
// that it can be built anew with other compiler options from the device's sources alone.
#include <cstdio>
#include <memory>
#include <string_view>
#include <vector>

#include "tests/golden/board_budget.h"
#include "tests/golden/player/player.h"

namespace usuzumi::golden {
namespace {

constexpr int kOk = 0, kUsage = 2, kBadInput = 3, kDevice = 5;  // as the usuzumi command's

class StandardOutput final : public LineSink {
  void do_line(std::string_view text) override {
    std::fwrite(text.data(), 1, text.size(), stdout);
  }
};

/// In words, so that the bundle lies at a multiple of 4. False where the file cannot be read.
bool read_words(const char* path, std::vector<std::uint32_t>& words, std::size_t& bytes) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path, "rb"), std::fclose);
  if (file == nullptr) return false;
  constexpr std::size_t kStep = std::size_t{1} << 20;
  for (bytes = 0;;) {
    words.resize((bytes + kStep) / sizeof words[0] + 1);
    const std::size_t got = std::fread(reinterpret_cast<char*>(words.data()) + bytes, 1, kStep, file.get());
    bytes += got;
    if (got < kStep) return std::ferror(file.get()) == 0;
  }
}

const BoardBudget* find_board(std::string_view name) {
  for (const BoardBudget& budget : kBoardBudgets)
    if (budget.board == name) return &budget;
  return nullptr;
}

int play_file(const char* path, const BoardBudget& board) {
  std::vector<std::uint32_t> words;
  std::size_t bytes = 0;
  if (!read_words(path, words, bytes)) {
    std::fprintf(stderr, "%s: cannot be read\n", path);
    return kBadInput;
  }
  std::vector<std::byte> ram(board.ram_bytes + 64), vram(board.vram_bytes), work(board.engine_work_bytes);
  StandardOutput out;
  const Status status = play(std::as_bytes(std::span(words)).first(bytes), {ram, vram, work}, board.board, out);
  if (!status.ok()) std::fprintf(stderr, "%s: %s %u\n", path, status.message, status.where);
  if (status.ok() && std::fflush(stdout) != 0) return kDevice;
  return status.ok() ? kOk : status.code == StatusCode::kDataLoss ? kBadInput : kDevice;
}

}  // namespace
}  // namespace usuzumi::golden

int main(int argc, char** argv) {
  using namespace usuzumi::golden;
  const BoardBudget* board = argc == 2 || argc == 3 ? find_board(argc == 3 ? argv[2] : "host") : nullptr;
  if (board != nullptr) return play_file(argv[1], *board);
  std::fprintf(stderr, "usuzumi_golden_play BUNDLE [BOARD]: prints what the manifest should say; boards:");
  for (const BoardBudget& budget : kBoardBudgets)
    std::fprintf(stderr, " %.*s", static_cast<int>(budget.board.size()), budget.board.data());
  std::fprintf(stderr, "\n");
  return kUsage;
}
