// The device on a desk: machine, 3D engine, panel and firmware put together, drawing frame after frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/instrument/instrument.h"
#include "gfx_subsystem/engine/engine.h"
#include "sim/desk/frame_script.h"
#include "sim/image/image.h"
#include "sim/machine/board.h"
#include "sim/machine/machine.h"

namespace usuzumi::sim {

enum class EngineKind { kSoft, kOsmesa };

struct DeskConfig {
  BoardDescription board = host_sim();
  std::uint32_t width = 0, height = 0;  // 0: the board's panel
  EngineKind engine = EngineKind::kSoft;
  std::uint32_t threads = 1;            // of the host, for the engine
  std::vector<std::uint32_t> boot_layers_millionths;  // for meshes without layers in ROM; none: none are made
  Faults faults;                        // from power-on
  std::optional<std::vector<FrameEvent>> pins;  // by kPinNames; none: ignition on, button up
  std::vector<FrameEvent> fault_script;         // by kFaultNames
  /// Pins or faults that are played are there to be watched: then a fault of the device is shown, not thrown.
  bool watches_faults() const { return pins.has_value() || !fault_script.empty(); }
};

inline constexpr std::string_view kFaultNames[] = {"engine-hang", "slow-bus"};

/// What one frame cost and how it looked on the panel. Times in *_ms are the device's virtual time, host_*_ms the
/// host's.
struct FrameRecord {
  std::uint32_t frame = 0;
  firmware::FrameReport firmware;
  firmware::Shown shown = firmware::Shown::kDark;
  firmware::DrawMode mode = firmware::DrawMode::kThinned;
  bool backlight = false;
  std::string fault;              // why the safe picture is shown; empty where it is not
  double wake_ms = 0;             // from ignition to light, in the frame that lit it
  std::uint32_t crc32 = 0;        // of the active picture as sent, by the display controller's signature unit
  std::uint32_t panel_crc32 = 0;  // the same of the picture that the panel rebuilt
  double thin_ms = 0, draw_ms = 0, scanout_ms = 0;
  double host_ms = 0;             // from the frame's request to its last pixel on the panel
  std::vector<float> layers;      // of each mesh that has layers, in their order; negative where not drawn from them,
                                  // or nothing was drawn
};

class Desk {
 public:
  /// Builds and boots the device. Throws Error kBadInput for drawing data that is not sound, kDevice for what does not
  /// fit or does not start. `rom_name` is for messages.
  Desk(const DeskConfig& config, std::span<const std::byte> rom, const std::string& rom_name);
  ~Desk();
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  std::uint32_t width() const;
  std::uint32_t height() const;
  /// Numbers of the meshes that have layers, in ROM or made at boot.
  std::vector<std::uint32_t> layered_meshes() const;
  const firmware::DrawingData& drawing_data() const;

  /// Lets the instrument take one step and the display controller send what it led to. `picture` is what the panel
  /// shows then, backlight or not; valid until the next call. Throws Error kDevice, for a fault of the device only
  /// where the configuration does not watch for it.
  struct Shown {
    FrameRecord record;
    const Image& picture;
  };
  Shown draw(const firmware::FrameRequest& request);

  const Machine& machine() const;
  const firmware::Device& device() const;
  /// What the instrument sends its display to draw with: other than the board's where VRAM is short.
  const firmware::VramLayout& vram() const { return device().vram(); }
  /// The picture as it stands in VRAM, for tests that compare the two ways to it.
  Image picture_in_vram() const;

  struct Memory {
    std::uint64_t ram_peak_bytes = 0, vram_bytes = 0, rom_bytes = 0;
  };
  Memory memory() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace usuzumi::sim
