#include "boards/bare_metal/semihosting.h"

#include <cstdint>

namespace usuzumi::boards::semihosting {
namespace {

// Operation numbers of IHI 0065.
constexpr std::uint32_t kWrite0 = 0x04, kGetCommandLine = 0x15, kExitExtended = 0x20;
constexpr std::uint32_t kApplicationExit = 0x20026;  // ADP_Stopped_ApplicationExit: the program ended by itself

std::uint32_t call(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
#if __ARM_ARCH_PROFILE == 'M'
  asm volatile("bkpt #0xAB" : "+r"(r0) : "r"(r1) : "memory");
#elif defined(__thumb__)
  asm volatile("svc #0xAB" : "+r"(r0) : "r"(r1) : "memory", "lr");  // lr: overwritten where the CPU is in SVC mode
#else
  asm volatile("svc #0x123456" : "+r"(r0) : "r"(r1) : "memory", "lr");
#endif
  return r0;
}

}  // namespace

void print(std::string_view text) {
  char piece[64 + 1];  // SYS_WRITE0 wants an end mark, which a view does not have
  while (!text.empty()) {
    const std::size_t count = text.copy(piece, sizeof piece - 1);
    piece[count] = '\0';
    call(kWrite0, piece);
    text.remove_prefix(count);
  }
}

void exit(int code) {
  const std::uint32_t block[2] = {kApplicationExit, static_cast<std::uint32_t>(code)};
  call(kExitExtended, block);
  for (;;) {
  }
}

std::string_view command_line(std::span<char> buffer) {
  struct {
    char* text;
    std::uint32_t size;  // in: of the buffer; out: of the text without its end mark
  } block{buffer.data(), static_cast<std::uint32_t>(buffer.size())};
  if (call(kGetCommandLine, &block) != 0) return {};
  return {buffer.data(), block.size};
}

}  // namespace usuzumi::boards::semihosting
