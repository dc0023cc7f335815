// The register page of hal/registers/display.h as a table, and what writing and reading sets off.
#include "gfx_subsystem/display/display_controller.h"

namespace usuzumi::gfx {

using namespace display_registers;

namespace {

constexpr std::uint32_t kWord = 0xFFFFFFFF, kAddress = 0xFFFFFFFC;
constexpr std::uint32_t kPosition = Position::kX.mask() | Position::kY.mask();
constexpr std::uint32_t kSize = Size::kWidth.mask() | Size::kHeight.mask();
constexpr std::uint32_t kCfgE =
    CfgE::kTiming.mask() | CfgE::kSignature.mask() | CfgE::kLayers.mask() | CfgE::kCursor.mask();

using Info = RegisterInfo<DisplayController>;
using FlipHook = void (DisplayController::*)(std::uint32_t written, std::uint32_t before);
constexpr std::size_t kLayerRegisters = 8, kHeadRegisters = 15, kTailRegisters = 9;

constexpr std::array<Info, kLayerRegisters> layer_registers(std::uint32_t n,
                                                            const char* const (&names)[kLayerRegisters],
                                                            FlipHook on_flip) {
  return {{
      {.name = names[0],
       .offset = layer_register(n, LayerMode::kOffset),
       .reset = LayerMode::kReset,
       .writable = LayerMode::kFmt.mask() | LayerMode::kKey.mask() | LayerMode::kPpa.mask() | LayerMode::kGa.mask()},
      {.name = names[1],
       .offset = layer_register(n, LayerStride::kOffset),
       .writable = LayerStride::kBytes.mask() & kAddress},
      {.name = names[2], .offset = layer_register(n, LayerBank0::kOffset), .writable = kAddress},
      {.name = names[3], .offset = layer_register(n, LayerBank1::kOffset), .writable = kAddress},
      {.name = names[4], .offset = layer_register(n, Position::kOffset), .writable = kPosition},
      {.name = names[5], .offset = layer_register(n, Size::kOffset), .writable = kSize},
      {.name = names[6], .offset = layer_register(n, LayerKey::kOffset), .writable = LayerKey::kRgb.mask()},
      {.name = names[7],
       .offset = layer_register(n, LayerFlip::kOffset),
       .writable = LayerFlip::kBank.mask(),
       .read_only = LayerFlip::kShown.mask() | LayerFlip::kPend.mask(),
       .on_write = on_flip},
  }};
}

}  // namespace

const DisplayController::Registers::Table DisplayController::kTable = [] {
  constexpr std::array<Info, kHeadRegisters> head{{
      {.name = "DID", .offset = Did::kOffset, .reset = Did::kReset, .read_only = kWord},
      {.name = "HTP", .offset = Htp::kOffset, .writable = Htp::kHtp.mask()},
      {.name = "HDP", .offset = Hdp::kOffset, .writable = Hdp::kHdp.mask(), .unimplemented = Hdp::kHdb.mask()},
      {.name = "HSP", .offset = Hsp::kOffset, .writable = Hsp::kHsp.mask() | Hsp::kHsw.mask() | Hsp::kVsw.mask()},
      {.name = "VTR", .offset = Vtr::kOffset, .writable = Vtr::kVtr.mask()},
      {.name = "VDP", .offset = Vdp::kOffset, .writable = Vdp::kVsp.mask() | Vdp::kVdp.mask()},
      {.name = "INTST", .offset = IntSt::kOffset, .write_1_to_clear = kIntAll},
      {.name = "INTEN", .offset = IntEn::kOffset, .writable = kIntAll},
      {.name = "FCNT", .offset = Fcnt::kOffset, .read_only = kWord},
      {.name = "DST",
       .offset = Dst::kOffset,
       .read_only = Dst::kRun.mask() | Dst::kVb.mask(),
       .on_read = &DisplayController::read_dst},
      {.name = "SCAN",
       .offset = Scan::kOffset,
       .read_only = Scan::kLine.mask(),
       .on_read = &DisplayController::read_scan},
      {.name = "BGC", .offset = Bgc::kOffset, .writable = Bgc::kRgb.mask()},
      {.name = "LOCK", .offset = Lock::kOffset, .writable = Lock::kLock.mask()},
      {.name = "CFGE", .offset = CfgE::kOffset, .write_1_to_clear = kCfgE},
      {.name = "DCM1",
       .offset = Dcm1::kOffset,
       .writable = Dcm1::kSc.mask() | Dcm1::kLayers.mask() | Dcm1::kCursor.mask() | Dcm1::kDen.mask(),
       .on_write = &DisplayController::on_dcm1},
  }};
  constexpr std::array<Info, kLayerRegisters> layers[kLayerCount] = {
      layer_registers(0, {"L0M", "L0ST", "L0DA0", "L0DA1", "L0P", "L0S", "L0K", "L0F"}, &DisplayController::on_flip<0>),
      layer_registers(1, {"L1M", "L1ST", "L1DA0", "L1DA1", "L1P", "L1S", "L1K", "L1F"}, &DisplayController::on_flip<1>),
      layer_registers(2, {"L2M", "L2ST", "L2DA0", "L2DA1", "L2P", "L2S", "L2K", "L2F"}, &DisplayController::on_flip<2>),
      layer_registers(3, {"L3M", "L3ST", "L3DA0", "L3DA1", "L3P", "L3S", "L3K", "L3F"},
                      &DisplayController::on_flip<3>)};
  constexpr std::array<Info, kTailRegisters> tail{{
      {.name = "CUA", .offset = Cua::kOffset, .writable = kAddress},
      {.name = "CUP", .offset = Cup::kOffset, .writable = kPosition},
      {.name = "SGC", .offset = Sgc::kOffset, .writable = Sgc::kPic.mask() | Sgc::kWin.mask() | Sgc::kChk.mask()},
      {.name = "SGP", .offset = Sgp::kOffset, .writable = Sgp::kX.mask() | Sgp::kY.mask()},
      {.name = "SGS", .offset = Sgs::kOffset, .writable = kSize},
      {.name = "SGR", .offset = Sgr::kOffset, .writable = kWord},
      {.name = "SGPIC", .offset = SgPic::kOffset, .read_only = kWord},
      {.name = "SGWIN", .offset = SgWin::kOffset, .read_only = kWord},
      {.name = "SGFR", .offset = SgFr::kOffset, .read_only = kWord},
  }};
  static_assert(kHeadRegisters + kLayerCount * kLayerRegisters + kTailRegisters == kRegisterCount);

  constexpr Registers::Table table = [&] {
    Registers::Table t{};
    std::size_t i = 0;
    for (const Info& r : head) t[i++] = r;
    for (const auto& layer : layers)
      for (const Info& r : layer) t[i++] = r;
    for (const Info& r : tail) t[i++] = r;
    return t;
  }();
  static_assert(is_well_formed(table));
  return table;
}();

void DisplayController::on_dcm1(std::uint32_t, std::uint32_t before) {
  const bool was_on = Dcm1::kDen.get(before) != 0, is_on = Dcm1::kDen.get(registers_.value(Dcm1::kOffset)) != 0;
  if (is_on && !was_on && !running_) start();
}

template <std::uint32_t kLayer>
void DisplayController::on_flip(std::uint32_t, std::uint32_t) {
  registers_.set_bits(layer_register(kLayer, LayerFlip::kOffset), LayerFlip::kPend.mask());
}

std::uint32_t DisplayController::read_dst(std::uint32_t) const {
  return Dst::kRun.put(running_ ? 1 : 0) | Dst::kVb.put(running_ && line_ >= geometry_.height ? 1 : 0);
}

std::uint32_t DisplayController::read_scan(std::uint32_t) const { return Scan::kLine.put(running_ ? line_ : 0); }

std::uint32_t DisplayController::pending() const {
  return registers_.value(IntSt::kOffset) & registers_.value(IntEn::kOffset);
}

void DisplayController::raise_configuration_error(std::uint32_t cfge_bits) {
  registers_.set_bits(CfgE::kOffset, cfge_bits);
  raise(kIntConfigurationError);
}

}  // namespace usuzumi::gfx
