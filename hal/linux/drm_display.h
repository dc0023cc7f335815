// A display behind Linux's kernel mode setting (DRM/KMS): two dumb buffers, shown in turn by page flips.
//
// The buffers are the card's own memory, mapped into VRAM at the places of the two pictures, so that the engine draws
// straight into what the panel is sent. Consoles and virtual terminals are left alone: opening the card makes this
// program its master where nobody else is, and the CRTC's old picture comes back at the end.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/display.h"
#include "hal/linux/drm_device.h"
#include "hal/linux/kernel.h"
#include "hal/linux/status_text.h"
#include "hal/memory_regions.h"

namespace usuzumi::linux_hal {

struct DrmConfig {
  const char* card = nullptr;  // null: the first of /dev/dri/card0 to card15 that has a connected display
  std::uint32_t width = 0, height = 0;  // pixels; the first connected display of the card that has them is taken
  /// Where the scanout's pictures lie. Whole pages, and fresh private memory: pieces of it are replaced and given back.
  MemoryRegion vram;
  int flip_timeout_ms = 1000;
};

class DrmDisplay final : public Display {
 public:
  explicit DrmDisplay(Kernel& kernel) : kernel_(kernel), device_(kernel) {}
  ~DrmDisplay() { release(); }
  DrmDisplay(const DrmDisplay&) = delete;
  DrmDisplay& operator=(const DrmDisplay&) = delete;

  /// Opens the card and picks the connector's mode of that size; nothing is changed on the panel. kUnavailable: no
  /// card, no display, another program's, or without rights. kInvalidArgument: the display has no such size; the text
  /// lists what it has. Where it fails nothing stays open.
  Status open(const DrmConfig& config);
  /// Puts the CRTC back as it was found, gives back all memory and closes the card. VRAM is plain memory again.
  void release();

  /// For a line at start: the card's path.
  const char* card() const { return path_; }

 private:
  std::uint32_t do_stride_bytes(std::uint32_t width, std::uint32_t height, command::PixelFormat format) override;
  Status do_start(const Scanout& scanout) override;
  Status do_show(std::uint32_t picture, const PictureRectangle* part) override;

  Status open_card(const char* path);
  Status pick_mode();
  /// Null where connector_ has no such size.
  const drm_mode_modeinfo* mode_of_size() const;
  Status refuse_size(const DrmResources& resources);
  bool pick_crtc(const DrmResources& resources);
  /// Why do_stride_bytes() knew of no such picture.
  Status refuse_pictures(const Scanout& scanout);
  int make_pictures(const Scanout& scanout);
  void release_crtc();
  void destroy_pictures();
  Status failed(const char* what, int result);

  Kernel& kernel_;
  DrmDevice device_;
  DrmConfig config_;
  char path_[64] = "";
  bool card_exists_ = false;  // whether there is a file at path_
  DrmConnector connector_;
  std::uint32_t crtc_ = 0;
  drm_mode_modeinfo mode_{};
  drm_mode_crtc found_{};  // the CRTC before us
  bool started_ = false;   // found_ is to be put back
  Scanout scanout_;
  DumbBuffer pictures_[2];
  DumbBuffer black_;  // what is shown before the first picture
  std::size_t mapped_bytes_ = 0;  // of VRAM at each picture
  StatusText text_;
  StatusText refused_[2];  // RGB565, XRGB8888: the firmware tries one after the other, and tells the first answer
};

}  // namespace usuzumi::linux_hal
