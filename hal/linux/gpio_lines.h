// Lines of one GPIO chip through libgpiod: inputs with edge events, outputs.
//
// One interface, two libraries: gpio_lines_v1.cc is written for libgpiod 1.6 (Debian 12), gpio_lines_v2.cc for 2.x,
// whose C interface is another. The build takes the one that is installed (USUZUMI_LIBGPIOD, 1 or 2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/linux/status_text.h"
#include "hal/status.h"

struct gpiod_chip;
struct gpiod_line;
struct gpiod_line_request;
struct gpiod_edge_event_buffer;

namespace usuzumi::linux_hal {

struct GpioLine {
  unsigned offset = 0;  // within the chip
  bool active_low = false;
};

/// An input became active or inactive: meaning, not voltage.
struct GpioEdge {
  std::size_t input = 0;  // index among the inputs
  bool active = false;
  std::uint64_t time_ns = 0;  // when the kernel saw it, CLOCK_MONOTONIC
};

class GpioLines {
 public:
  static constexpr std::size_t kMostLines = 8;  // inputs, and as many outputs
  static constexpr const char* kConsumer = "usuzumi";  // as gpioinfo shows who holds a line
  /// Reads of a queue after which read_edges() stops: twice what empties the longest (16 edges of each input). On a
  /// line that chatters there is always one more.
  static constexpr int kMostReads = 4;

  GpioLines() = default;
  ~GpioLines() { close(); }
  GpioLines(const GpioLines&) = delete;
  GpioLines& operator=(const GpioLines&) = delete;

  /// Takes the lines; outputs begin inactive. `chip`: its label or name as gpiodetect lists them, or the path of its
  /// device. kUnavailable where chip or line is missing, another program's, without rights or without interrupts: the
  /// text says which; nothing stays open then.
  Status open(const char* chip, std::span<const GpioLine> inputs, std::span<const GpioLine> outputs);
  /// Gives the lines back. Outputs keep their level until somebody else takes them, as the kernel has it.
  void close();
  bool is_open() const { return chip_open_; }

  /// The level now, whatever was read or lost of events.
  Result<bool> get(std::size_t input);
  Status set(std::size_t output, bool active);
  /// Until an edge waits to be read, or `timeout_us` have passed: whether one does.
  Result<bool> wait_edge(std::uint32_t timeout_us);
  /// The edges since the last call, oldest first per input, as far as the kernel's queue and `edges` have room; of
  /// those that had come before the call none is left behind in the kernel. How many.
  Result<std::size_t> read_edges(std::span<GpioEdge> edges);

 private:
  /// `chip` by path, or by a look at every chip there is.
  Status open_chip(const char* chip);
  Status chip_failed(const char* chip, int error);
  Status line_failed(unsigned offset, int error);
  Status access_failed(const char* what, unsigned offset, int error);

  Status take_lines();           // of chip_, by the library's version
  bool open_path(const char* path);
  bool chip_is_called(const char* label_or_name);
  void close_chip();

  const char* chip_text_ = "";  // as asked for
  bool chip_open_ = false;
  std::array<GpioLine, kMostLines> inputs_{}, outputs_{};
  std::size_t input_count_ = 0, output_count_ = 0;
  gpiod_chip* chip_ = nullptr;
#if USUZUMI_LIBGPIOD == 2
  gpiod_line_request* input_request_ = nullptr;
  gpiod_line_request* output_request_ = nullptr;
  gpiod_edge_event_buffer* events_ = nullptr;
#else
  std::array<gpiod_line*, kMostLines> input_lines_{}, output_lines_{};
#endif
  StatusText text_;
};

}  // namespace usuzumi::linux_hal
