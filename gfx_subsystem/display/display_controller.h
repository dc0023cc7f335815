// The display controller: registers (hal/registers/display.h) on one side, pixels and sync on the other, virtual time
// between.
//
// Time is counted in ticks of the reference clock. Lines are sent at the tick of their first pixel: what memory and
// interrupts show then is what the line sees, so that a picture drawn into while it is being sent tears where the beam
// was. Within a frame, lines 0 .. VDP are the picture. The vertical blank begins with line VDP + 1: at that tick, in
// this order, the signatures are finished, FCNT rises, the shadowed registers are latched (unless locked) and INTST.VB
// is set. Latched timing rules from the next line 0 on, everything else is only looked at in picture lines anyway.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "gfx_subsystem/display/fifo.h"
#include "gfx_subsystem/display/frame_config.h"
#include "gfx_subsystem/display/timing.h"
#include "gfx_subsystem/display/video_signal.h"
#include "gfx_subsystem/register_file.h"
#include "hal/bus.h"
#include "hal/registers/display.h"

namespace usuzumi::gfx {

struct DisplayConfig {
  std::uint64_t reference_hz = display_registers::kReferenceClockHz;  // ticks per second
  std::uint64_t bus_bytes_per_second = 3'200'000'000;                 // what fetching gets: 32 bits of DDR2-800
  std::uint32_t fifo_bytes = 8192;                                    // arbitrary: about a line of 1920 pixels
};

class DisplayController {
 public:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::size_t kRegisterCount = 24 + 8 * display_registers::kLayerCount;
  using Registers = RegisterFile<DisplayController, kRegisterCount>;

  /// `log` may be null; all references outlive the controller.
  DisplayController(BusMemory& memory, VideoSink& sink, const DisplayConfig& config, RegisterLog* log = nullptr);

  std::uint32_t read(std::uint32_t offset) { return registers_.read(*this, offset); }
  /// At the time of the last advance_to().
  void write(std::uint32_t offset, std::uint32_t value) { registers_.write(*this, offset, value); }

  /// Sends every line whose time has come, `now` included. `now` never falls.
  void advance_to(std::uint64_t now);
  /// When the next line begins; kNever while stopped.
  std::uint64_t next_event() const { return running_ ? next_line_time_ : kNever; }
  /// When the next vertical blank begins; kNever while stopped.
  std::uint64_t next_vertical_blank() const;

  bool vertical_blank_asserted() const { return (pending() & display_registers::kIntVerticalBlank) != 0; }
  bool fault_asserted() const { return (pending() & ~display_registers::kIntVerticalBlank) != 0; }
  bool interrupt_asserted() const { return pending() != 0; }

  /// Fault injection: what fetching gets from the next line on.
  void set_bus(std::uint64_t bytes_per_second) { fifo_.bus_bytes_per_second = bytes_per_second; }

  /// For the host, not on the bus.
  bool running() const { return running_; }
  const ScanGeometry& geometry() const { return geometry_; }
  const Registers& registers() const { return registers_; }
  /// Lines that ran dry since the start.
  std::uint64_t starved_lines() const { return starved_lines_; }

 private:
  static const Registers::Table kTable;

  void on_dcm1(std::uint32_t written, std::uint32_t before);
  template <std::uint32_t kLayer>
  void on_flip(std::uint32_t written, std::uint32_t before);
  std::uint32_t read_dst(std::uint32_t stored) const;
  std::uint32_t read_scan(std::uint32_t stored) const;

  std::uint32_t pending() const;
  void raise(std::uint32_t interrupt) { registers_.set_bits(display_registers::IntSt::kOffset, interrupt); }
  void raise_configuration_error(std::uint32_t cfge_bits);

  // latch.cc: shadowed registers to what rules the next frame.
  // Both return false, and the geometry stays, when the timing is illegal.
  bool latch();
  bool latch_timing();
  void latch_layer(std::uint32_t layer, std::uint32_t enabled_layers);
  void latch_cursor(bool enabled);
  void latch_signature();

  void start();
  void begin_line();
  void begin_vertical_blank();
  void send_picture_line();
  void finish_signatures();
  std::size_t gather_rows(std::array<LayerRow, FrameConfig::kCursor + 1>& rows,
                          std::array<FetchSpan, FrameConfig::kCursor + 1>& spans);
  void starve_line(std::uint32_t first_starved);
  void sign_line();
  void send_blanking(bool vsync);

  BusMemory& memory_;
  VideoSink& sink_;
  FifoModel fifo_;
  Registers registers_;
  FrameConfig frame_;
  ScanGeometry geometry_, next_geometry_;
  bool running_ = false;
  std::uint32_t line_ = 0;  // being sent
  std::uint64_t now_ = 0;
  std::uint64_t next_line_time_ = 0;
  std::uint64_t starved_lines_ = 0;
  std::uint32_t picture_crc_ = 0, window_crc_ = 0;
  alignas(64) std::array<std::uint32_t, display_registers::kMaxSize> pixels_{};
  alignas(64) std::array<std::byte, 3 * display_registers::kMaxSize> rgb_{};
};

}  // namespace usuzumi::gfx
