// A display as the firmware sees it: two pictures in VRAM, one of them sent to the panel.
//
// Behind it stands the device's own display controller (drivers/controller_display.h), the LCD controller of a board or
// the kernel of an embedded Linux.
#pragma once

#include <cstdint>

#include "hal/bus.h"
#include "hal/command_list.h"
#include "hal/status.h"

namespace usuzumi {

/// Part of a picture, in pixels from its upper left corner.
struct PictureRectangle {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
  constexpr bool empty() const { return width == 0 || height == 0; }
};

/// What the display is to send, and where the firmware draws it.
struct Scanout {
  std::uint32_t width = 0, height = 0;  // pixels
  command::PixelFormat format = command::PixelFormat::kXrgb8888;
  std::uint32_t stride_bytes = 0;  // as Display::stride_bytes() asked for
  BusAddress picture[2] = {};      // multiples of kPictureAlignment
  constexpr PictureRectangle whole() const { return {0, 0, width, height}; }
};

class Display {
 public:
  /// Pictures begin at multiples of this, so that a kernel can map its own memory there.
  static constexpr std::uint32_t kPictureAlignment = 4096;

  /// Bytes from one row to the next that this display wants for such a picture; at least a row. 0 when it knows of
  /// no such picture; start() then says why.
  std::uint32_t stride_bytes(std::uint32_t width, std::uint32_t height, command::PixelFormat format) {
    return do_stride_bytes(width, height, format);
  }

  /// Sets the mode. The panel shows black until the first show(). kInvalidArgument when the display cannot send
  /// such a picture, kUnavailable when there is no display. (kUnsupported is said of drawing data.)
  Status start(const Scanout& scanout) { return do_start(scanout); }

  /// Sends picture 0 or 1 from the next vertical blank on, and returns once it is being sent: the other one is then
  /// free to be drawn into. Of a picture that is shown already it waits for a vertical blank all the same, by which it
  /// has been sent whole. kDeadlineExceeded when no vertical blank comes.
  Status show(std::uint32_t picture) { return do_show(picture, nullptr); }
  /// The same of a picture that is black outside `part`, which may be empty: a display that has windows need fetch no
  /// more than the part.
  Status show_part(std::uint32_t picture, const PictureRectangle& part) { return do_show(picture, &part); }

  /// ok, or what has gone wrong with the signal since the last call.
  Status check() { return do_check(); }

 protected:
  ~Display() = default;

 private:
  virtual std::uint32_t do_stride_bytes(std::uint32_t width, std::uint32_t height, command::PixelFormat format);
  virtual Status do_start(const Scanout& scanout) = 0;
  /// `part` is null where the whole picture counts.
  virtual Status do_show(std::uint32_t picture, const PictureRectangle* part) = 0;
  virtual Status do_check() { return ok_status(); }
};

/// Rows as most display controllers fetch them: whole units of 64 bytes.
constexpr std::uint32_t default_stride_bytes(std::uint32_t width, command::PixelFormat format) {
  constexpr std::uint32_t kUnit = 64;
  return (width * command::bytes_per_pixel(format) + kUnit - 1) / kUnit * kUnit;
}

inline std::uint32_t Display::do_stride_bytes(std::uint32_t width, std::uint32_t, command::PixelFormat format) {
  return default_stride_bytes(width, format);
}

}  // namespace usuzumi
