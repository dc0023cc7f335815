#include "boards/linux-arm64/options.h"

#include <charconv>
#include <cstdio>
#include <cstring>
#include <getopt.h>
#include <string_view>

namespace usuzumi::linux_arm64 {

const char kUsage[] =
    "usuzumi-device --rom FILE [OPTION...]: draws the instrument on a DRM display, with its pins on a GPIO chip\n"
    "  --rom FILE         drawing data, as `usuzumi pack` writes them\n"
    "  --size WxH         a size that the display has (800x480)\n"
    "  --card PATH        DRM card (the first of /dev/dri/card* with a connected display)\n"
    "  --rgb565           16 bits a pixel, where the card takes them (32)\n"
    "  --gpio-chip CHIP   label, name or path (gpiochip0); gpiodetect lists them\n"
    "  --ignition LINE    its line on the chip (4); an ending 'n' makes a line active-low: 4n\n"
    "  --mode LINE        the mode button's (5)\n"
    "  --backlight LINE   the backlight's, an output (6)\n"
    "  --frames N         ends after N frames (0: runs until SIGTERM)\n"
    "  --orbit            the model turns once over --frames\n"
    "  --pause            after each frame waits for a byte on standard input: for tests that look at the panel\n"
    "Exit codes: 0 done; 2 bad usage; 3 bad drawing data; 5 display, GPIO or memory not to be had.\n";

namespace {

/// All of `text`; false where it is no such number.
bool whole_number(std::string_view text, std::uint32_t most, std::uint32_t& number) {
  std::uint32_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc{} || end != text.data() + text.size() || n > most) return false;
  number = n;
  return true;
}

bool size(std::string_view text, Options& options) {
  constexpr std::uint32_t kMost = 4096;  // as the engine draws
  const std::size_t x = text.find('x');
  return x != std::string_view::npos && whole_number(text.substr(0, x), kMost, options.width) &&
         whole_number(text.substr(x + 1), kMost, options.height) && options.width > 0 && options.height > 0;
}

bool line(std::string_view text, linux_hal::GpioLine& line) {
  constexpr std::uint32_t kMost = 1023;  // more than any chip has
  const bool active_low = text.ends_with('n');
  if (active_low) text.remove_suffix(1);
  std::uint32_t offset = 0;
  if (!whole_number(text, kMost, offset)) return false;
  line = {offset, active_low};
  return true;
}

bool wrong(const char* option, const char* value, const char* right) {
  std::fprintf(stderr, "error: --%s %s: give %s\n", option, value, right);
  return false;
}

bool consistent(const Options& options) {
  const unsigned ignition = options.pins.ignition.offset, mode = options.pins.mode_button.offset,
                 backlight = options.pins.backlight.offset;
  if (ignition == mode || ignition == backlight || mode == backlight) {
    std::fprintf(stderr, "error: --ignition, --mode and --backlight: give three different lines, not %u, %u and %u\n",
                 ignition, mode, backlight);
    return false;
  }
  if (options.rom == nullptr) std::fprintf(stderr, "error: --rom FILE is missing: give the drawing data to show\n");
  return options.rom != nullptr;
}

}  // namespace

bool parse_options(int count, char** arguments, Options& options) {
  enum : int { kRom = 1, kSize, kCard, kRgb565, kChip, kIgnition, kMode, kBacklight, kFrames, kOrbit, kPause, kHelp };
  static const option kOptions[] = {{"rom", required_argument, nullptr, kRom},
                                    {"size", required_argument, nullptr, kSize},
                                    {"card", required_argument, nullptr, kCard},
                                    {"rgb565", no_argument, nullptr, kRgb565},
                                    {"gpio-chip", required_argument, nullptr, kChip},
                                    {"ignition", required_argument, nullptr, kIgnition},
                                    {"mode", required_argument, nullptr, kMode},
                                    {"backlight", required_argument, nullptr, kBacklight},
                                    {"frames", required_argument, nullptr, kFrames},
                                    {"orbit", no_argument, nullptr, kOrbit},
                                    {"pause", no_argument, nullptr, kPause},
                                    {"help", no_argument, nullptr, kHelp},
                                    {nullptr, 0, nullptr, 0}};
  constexpr char kLine[] = "a line's number, with n where it is active-low: 4 or 4n";
  optind = 0;  // glibc: begin anew
  opterr = 0;  // words of our own
  for (;;) {
    const int current = optind > 0 ? optind : 1;
    switch (getopt_long(count, arguments, ":", kOptions, nullptr)) {
      case -1:
        if (options.help) return true;
        if (optind < count) {
          std::fprintf(stderr, "error: %s: no option; --help lists them\n", arguments[optind]);
          return false;
        }
        return consistent(options);
      case kRom: options.rom = optarg; break;
      case kSize:
        if (!size(optarg, options)) return wrong("size", optarg, "width and height in pixels, 1 to 4096: 800x480");
        break;
      case kCard: options.card = optarg; break;
      case kRgb565: options.rgb565 = true; break;
      case kChip: options.pins.chip = optarg; break;
      case kIgnition:
        if (!line(optarg, options.pins.ignition)) return wrong("ignition", optarg, kLine);
        break;
      case kMode:
        if (!line(optarg, options.pins.mode_button)) return wrong("mode", optarg, kLine);
        break;
      case kBacklight:
        if (!line(optarg, options.pins.backlight)) return wrong("backlight", optarg, kLine);
        break;
      case kFrames:
        if (!whole_number(optarg, UINT32_MAX, options.frames)) return wrong("frames", optarg, "a whole number");
        break;
      case kOrbit: options.orbit = true; break;
      case kPause: options.pause = true; break;
      case kHelp: options.help = true; break;
      case ':':
        std::fprintf(stderr, "error: %s: its value is missing; --help shows it\n", arguments[current]);
        return false;
      default:
        std::fprintf(stderr, "error: %s: no such option; --help lists them\n", arguments[current]);
        return false;
    }
  }
}

}  // namespace usuzumi::linux_arm64
