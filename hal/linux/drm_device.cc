#include "hal/linux/drm_device.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>

#include "hal/linux/monotonic_clock.h"

namespace usuzumi::linux_hal {
namespace {

/// The kernel's structures carry user pointers in 64 bits.
std::uint64_t address_of(const void* p) { return reinterpret_cast<std::uintptr_t>(p); }

/// Whether flip `number` is among events that come whole, one after the other, each with its length.
bool tells_flip(std::span<const std::byte> events, std::uint64_t number) {
  while (events.size() >= sizeof(drm_event)) {
    drm_event event;
    std::memcpy(&event, events.data(), sizeof event);
    if (event.length < sizeof event || event.length > events.size()) return false;
    if (event.type == DRM_EVENT_FLIP_COMPLETE && event.length >= sizeof(drm_event_vblank)) {
      drm_event_vblank flip;
      std::memcpy(&flip, events.data(), sizeof flip);
      if (flip.user_data == number) return true;
    }
    events = events.subspan(event.length);
  }
  return false;
}

}  // namespace

int DrmDevice::open(const char* path) {
  close();
  const int result = kernel_.open(path);
  if (result < 0) return result;
  file_ = result;
  return 0;
}

void DrmDevice::close() {
  if (file_ >= 0) kernel_.close(file_);
  file_ = -1;
}

int DrmDevice::set_master() { return kernel_.control(file_, DRM_IOCTL_SET_MASTER, nullptr); }
void DrmDevice::drop_master() { kernel_.control(file_, DRM_IOCTL_DROP_MASTER, nullptr); }

int DrmDevice::read_resources(DrmResources& resources) {
  drm_mode_card_res request{};
  request.crtc_id_ptr = address_of(resources.crtcs.data());
  request.connector_id_ptr = address_of(resources.connectors.data());
  request.count_crtcs = request.count_connectors = DrmResources::kMost;
  const int result = control(DRM_IOCTL_MODE_GETRESOURCES, request);
  if (result < 0) return result;
  resources.crtc_count = std::min<std::size_t>(request.count_crtcs, DrmResources::kMost);
  resources.connector_count = std::min<std::size_t>(request.count_connectors, DrmResources::kMost);
  return 0;
}

int DrmDevice::read_connector(std::uint32_t id, DrmConnector& connector) {
  connector.id = id;
  connector.connected = false;
  connector.mode_count = connector.encoder_count = 0;
  // Asked without room for modes, the kernel looks at the connector anew; asked again, it tells what it saw.
  drm_mode_get_connector request{};
  request.connector_id = id;
  int result = control(DRM_IOCTL_MODE_GETCONNECTOR, request);
  if (result < 0) return result;
  if (request.count_modes > DrmConnector::kMostModes || request.count_encoders > DrmConnector::kMostEncoders)
    return -E2BIG;
  request.count_modes = DrmConnector::kMostModes;
  request.count_encoders = DrmConnector::kMostEncoders;
  request.count_props = 0;
  request.modes_ptr = address_of(connector.modes.data());
  request.encoders_ptr = address_of(connector.encoders.data());
  result = control(DRM_IOCTL_MODE_GETCONNECTOR, request);
  if (result < 0) return result;
  constexpr std::uint32_t kConnected = 1;  // drm_connector_status, which has no name in the kernel's interface
  connector.connected = request.connection == kConnected;
  connector.current_encoder = request.encoder_id;
  connector.mode_count = std::min<std::size_t>(request.count_modes, DrmConnector::kMostModes);
  connector.encoder_count = std::min<std::size_t>(request.count_encoders, DrmConnector::kMostEncoders);
  return 0;
}

int DrmDevice::read_encoder(std::uint32_t id, drm_mode_get_encoder& encoder) {
  encoder = {};
  encoder.encoder_id = id;
  return control(DRM_IOCTL_MODE_GETENCODER, encoder);
}

int DrmDevice::read_crtc(std::uint32_t id, drm_mode_crtc& crtc) {
  crtc = {};
  crtc.crtc_id = id;
  return control(DRM_IOCTL_MODE_GETCRTC, crtc);
}

int DrmDevice::set_crtc(std::uint32_t crtc, std::uint32_t frame_buffer, std::uint32_t connector,
                        const drm_mode_modeinfo* mode) {
  drm_mode_crtc request{};
  request.crtc_id = crtc;
  if (mode != nullptr) {
    request.fb_id = frame_buffer;
    request.set_connectors_ptr = address_of(&connector);
    request.count_connectors = 1;
    request.mode_valid = 1;
    request.mode = *mode;
  }
  return control(DRM_IOCTL_MODE_SETCRTC, request);
}

int DrmDevice::create_buffer(std::uint32_t width, std::uint32_t height, std::uint32_t bits, std::uint32_t fourcc,
                             DumbBuffer& buffer) {
  buffer = {};
  drm_mode_create_dumb created{};
  created.width = width;
  created.height = height;
  created.bpp = bits;
  int result = control(DRM_IOCTL_MODE_CREATE_DUMB, created);
  if (result < 0) return result;
  buffer = {created.handle, created.pitch, created.size, 0};
  drm_mode_fb_cmd2 frame{};
  frame.width = width;
  frame.height = height;
  frame.pixel_format = fourcc;
  frame.handles[0] = created.handle;
  frame.pitches[0] = created.pitch;
  result = control(DRM_IOCTL_MODE_ADDFB2, frame);
  if (result < 0) destroy_buffer(buffer);
  else buffer.frame_buffer = frame.fb_id;
  return result < 0 ? result : 0;
}

int DrmDevice::map_buffer(const DumbBuffer& buffer, void* address, std::size_t bytes) {
  drm_mode_map_dumb request{};
  request.handle = buffer.handle;
  const int result = control(DRM_IOCTL_MODE_MAP_DUMB, request);
  return result < 0 ? result : kernel_.map_at(address, bytes, file_, request.offset);
}

void DrmDevice::destroy_buffer(DumbBuffer& buffer) {
  if (buffer.frame_buffer != 0) {
    unsigned int id = buffer.frame_buffer;
    control(DRM_IOCTL_MODE_RMFB, id);
  }
  if (buffer.handle != 0) {
    drm_mode_destroy_dumb request{buffer.handle};
    control(DRM_IOCTL_MODE_DESTROY_DUMB, request);
  }
  buffer = {};
}

int DrmDevice::flip(std::uint32_t crtc, std::uint32_t frame_buffer) {
  drm_mode_crtc_page_flip request{};
  request.crtc_id = crtc;
  request.fb_id = frame_buffer;
  request.flags = DRM_MODE_PAGE_FLIP_EVENT;
  request.user_data = last_flip_ + 1;
  const int result = control(DRM_IOCTL_MODE_PAGE_FLIP, request);
  if (result == 0) ++last_flip_;
  return result;
}

int DrmDevice::wait_for_flip(int timeout_ms) {
  const std::uint64_t deadline_ns = monotonic_now_ns() + static_cast<std::uint64_t>(timeout_ms) * 1'000'000u;
  for (;;) {
    const std::uint64_t now_ns = monotonic_now_ns();
    const int left_ms = now_ns < deadline_ns ? static_cast<int>((deadline_ns - now_ns + 999'999) / 1'000'000) : 0;
    const int ready = kernel_.wait_readable(file_, left_ms);
    if (ready == -EINTR && left_ms > 0) continue;
    if (ready < 0) return ready;
    if (ready == 0) return -ETIMEDOUT;
    alignas(8) std::array<std::byte, 1024> events;
    const std::ptrdiff_t read = kernel_.read(file_, events.data(), events.size());
    if (read == -EINTR || read == -EAGAIN) continue;
    if (read < 0) return static_cast<int>(read);
    if (tells_flip(std::span(events).first(static_cast<std::size_t>(read)), last_flip_)) return 0;
    if (left_ms == 0) return -ETIMEDOUT;
  }
}

int DrmDevice::flush(std::uint32_t frame_buffer, std::uint32_t width, std::uint32_t height) {
  drm_clip_rect whole{};
  whole.x2 = static_cast<unsigned short>(width);
  whole.y2 = static_cast<unsigned short>(height);
  drm_mode_fb_dirty_cmd request{};
  request.fb_id = frame_buffer;
  request.num_clips = 1;
  request.clips_ptr = address_of(&whole);
  const int result = control(DRM_IOCTL_MODE_DIRTYFB, request);
  return result == -ENOSYS ? 0 : result;
}

}  // namespace usuzumi::linux_hal
