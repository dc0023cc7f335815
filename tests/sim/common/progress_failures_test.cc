// The progress bar where the computer refuses it a thread or memory: the work goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <thread>

#include "sim/common/progress.h"
#include "tests/sim/common/terminal.h"

namespace {

std::atomic<bool> other_threads_have_memory = true;
const std::thread::id test_thread = std::this_thread::get_id();

}  // namespace

// The heap of this program, with the switch above. Not inline: gcc would take free() for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* memory = nullptr;
  if (other_threads_have_memory || std::this_thread::get_id() == test_thread) memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace usuzumi::sim {
namespace {

using namespace std::chrono_literals;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::Terminal;

class ProgressBarWithoutMemory : public ::testing::Test {
 protected:
  ~ProgressBarWithoutMemory() override { other_threads_have_memory = true; }
};

TEST_F(ProgressBarWithoutMemory, IsNotShown) {
  Terminal terminal;
  other_threads_have_memory = false;
  {
    const Progress progress("drawing", 4, terminal.screen());
    EXPECT_THAT(terminal.shown_within(300ms), IsEmpty());
  }
  EXPECT_THAT(terminal.shown_within(100ms), IsEmpty()) << "there is nothing to wipe";
}

TEST_F(ProgressBarWithoutMemory, IsWipedWhereItHadBegun) {
  Terminal terminal;
  const Progress progress("drawing", 4, terminal.screen());
  EXPECT_THAT(terminal.shown_until("\x1b[K"), HasSubstr("drawing"));
  other_threads_have_memory = false;
  EXPECT_THAT(terminal.shown_within(500ms), EndsWith("\r\x1b[K"));
}

/// While one lives, new threads want more stack than there are addresses.
class NoThreads {
 public:
  NoThreads() {
    ::pthread_getattr_default_np(&usual_);
    pthread_attr_t huge;
    ::pthread_attr_init(&huge);
    ::pthread_attr_setstacksize(&huge, std::size_t{1} << 56);
    ::pthread_setattr_default_np(&huge);
    ::pthread_attr_destroy(&huge);
  }
  ~NoThreads() {
    ::pthread_setattr_default_np(&usual_);
    ::pthread_attr_destroy(&usual_);
  }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;

 private:
  pthread_attr_t usual_{};
};

TEST(ProgressBarWithoutThread, IsNotShown) {
  Terminal terminal;
  const NoThreads none;
  ASSERT_ANY_THROW(std::jthread([] {})) << "this test needs a system that refuses";
  EXPECT_NO_THROW(Progress("drawing", 4, terminal.screen()).step());
  EXPECT_THAT(terminal.shown_within(300ms), IsEmpty());
}

}  // namespace
}  // namespace usuzumi::sim
