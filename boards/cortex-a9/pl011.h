// The console: Arm PrimeCell UART PL011 (DDI 0183), 115200 baud, 8 bits, no parity, one stop bit.
#pragma once

#include <cstdint>
#include <string_view>

#include "boards/cortex-a9/registers.h"

namespace usuzumi::boards::cortex_a9 {

class Pl011 {
 public:
  explicit constexpr Pl011(Registers registers) : registers_(registers) {}

  void start();
  /// Sends what the line takes. A transmitter that stands still costs a few milliseconds once, then the text is dropped
  /// until it moves again: the console never stops the instrument.
  void print(std::string_view text);
  /// A byte that has come; 0, which nobody sends, where there is none.
  char receive();

 private:
  bool put(char c);

  Registers registers_;
  bool stuck_ = false;
};

}  // namespace usuzumi::boards::cortex_a9
