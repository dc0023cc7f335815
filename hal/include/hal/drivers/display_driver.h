// The display controller as the firmware uses it.
//
// Every call that changes what is shown takes effect at the next vertical blank, all of its registers together.
// Registers and their meaning: hal/registers/display.h.
#pragma once

#include <cstdint>

#include "hal/bus.h"
#include "hal/display.h"
#include "hal/drivers/display_mode.h"
#include "hal/registers/display.h"
#include "hal/status.h"

namespace usuzumi {

using display_registers::LayerFormat;

/// One layer. Addresses and stride are multiples of 4 bytes; the stride holds a row (width * bytes per pixel) and is at
/// most 65532. width and height 1..4096; x and y -4096..4095, the part outside the picture is not shown.
struct LayerConfig {
  LayerFormat format = LayerFormat::kXrgb8888;
  std::uint32_t stride_bytes = 0;
  BusAddress bank_address[2] = {0, 0};  // the same address twice where there is one buffer
  std::uint32_t bank = 0;               // shown first
  std::int32_t x = 0, y = 0;
  std::uint32_t width = 0, height = 0;
  std::uint8_t global_alpha = 255;
  bool per_pixel_alpha = false;  // needs kArgb8888
  bool colour_key_enabled = false;
  std::uint32_t colour_key_rgb = 0;  // 0x00RRGGBB
};

/// CRCs of the last complete picture.
struct DisplaySignature {
  std::uint32_t picture_crc = 0;
  std::uint32_t window_crc = 0;
  std::uint32_t frame = 0;  // frame_count() when the picture was complete
};

/// What has gone wrong since it was last cleared.
struct DisplayFaults {
  bool fifo_underflow = false;
  bool signature_mismatch = false;
  bool configuration_error = false;
  std::uint32_t configuration_detail = 0;  // CFGE
  constexpr bool any() const { return fifo_underflow || signature_mismatch || configuration_error; }
};

class DisplayDriver {
 public:
  DisplayDriver(RegisterIo& io, BusAddress base) : io_(io), base_(base) {}

  /// kUnavailable when no display controller answers at the base address.
  Status probe();

  /// Sets the timing. kInvalidArgument, with the reason and before any register is written, when the mode is illegal.
  Status set_mode(const DisplayMode& mode);

  /// kInvalidArgument (nothing written) when a value is out of its range; `where` is the layer.
  Status configure_layer(std::uint32_t layer, const LayerConfig& config);
  Status show_layer(std::uint32_t layer, bool shown);
  void set_background(std::uint32_t rgb);

  /// Asks for the other picture of a layer from the next vertical blank on.
  Status request_flip(std::uint32_t layer, std::uint32_t bank);
  /// The same, with the bank's buffer moved to `address` first.
  Status request_flip(std::uint32_t layer, std::uint32_t bank, BusAddress address);
  /// True until the vertical blank that carries out the request.
  bool flip_pending(std::uint32_t layer);
  /// The bank now being sent; the other one may be drawn into when no flip is pending.
  std::uint32_t shown_bank(std::uint32_t layer);

  /// kFailedPrecondition when the timing in the registers is illegal (then the display stays off).
  Status enable();
  /// The frame being sent is completed first; running() tells when.
  void disable();
  bool running();

  /// Image of 64 x 64 ARGB8888 pixels, 256 bytes a row, at a multiple of 4.
  Status set_cursor_image(BusAddress address);
  /// Upper left corner, may lie outside the picture: -4096..4095 each.
  Status move_cursor(std::int32_t x, std::int32_t y);
  void show_cursor(bool shown);

  void enable_vertical_blank_interrupt(bool enabled);
  void enable_fault_interrupts(bool enabled);
  bool vertical_blank_seen();
  void clear_vertical_blank();
  DisplayFaults faults();
  void clear_faults();

  /// Picture CRCs are off until asked for.
  void enable_picture_signature(bool enabled);
  /// Checks a window of the picture against `reference` in every frame; a difference is a fault. kInvalidArgument when
  /// the window is empty or reaches beyond 4096; kFailedPrecondition when it is not inside the picture of the mode set.
  Status check_window(const PictureRectangle& window, std::uint32_t reference);
  /// Computes the window's CRC without checking it.
  Status measure_window(const PictureRectangle& window);
  void stop_window();
  DisplaySignature signature();

  /// Vertical blanks since reset.
  std::uint32_t frame_count();
  /// The line being sent.
  std::uint32_t scan_line();

 private:
  class Locked;

  std::uint32_t read(std::uint32_t offset) { return io_.read32(base_ + offset); }
  void write(std::uint32_t offset, std::uint32_t value) { io_.write32(base_ + offset, value); }
  void set_bits(std::uint32_t offset, std::uint32_t mask, bool on);
  Status set_window(const PictureRectangle& window, std::uint32_t reference, bool check);

  RegisterIo& io_;
  BusAddress base_;
};

}  // namespace usuzumi
