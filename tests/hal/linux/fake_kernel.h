// A kernel with one DRM card, whose buffers are real memory and whose every refusal a test can ask for.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <drm.h>
#include <drm_mode.h>

#include "hal/linux/kernel.h"

namespace usuzumi::linux_hal::testing {

struct FakeConnector {
  bool connected = true;
  std::vector<drm_mode_modeinfo> modes;
};

struct FakeCard {
  static constexpr std::uint32_t kCrtc = 11, kEncoder = 21, kConsoleBuffer = 5;
  static constexpr std::uint32_t kFirstConnector = 31;  // the others' ids follow

  std::string path = "/dev/dri/card0";
  std::vector<FakeConnector> connectors;   // one in the beginning
  std::set<std::uint32_t> formats;         // fourcc codes that AddFB2 takes
  std::uint32_t stride_unit_bytes = 256;
  bool flips_arrive = true;                // vertical blanks come when they are waited for
  std::map<unsigned long, int> refusals;   // by ioctl: the errno; 0 in `path`'s place is open()
  int open_error = 0;                      // errno

  std::uint32_t shown_frame_buffer = kConsoleBuffer;  // 0: the CRTC is off
  std::uint32_t driven_connector = kFirstConnector;
  std::function<void(std::uint32_t)> on_flip;  // called with the number of flips asked for so far
  std::uint32_t flips = 0, crtc_settings = 0, flushes = 0;
};

class FakeKernel final : public Kernel {
 public:
  FakeKernel();
  ~FakeKernel();

  FakeCard card;

  /// Pixels that the panel is sent: row by row without padding, `bytes_per_pixel` each. Empty where nothing of ours is
  /// shown.
  std::vector<std::uint8_t> panel(std::uint32_t bytes_per_pixel) const;
  std::size_t open_files() const { return files_.size(); }
  std::size_t buffers() const { return buffers_.size(); }
  std::size_t frame_buffers() const { return frames_.size(); }
  std::size_t mappings() const { return mappings_.size(); }
  bool has_master() const { return master_; }
  /// The pending flip comes to pass, and its event waits to be read.
  void vertical_blank();
  /// Everything that was taken has been given back, and the console's picture is shown again.
  bool as_before() const {
    return open_files() + buffers() + frame_buffers() + mappings() == 0 && !master_ &&
           card.shown_frame_buffer == FakeCard::kConsoleBuffer;
  }

 private:
  struct Buffer {
    int memory = -1;  // a memfd
    std::uint32_t width = 0, height = 0, stride_bytes = 0;
    std::uint64_t bytes = 0;
  };

  int do_open(const char* path) override;
  int do_close(int file) override;
  int do_control(int file, unsigned long request, void* argument) override;
  int do_map_at(void* address, std::size_t bytes, int file, std::uint64_t offset) override;
  int do_wait_readable(int file, int timeout_ms) override;
  std::ptrdiff_t do_read(int file, void* into, std::size_t bytes) override;

  int get_resources(drm_mode_card_res& request) const;
  int get_connector(drm_mode_get_connector& request) const;
  int create_dumb(drm_mode_create_dumb& request);
  int add_frame_buffer(drm_mode_fb_cmd2& request);
  int set_crtc(const drm_mode_crtc& request);
  int page_flip(const drm_mode_crtc_page_flip& request);

  std::set<int> files_;
  std::map<std::uint32_t, Buffer> buffers_;             // by handle
  std::map<std::uint32_t, std::uint32_t> frames_;       // frame buffer -> handle
  std::map<void*, std::uint32_t> mappings_;             // address -> handle
  std::uint32_t next_id_ = 100;
  std::uint32_t pending_flip_ = 0;  // frame buffer
  std::uint64_t pending_number_ = 0;
  std::deque<std::vector<drm_event_vblank>> events_;  // what each read hands out
  bool master_ = false;
};

/// A mode of that size, progressive, 60 Hz.
drm_mode_modeinfo mode_of(std::uint16_t width, std::uint16_t height);

}  // namespace usuzumi::linux_hal::testing
