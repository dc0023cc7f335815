// One DRM card's calls (drm_mode.h of the kernel), typed: what drm_display.h is written with.
//
// No libdrm: its calls of mode setting are these same ioctls, and below them a test can stand in for the kernel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <drm.h>
#include <drm_mode.h>

#include "hal/linux/kernel.h"

namespace usuzumi::linux_hal {

/// As many as a card's ids fit, none left out: a card with more of them is refused by none of us, but not seen whole.
struct DrmResources {
  static constexpr std::size_t kMost = 32;
  std::array<std::uint32_t, kMost> crtcs{}, connectors{};
  std::size_t crtc_count = 0, connector_count = 0;
};

struct DrmConnector {
  static constexpr std::size_t kMostEncoders = 32, kMostModes = 128;
  std::uint32_t id = 0;
  bool connected = false;
  std::uint32_t current_encoder = 0;  // 0: none
  std::array<std::uint32_t, kMostEncoders> encoders{};
  std::size_t encoder_count = 0;
  std::array<drm_mode_modeinfo, kMostModes> modes{};  // the preferred one first, by the kernel's custom
  std::size_t mode_count = 0;
};

struct DumbBuffer {
  std::uint32_t handle = 0;  // 0: none
  std::uint32_t stride_bytes = 0;
  std::uint64_t bytes = 0;
  std::uint32_t frame_buffer = 0;  // 0: none
};

/// Each call returns 0, or a negative errno.
class DrmDevice {
 public:
  explicit DrmDevice(Kernel& kernel) : kernel_(kernel) {}
  ~DrmDevice() { close(); }
  DrmDevice(const DrmDevice&) = delete;
  DrmDevice& operator=(const DrmDevice&) = delete;

  int open(const char* path);
  void close();
  bool is_open() const { return file_ >= 0; }

  int set_master();
  void drop_master();
  int read_resources(DrmResources& resources);
  int read_connector(std::uint32_t id, DrmConnector& connector);
  int read_encoder(std::uint32_t id, drm_mode_get_encoder& encoder);
  int read_crtc(std::uint32_t id, drm_mode_crtc& crtc);
  /// mode null: the CRTC is switched off.
  int set_crtc(std::uint32_t crtc, std::uint32_t frame_buffer, std::uint32_t connector, const drm_mode_modeinfo* mode);

  /// A buffer that the card can show, as a frame buffer of `fourcc`; nothing is left where any of it is refused.
  int create_buffer(std::uint32_t width, std::uint32_t height, std::uint32_t bits, std::uint32_t fourcc,
                    DumbBuffer& buffer);
  int map_buffer(const DumbBuffer& buffer, void* address, std::size_t bytes);
  void destroy_buffer(DumbBuffer& buffer);

  /// From the next vertical blank on; wait_for_flip() tells when it has come to pass. -EBUSY while the one before it
  /// is pending.
  int flip(std::uint32_t crtc, std::uint32_t frame_buffer);
  /// Until the last flip() that was taken is completed: events of earlier ones, given up and late, are passed over.
  /// -ETIMEDOUT when it was not completed within `timeout_ms`.
  int wait_for_flip(int timeout_ms);
  /// For displays that are sent what has changed, where no flip does it. ok where the card knows nothing of that.
  int flush(std::uint32_t frame_buffer, std::uint32_t width, std::uint32_t height);

 private:
  template <class T>
  int control(unsigned long request, T& argument) {
    return kernel_.control(file_, request, &argument);
  }

  Kernel& kernel_;
  int file_ = -1;
  std::uint64_t last_flip_ = 0;  // the number that the kernel gives back with the flip's event
};

}  // namespace usuzumi::linux_hal
