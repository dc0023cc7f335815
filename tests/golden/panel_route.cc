#include "tests/golden/panel_route.h"

#include <algorithm>

#include "hal/drivers/display_driver.h"
#include "sim/machine/machine.h"
#include "sim/panel/panel.h"
#include "tests/support/scene_engines.h"

namespace usuzumi::golden {
namespace {

constexpr std::uint32_t kLeastMode = 16;  // pixels either way
constexpr std::uint32_t kLayer = 0;

LayerConfig layer_of(const scenes::TargetSpec& target, std::uint32_t stride_bytes) {
  LayerConfig layer;
  layer.format = target.format == command::PixelFormat::kRgb565 ? LayerFormat::kRgb565 : LayerFormat::kXrgb8888;
  layer.stride_bytes = stride_bytes;
  layer.bank_address[0] = layer.bank_address[1] = sim::kVramBase;
  layer.width = target.width;
  layer.height = target.height;
  return layer;
}

Status turn_on(DisplayDriver& display, const DisplayMode& mode, const LayerConfig& layer) {
  Status status = display.set_mode(mode);
  if (status.ok()) status = display.configure_layer(kLayer, layer);
  if (status.ok()) status = display.show_layer(kLayer, true);
  display.enable_picture_signature(true);
  return status.ok() ? display.enable() : status;
}

sim::Image upper_left(const sim::Image& picture, std::uint32_t width, std::uint32_t height) {
  sim::Image part(width, height);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) part.at(x, y) = picture.at(x, y);
  return part;
}

}  // namespace

PanelShot show_on_panel(const scenes::TargetSpec& target, const scenes::SceneDrawing& drawing) {
  scenes::SoftEngineKit idle_engine;
  sim::Panel panel;
  sim::Machine machine(sim::host_sim(), {}, idle_engine.engine(), panel);
  std::copy(drawing.colour_plane.begin(), drawing.colour_plane.end(), machine.vram().begin());

  const std::uint32_t width = std::max(target.width, kLeastMode), height = std::max(target.height, kLeastMode);
  const auto mode = make_display_mode(width, height);
  DisplayDriver display(machine, sim::kDisplayBase);
  PanelShot shot;
  shot.status = mode.status();
  const auto stride_bytes = static_cast<std::uint32_t>(drawing.colour_plane.size() / target.height);
  if (shot.status.ok()) shot.status = turn_on(display, *mode, layer_of(target, stride_bytes));
  if (!shot.status.ok()) return shot;
  constexpr int kFramesToWait = 3;  // the panel has the first picture by the second VSYNC
  for (int i = 0; i < kFramesToWait && panel.frames_completed() == 0; ++i) machine.idle(mode->frame_ticks());
  if (panel.frames_completed() == 0) {
    shot.status = {StatusCode::kDeadlineExceeded, "the panel got no stable picture", 0};
    return shot;
  }
  shot.picture = upper_left(panel.last_frame().picture, target.width, target.height);
  shot.panel_crc = panel.last_frame().crc32();
  shot.signature_crc = display.signature().picture_crc;
  shot.faults = display.faults().any();
  return shot;
}

}  // namespace usuzumi::golden
