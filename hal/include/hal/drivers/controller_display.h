// The device's own display controller as a Display: one layer, its two banks the two pictures.
#pragma once

#include "hal/clock.h"
#include "hal/display.h"
#include "hal/drivers/display_driver.h"

namespace usuzumi {

class ControllerDisplay final : public Display {
 public:
  ControllerDisplay(RegisterIo& io, BusAddress base, InterruptWaiter& interrupts)
      : driver_(io, base), interrupts_(interrupts) {}

  /// For what a Display has no word for: signatures, cursor, frame count.
  DisplayDriver& driver() { return driver_; }

 private:
  Status do_start(const Scanout& scanout) override;
  Status do_show(std::uint32_t picture, const PictureRectangle* part) override;
  Status do_check() override;

  /// `part` of the pictures where it stands in them.
  Status configure_layer(const PictureRectangle& part, std::uint32_t picture);
  /// Until what was written before has been latched.
  Status wait_for_vertical_blank();

  DisplayDriver driver_;
  InterruptWaiter& interrupts_;
  Scanout scanout_;
  bool partial_ = false;  // the layer is a part of a picture
};

}  // namespace usuzumi
