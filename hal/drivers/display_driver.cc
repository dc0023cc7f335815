#include "hal/drivers/display_driver.h"

namespace usuzumi {

using namespace display_registers;

namespace {

constexpr std::int32_t kMinPosition = -4096, kMaxPosition = 4095;
constexpr std::uint32_t kMaxStrideBytes = 65532;

constexpr Status invalid(const char* message, std::uint32_t where = 0) {
  return {StatusCode::kInvalidArgument, message, where};
}

constexpr bool is_position(std::int32_t x) { return x >= kMinPosition && x <= kMaxPosition; }
constexpr bool is_size(std::uint32_t size) { return size >= 1 && size <= kMaxSize; }

constexpr std::uint32_t position_word(std::int32_t x, std::int32_t y) {
  return Position::kX.put_signed(x) | Position::kY.put_signed(y);
}
constexpr std::uint32_t size_word(std::uint32_t width, std::uint32_t height) {
  return Size::kWidth.put(width - 1) | Size::kHeight.put(height - 1);
}

Status check_layer(std::uint32_t layer, const LayerConfig& c) {
  if (layer >= kLayerCount) return invalid("layers are 0 to 3", layer);
  if (c.format != LayerFormat::kRgb565 && c.format != LayerFormat::kXrgb8888 && c.format != LayerFormat::kArgb8888)
    return invalid("layer format must be RGB565, XRGB8888 or ARGB8888", layer);
  if (c.per_pixel_alpha && c.format != LayerFormat::kArgb8888)
    return invalid("per-pixel alpha needs format ARGB8888", layer);
  if (!is_size(c.width) || !is_size(c.height)) return invalid("layer size must be 1 to 4096 each way", layer);
  if (!is_position(c.x) || !is_position(c.y)) return invalid("layer position must be -4096 to 4095 each way", layer);
  if (c.stride_bytes % 4 != 0 || c.stride_bytes > kMaxStrideBytes)
    return invalid("layer stride must be a multiple of 4, at most 65532 bytes", layer);
  if (c.stride_bytes < c.width * bytes_per_pixel(c.format)) return invalid("layer stride is shorter than a row", layer);
  if (c.bank_address[0] % 4 != 0 || c.bank_address[1] % 4 != 0)
    return invalid("layer addresses must be multiples of 4", layer);
  if (c.bank > 1) return invalid("layer banks are 0 and 1", layer);
  if (c.colour_key_rgb > LayerKey::kRgb.max()) return invalid("colour key must be 0x00RRGGBB", layer);
  return ok_status();
}

}  // namespace

/// Keeps a vertical blank from latching half of a change.
class DisplayDriver::Locked {
 public:
  explicit Locked(DisplayDriver& driver) : driver_(driver) { driver_.write(Lock::kOffset, 1); }
  ~Locked() { driver_.write(Lock::kOffset, 0); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  DisplayDriver& driver_;
};

void DisplayDriver::set_bits(std::uint32_t offset, std::uint32_t mask, bool on) {
  const std::uint32_t word = read(offset);
  write(offset, on ? word | mask : word & ~mask);
}

Status DisplayDriver::probe() {
  if (read(Did::kOffset) == Did::kReset) return ok_status();
  return {StatusCode::kUnavailable, "no display controller answers; check its base address in the memory map", base_};
}

// ---------------------------------------------------------------------------------------------------- mode, on and off

Status DisplayDriver::set_mode(const DisplayMode& mode) {
  if (mode.width == 0 || mode.height == 0) return invalid("display size must not be 0");
  const Timing t = timing_of(mode);
  if (const char* fault = timing_fault(t)) return invalid(fault);
  const Locked lock(*this);
  write(Htp::kOffset, Htp::kHtp.put(t.htp));
  write(Hdp::kOffset, Hdp::kHdp.put(t.hdp));
  write(Hsp::kOffset, Hsp::kHsp.put(t.hsp) | Hsp::kHsw.put(t.hsw) | Hsp::kVsw.put(t.vsw));
  write(Vtr::kOffset, Vtr::kVtr.put(t.vtr));
  write(Vdp::kOffset, Vdp::kVdp.put(t.vdp) | Vdp::kVsp.put(t.vsp));
  write(Dcm1::kOffset, Dcm1::kSc.replace(read(Dcm1::kOffset), t.sc));
  return ok_status();
}

Status DisplayDriver::enable() {
  set_bits(Dcm1::kOffset, Dcm1::kDen.mask(), true);
  if (running()) return ok_status();
  set_bits(Dcm1::kOffset, Dcm1::kDen.mask(), false);
  return {StatusCode::kFailedPrecondition, "the display did not start; set a mode first"};
}

void DisplayDriver::disable() { set_bits(Dcm1::kOffset, Dcm1::kDen.mask(), false); }
bool DisplayDriver::running() { return Dst::kRun.get(read(Dst::kOffset)) != 0; }

// -------------------------------------------------------------------------------------------------------------- layers

Status DisplayDriver::configure_layer(std::uint32_t layer, const LayerConfig& c) {
  if (const Status status = check_layer(layer, c); !status.ok()) return status;
  const auto reg = [layer](std::uint32_t offset) { return layer_register(layer, offset); };
  const Locked lock(*this);
  write(reg(LayerMode::kOffset),
        LayerMode::kFmt.put(static_cast<std::uint32_t>(c.format)) | LayerMode::kKey.put(c.colour_key_enabled ? 1 : 0) |
            LayerMode::kPpa.put(c.per_pixel_alpha ? 1 : 0) | LayerMode::kGa.put(c.global_alpha));
  write(reg(LayerStride::kOffset), c.stride_bytes);
  write(reg(LayerBank0::kOffset), c.bank_address[0]);
  write(reg(LayerBank1::kOffset), c.bank_address[1]);
  write(reg(Position::kOffset), position_word(c.x, c.y));
  write(reg(Size::kOffset), size_word(c.width, c.height));
  write(reg(LayerKey::kOffset), c.colour_key_rgb);
  write(reg(LayerFlip::kOffset), c.bank);
  return ok_status();
}

Status DisplayDriver::show_layer(std::uint32_t layer, bool shown) {
  if (layer >= kLayerCount) return invalid("layers are 0 to 3", layer);
  set_bits(Dcm1::kOffset, Dcm1::kLayers.put(1u << layer), shown);
  return ok_status();
}

void DisplayDriver::set_background(std::uint32_t rgb) { write(Bgc::kOffset, Bgc::kRgb.put(rgb)); }

Status DisplayDriver::request_flip(std::uint32_t layer, std::uint32_t bank) {
  if (layer >= kLayerCount) return invalid("layers are 0 to 3", layer);
  if (bank > 1) return invalid("layer banks are 0 and 1", layer);
  write(layer_register(layer, LayerFlip::kOffset), bank);
  return ok_status();
}

Status DisplayDriver::request_flip(std::uint32_t layer, std::uint32_t bank, BusAddress address) {
  if (layer >= kLayerCount) return invalid("layers are 0 to 3", layer);
  if (bank > 1) return invalid("layer banks are 0 and 1", layer);
  if (address % 4 != 0) return invalid("layer addresses must be multiples of 4", layer);
  const Locked lock(*this);
  write(layer_register(layer, bank == 0 ? LayerBank0::kOffset : LayerBank1::kOffset), address);
  write(layer_register(layer, LayerFlip::kOffset), bank);
  return ok_status();
}

bool DisplayDriver::flip_pending(std::uint32_t layer) {
  return layer < kLayerCount && LayerFlip::kPend.get(read(layer_register(layer, LayerFlip::kOffset))) != 0;
}

std::uint32_t DisplayDriver::shown_bank(std::uint32_t layer) {
  return layer < kLayerCount ? LayerFlip::kShown.get(read(layer_register(layer, LayerFlip::kOffset))) : 0;
}

// -------------------------------------------------------------------------------------------------------------- cursor

Status DisplayDriver::set_cursor_image(BusAddress address) {
  if (address % 4 != 0) return invalid("the cursor image must lie at a multiple of 4");
  write(Cua::kOffset, address);
  return ok_status();
}

Status DisplayDriver::move_cursor(std::int32_t x, std::int32_t y) {
  if (!is_position(x) || !is_position(y)) return invalid("cursor position must be -4096 to 4095 each way");
  write(Cup::kOffset, position_word(x, y));
  return ok_status();
}

void DisplayDriver::show_cursor(bool shown) { set_bits(Dcm1::kOffset, Dcm1::kCursor.mask(), shown); }

// ----------------------------------------------------------------------------------------------- interrupts and faults

void DisplayDriver::enable_vertical_blank_interrupt(bool enabled) {
  set_bits(IntEn::kOffset, kIntVerticalBlank, enabled);
}
void DisplayDriver::enable_fault_interrupts(bool enabled) {
  set_bits(IntEn::kOffset, kIntAll & ~kIntVerticalBlank, enabled);
}
bool DisplayDriver::vertical_blank_seen() { return (read(IntSt::kOffset) & kIntVerticalBlank) != 0; }
void DisplayDriver::clear_vertical_blank() { write(IntSt::kOffset, kIntVerticalBlank); }

DisplayFaults DisplayDriver::faults() {
  const std::uint32_t status = read(IntSt::kOffset);
  return {.fifo_underflow = (status & kIntFifoUnderflow) != 0,
          .signature_mismatch = (status & kIntSignatureMismatch) != 0,
          .configuration_error = (status & kIntConfigurationError) != 0,
          .configuration_detail = read(CfgE::kOffset)};
}

void DisplayDriver::clear_faults() {
  write(CfgE::kOffset, CfgE::kTiming.mask() | CfgE::kSignature.mask() | CfgE::kLayers.mask() | CfgE::kCursor.mask());
  write(IntSt::kOffset, kIntAll & ~kIntVerticalBlank);
}

// ----------------------------------------------------------------------------------------------------------- signature

void DisplayDriver::enable_picture_signature(bool enabled) { set_bits(Sgc::kOffset, Sgc::kPic.mask(), enabled); }

Status DisplayDriver::check_window(const PictureRectangle& window, std::uint32_t reference) {
  return set_window(window, reference, true);
}
Status DisplayDriver::measure_window(const PictureRectangle& window) { return set_window(window, 0, false); }

Status DisplayDriver::set_window(const PictureRectangle& w, std::uint32_t reference, bool check) {
  if (!is_size(w.width) || !is_size(w.height) || w.x >= kMaxSize || w.y >= kMaxSize)
    return invalid("signature window must be 1 to 4096 pixels each way");
  const std::uint32_t width = Hdp::kHdp.get(read(Hdp::kOffset)) + 1, height = Vdp::kVdp.get(read(Vdp::kOffset)) + 1;
  if (w.x + w.width > width || w.y + w.height > height)
    return {StatusCode::kFailedPrecondition, "signature window reaches beyond the picture of the mode set"};
  const Locked lock(*this);
  write(Sgp::kOffset, Sgp::kX.put(w.x) | Sgp::kY.put(w.y));
  write(Sgs::kOffset, size_word(w.width, w.height));
  write(Sgr::kOffset, reference);
  set_bits(Sgc::kOffset, Sgc::kWin.mask(), true);
  set_bits(Sgc::kOffset, Sgc::kChk.mask(), check);
  return ok_status();
}

void DisplayDriver::stop_window() { set_bits(Sgc::kOffset, Sgc::kWin.mask() | Sgc::kChk.mask(), false); }

DisplaySignature DisplayDriver::signature() {
  return {.picture_crc = read(SgPic::kOffset), .window_crc = read(SgWin::kOffset), .frame = read(SgFr::kOffset)};
}

std::uint32_t DisplayDriver::frame_count() { return read(Fcnt::kOffset); }
std::uint32_t DisplayDriver::scan_line() { return Scan::kLine.get(read(Scan::kOffset)); }

}  // namespace usuzumi
