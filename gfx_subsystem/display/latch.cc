// Takes the shadowed registers over into what rules the next frame. What cannot be obeyed is left out and reported in
// CFGE.
#include "gfx_subsystem/display/display_controller.h"

namespace usuzumi::gfx {

using namespace display_registers;

bool DisplayController::latch() {
  const bool legal_timing = latch_timing();
  if (!legal_timing) raise_configuration_error(CfgE::kTiming.mask());
  frame_.background_rgb = registers_.value(Bgc::kOffset);
  const std::uint32_t dcm1 = registers_.value(Dcm1::kOffset);
  for (std::uint32_t n = 0; n < kLayerCount; ++n) latch_layer(n, Dcm1::kLayers.get(dcm1));
  latch_cursor(Dcm1::kCursor.get(dcm1) != 0);
  latch_signature();
  return legal_timing;
}

bool DisplayController::latch_timing() {
  const auto field = [this](std::uint32_t offset, RegisterField f) { return f.get(registers_.value(offset)); };
  const Timing t{.htp = field(Htp::kOffset, Htp::kHtp),
                 .hdp = field(Hdp::kOffset, Hdp::kHdp),
                 .hsp = field(Hsp::kOffset, Hsp::kHsp),
                 .hsw = field(Hsp::kOffset, Hsp::kHsw),
                 .vtr = field(Vtr::kOffset, Vtr::kVtr),
                 .vdp = field(Vdp::kOffset, Vdp::kVdp),
                 .vsp = field(Vdp::kOffset, Vdp::kVsp),
                 .vsw = field(Hsp::kOffset, Hsp::kVsw),
                 .sc = field(Dcm1::kOffset, Dcm1::kSc)};
  if (timing_fault(t) != nullptr) return false;
  next_geometry_ = scan_geometry(t);
  return true;
}

void DisplayController::latch_layer(std::uint32_t layer, std::uint32_t enabled_layers) {
  const auto value = [&](std::uint32_t offset) { return registers_.value(layer_register(layer, offset)); };
  const std::uint32_t bank = LayerFlip::kBank.get(value(LayerFlip::kOffset));
  registers_.set_value(layer_register(layer, LayerFlip::kOffset),
                       LayerFlip::kBank.put(bank) | LayerFlip::kShown.put(bank));

  LayerConfig& c = frame_.layers[layer];
  const std::uint32_t mode = value(LayerMode::kOffset), position = value(Position::kOffset),
                      size = value(Size::kOffset);
  c.shown = (enabled_layers >> layer & 1) != 0;
  c.address = value(bank == 0 ? LayerBank0::kOffset : LayerBank1::kOffset);
  c.stride_bytes = value(LayerStride::kOffset);
  c.x = Position::kX.get_signed(position);
  c.y = Position::kY.get_signed(position);
  c.width = Size::kWidth.get(size) + 1;
  c.height = Size::kHeight.get(size) + 1;
  c.error_bit = CfgE::kLayers.put(1u << layer);
  c.look.format = static_cast<LayerFormat>(LayerMode::kFmt.get(mode));
  c.look.per_pixel_alpha = LayerMode::kPpa.get(mode) != 0;
  c.look.key_enabled = LayerMode::kKey.get(mode) != 0;
  c.look.key_rgb = value(LayerKey::kOffset);
  c.look.global_alpha = LayerMode::kGa.get(mode);

  const bool known_format = c.look.format == LayerFormat::kRgb565 || c.look.format == LayerFormat::kXrgb8888 ||
                            c.look.format == LayerFormat::kArgb8888;
  if (c.shown && (!known_format || c.stride_bytes < c.width * bytes_per_pixel(c.look.format))) {
    c.shown = false;
    raise_configuration_error(c.error_bit);
  }
}

void DisplayController::latch_cursor(bool enabled) {
  const std::uint32_t position = registers_.value(Cup::kOffset);
  LayerConfig& c = frame_.layers[FrameConfig::kCursor];
  c.shown = enabled;
  c.address = registers_.value(Cua::kOffset);
  c.stride_bytes = kCursorStrideBytes;
  c.x = Position::kX.get_signed(position);
  c.y = Position::kY.get_signed(position);
  c.width = c.height = kCursorSize;
  c.error_bit = CfgE::kCursor.mask();
  c.look.format = LayerFormat::kArgb8888;
  c.look.per_pixel_alpha = true;
}

void DisplayController::latch_signature() {
  const std::uint32_t control = registers_.value(Sgc::kOffset), place = registers_.value(Sgp::kOffset),
                      size = registers_.value(Sgs::kOffset);
  frame_.picture_signature = Sgc::kPic.get(control) != 0;
  frame_.window_signature = Sgc::kWin.get(control) != 0;
  frame_.check_window = Sgc::kChk.get(control) != 0;
  frame_.window = {Sgp::kX.get(place), Sgp::kY.get(place), Size::kWidth.get(size) + 1, Size::kHeight.get(size) + 1};
  frame_.reference_crc = registers_.value(Sgr::kOffset);
  const Window& w = frame_.window;
  if (frame_.window_signature &&
      (w.x + w.width > next_geometry_.width || w.y + w.height > next_geometry_.height)) {
    frame_.window_signature = false;
    raise_configuration_error(CfgE::kSignature.mask());
  }
}

}  // namespace usuzumi::gfx
