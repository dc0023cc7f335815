// What both libraries share: finding the chip, and words for what goes wrong.
#include "hal/linux/gpio_lines.h"

#include <algorithm>
#include <cerrno>

namespace usuzumi::linux_hal {
namespace {

constexpr std::uint32_t kMostChips = 64;  // of /dev/gpiochip0, gpiochip1, …; an arbitrary end of the search

}  // namespace

Status GpioLines::open(const char* chip, std::span<const GpioLine> inputs, std::span<const GpioLine> outputs) {
  close();
  if (inputs.size() > kMostLines || outputs.size() > kMostLines)
    return {StatusCode::kInvalidArgument, "GPIO: more lines than this build takes", kMostLines};
  std::copy(inputs.begin(), inputs.end(), inputs_.begin());
  std::copy(outputs.begin(), outputs.end(), outputs_.begin());
  input_count_ = inputs.size();
  output_count_ = outputs.size();
  Status status = open_chip(chip);
  if (!status.ok()) return status;
  chip_text_ = chip;
  chip_open_ = true;
  status = take_lines();
  if (!status.ok()) close();
  return status;
}

Status GpioLines::open_chip(const char* chip) {
  if (chip[0] == '/') return open_path(chip) ? ok_status() : chip_failed(chip, errno);
  int refused = 0;
  std::uint32_t seen = 0;
  for (std::uint32_t n = 0; n < kMostChips; ++n) {  // numbers may have gaps where a driver was unloaded
    StatusText path;
    path.text("/dev/gpiochip").number(n);
    if (!open_path(path.c_str())) {
      if (errno != ENOENT && refused == 0) refused = errno;
      continue;
    }
    ++seen;
    if (chip_is_called(chip)) return ok_status();
    close_chip();
  }
  if (refused != 0) return chip_failed(chip, refused);  // it may be one of those that may not be looked at
  text_.clear();
  return text_.text("GPIO chip ").text(chip).text(": not there; gpiodetect lists labels and names; chips seen")
      .status(StatusCode::kUnavailable, seen);
}

Status GpioLines::chip_failed(const char* chip, int error) {
  text_.clear();
  text_.text("GPIO chip ").text(chip);
  switch (error) {
    case EACCES:
    case EPERM: text_.text(": no permission; run as a member of the group that owns /dev/gpiochip* (gpio)"); break;
    case ENOENT: text_.text(": not there; gpiodetect lists what there is"); break;
    case ENOTTY:
    case ENODEV: text_.text(": no GPIO chip; gpiodetect lists what there is"); break;
    default: text_.text(": cannot be opened"); break;
  }
  return text_.errno_status(-error);
}

Status GpioLines::line_failed(unsigned offset, int error) {
  text_.clear();
  text_.text("GPIO chip ").text(chip_text_).text(" line ").number(offset);
  switch (error) {
    case EBUSY: text_.text(": in use; gpioinfo says by whom, stop that one first"); break;
    case EINVAL: text_.text(": the chip has no such line; gpioinfo lists them"); break;
    case EACCES:
    case EPERM: text_.text(": no permission; run as a member of group gpio"); break;
    case ENXIO:
    case EOPNOTSUPP: text_.text(": cannot report edges; take a line with an interrupt"); break;
    default: text_.text(": cannot be taken"); break;
  }
  return text_.errno_status(-error);
}

Status GpioLines::access_failed(const char* what, unsigned offset, int error) {
  text_.clear();
  text_.text("GPIO chip ").text(chip_text_).text(" line ").number(offset).text(": ").text(what);
  return text_.text("; look for the chip's words in dmesg").errno_status(-error);
}

}  // namespace usuzumi::linux_hal
