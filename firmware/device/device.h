// The drawing device's main program: boots once, then draws frame after frame (JP2015-22462A fig. 6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/device/scene_commands.h"
#include "firmware/device/vram_layout.h"
#include "firmware/drawing_data/drawing_data.h"
#include "firmware/solids/solid_members.h"
#include "firmware/thinning/thinning.h"
#include "hal/arena.h"
#include "hal/bus.h"
#include "hal/clock.h"
#include "hal/command_list.h"
#include "hal/display.h"
#include "hal/drivers/engine_driver.h"
#include "hal/status.h"

namespace usuzumi::firmware {

/// What the board gives the firmware. Everything outlives the Device.
struct DevicePorts {
  RegisterIo& registers;  // of the 3D engine
  BusAddress engine_base;
  InterruptWaiter& interrupts;
  Display& display;
  Clock& clock;
  BusMemory& memory;  // what engine and display fetch from
  const AddressTranslation& bus;
  std::span<const std::byte> rom;  // drawing data
  std::span<std::byte> ram;        // work area
  BusAddress vram_base;            // a multiple of Display::kPictureAlignment
  std::uint32_t vram_bytes;
};

struct DeviceConfig {
  std::string_view board = {};          // its name: drawing data packed for another are refused
  std::uint32_t width = 0, height = 0;  // pixels
  command::PixelFormat pixel_format = command::PixelFormat::kXrgb8888;
  command::DepthFormat depth_format = command::DepthFormat::kUnorm24;
  std::uint32_t engine_timeout_us = 1'000'000;  // for one frame's command list
  /// Layers to make for the meshes that have none in the drawing data (Thinning::begin()); outlives boot().
  std::span<const std::uint32_t> boot_layers_millionths = {};
};

struct FrameRequest {
  Mat4 model_to_clip;
  Lighting lighting;
  ThinningSettings thinning;
  SolidSettings solids;  // with thinning off, thresholds are 0: all are drawn by their high member
};

struct FrameReport {
  ThinningReport thinning;
  SolidsReport solids;
  std::uint64_t engine_cycles = 0;
  std::uint32_t faces_drawn = 0;        // left after clipping away, culling and zero area
  std::uint64_t thin_ns = 0;            // deciding and thinning, by the device's clock
  std::uint64_t draw_ns = 0;            // writing the command list and executing it
  std::uint64_t wait_ns = 0;            // for the vertical blank that shows the picture
};

class Device {
 public:
  explicit Device(const DevicePorts& ports)
      : ports_(ports), engine_(ports.registers, ports.engine_base, ports.interrupts) {}

  /// Checks the drawing data, carves RAM and VRAM and brings up engine and display. The panel stays dark until the
  /// first picture is shown. Where VRAM is short, depth is made 16 bits deep, then pixels 16 bits wide: vram() says
  /// what it came to.
  Status boot(const DeviceConfig& config);

  /// draw_picture(), then show_picture().
  Status draw_frame(const FrameRequest& request, FrameReport& report);

  /// Thins what has changed and draws into the picture that is not shown.
  /// kResourceExhausted: a mesh that must be drawn has no room in RAM; nothing was drawn.
  Status draw_picture(const FrameRequest& request, FrameReport& report);
  /// Shows the picture just drawn; returns once it is being sent.
  Status show_picture(FrameReport& report);
  /// Waits until what is shown has been sent whole.
  Status complete_picture();
  /// Paints the safe picture (safe_picture.h) over the one that is not shown, and shows it. Needs no engine and no
  /// drawing data: it works after a boot() that failed for their sake, too.
  Status show_safe_picture();
  /// Nothing but black is sent when this returns. What is in RAM stays.
  Status blank();

  /// After boot().
  const DrawingData& drawing_data() const { return data_; }
  const Thinning& thinning() const { return thinning_; }
  const SolidMembers& solids() const { return solids_; }
  const VramLayout& vram() const { return vram_; }
  /// The picture shown last: 0 or 1.
  std::uint32_t shown_picture() const { return back_ ^ 1; }
  /// Most bytes of RAM in use so far: command list, tables and copy with its working space.
  std::uint64_t ram_peak_bytes() const;

 private:
  bool rom_on_bus() const;
  Status refusal(const Scanout& wanted);
  /// The layout, in the formats asked for or in the next smaller ones that fit.
  Result<VramLayout> fit_vram(const DeviceConfig& config);
  /// The picture that is not shown, for the CPU to paint; empty without a display.
  std::span<std::byte> back_pixels();
  /// Shows what the CPU has painted.
  Status show_painted(const PictureRectangle& part);
  Status draw_list(const View& view, const FrameRequest& request, FrameReport& report);

  DevicePorts ports_;
  DeviceConfig config_;
  EngineDriver engine_;
  Arena ram_;
  DrawingData data_;
  Thinning thinning_;
  SolidMembers solids_;
  VramLayout vram_;
  std::span<std::uint32_t> command_words_;
  std::uint32_t back_ = 0;  // the picture that is drawn next
  PictureRectangle painted_part_;  // of the shown picture, where the CPU has painted it
  bool painted_ = false;
  bool display_ready_ = false;
  bool booted_ = false;
};

}  // namespace usuzumi::firmware
