#include "tests/hal/linux/fake_kernel.h"

#include <cerrno>
#include <cstring>
#include <drm_fourcc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace usuzumi::linux_hal::testing {
namespace {

constexpr int kFirstFile = 1000;  // no file of this process
constexpr std::uint64_t kPage = 4096;

template <class T>
T* at(std::uint64_t address) {
  return reinterpret_cast<T*>(static_cast<std::uintptr_t>(address));
}

template <class T>
T& as(void* argument) {
  return *static_cast<T*>(argument);
}

}  // namespace

drm_mode_modeinfo mode_of(std::uint16_t width, std::uint16_t height) {
  drm_mode_modeinfo mode{};
  mode.hdisplay = width;
  mode.vdisplay = height;
  mode.vrefresh = 60;
  return mode;
}

FakeKernel::FakeKernel() {
  card.connectors = {{true, {mode_of(1024, 768), mode_of(64, 48), mode_of(800, 600), mode_of(800, 600)}}};
  card.formats = {DRM_FORMAT_XRGB8888};
}

FakeKernel::~FakeKernel() {
  for (const auto& [handle, buffer] : buffers_) ::close(buffer.memory);
}

std::vector<std::uint8_t> FakeKernel::panel(std::uint32_t bytes_per_pixel) const {
  const auto frame = frames_.find(card.shown_frame_buffer);
  if (frame == frames_.end()) return {};
  const Buffer& buffer = buffers_.at(frame->second);
  std::vector<std::uint8_t> pixels(std::size_t{buffer.width} * buffer.height * bytes_per_pixel);
  const std::size_t row_bytes = std::size_t{buffer.width} * bytes_per_pixel;
  for (std::size_t y = 0; y < buffer.height; ++y)
    if (pread(buffer.memory, pixels.data() + y * row_bytes, row_bytes, static_cast<off_t>(y * buffer.stride_bytes)) < 0)
      return {};
  return pixels;
}

int FakeKernel::do_open(const char* path) {
  if (path != card.path) return -ENOENT;
  if (card.open_error != 0) return -card.open_error;
  const int file = kFirstFile + static_cast<int>(next_id_++);
  files_.insert(file);
  return file;
}

int FakeKernel::do_close(int file) {
  if (files_.erase(file) == 0) return -EBADF;
  master_ = false;
  pending_flip_ = 0;
  events_.clear();
  return 0;
}

int FakeKernel::do_control(int file, unsigned long request, void* argument) {
  if (!files_.contains(file)) return -EBADF;
  const auto refusal = card.refusals.find(request);
  if (refusal != card.refusals.end() && refusal->second != 0) return -refusal->second;
  switch (request) {
    case DRM_IOCTL_SET_MASTER: master_ = true; return 0;
    case DRM_IOCTL_DROP_MASTER: master_ = false; return 0;
    case DRM_IOCTL_MODE_GETRESOURCES: return get_resources(as<drm_mode_card_res>(argument));
    case DRM_IOCTL_MODE_GETCONNECTOR: return get_connector(as<drm_mode_get_connector>(argument));
    case DRM_IOCTL_MODE_GETENCODER:
      if (as<drm_mode_get_encoder>(argument).encoder_id != FakeCard::kEncoder) return -ENOENT;
      as<drm_mode_get_encoder>(argument).possible_crtcs = 1;
      return 0;
    case DRM_IOCTL_MODE_GETCRTC:
      as<drm_mode_crtc>(argument).fb_id = card.shown_frame_buffer;
      as<drm_mode_crtc>(argument).mode_valid = card.shown_frame_buffer != 0;
      as<drm_mode_crtc>(argument).mode = mode_of(1024, 768);
      return 0;
    case DRM_IOCTL_MODE_SETCRTC: return set_crtc(as<drm_mode_crtc>(argument));
    case DRM_IOCTL_MODE_CREATE_DUMB: return create_dumb(as<drm_mode_create_dumb>(argument));
    case DRM_IOCTL_MODE_MAP_DUMB: {
      auto& map = as<drm_mode_map_dumb>(argument);
      map.offset = map.handle * kPage;
      return buffers_.contains(map.handle) ? 0 : -ENOENT;
    }
    case DRM_IOCTL_MODE_DESTROY_DUMB: {
      const auto buffer = buffers_.find(as<drm_mode_destroy_dumb>(argument).handle);
      if (buffer == buffers_.end()) return -ENOENT;
      ::close(buffer->second.memory);
      buffers_.erase(buffer);
      return 0;
    }
    case DRM_IOCTL_MODE_ADDFB2: return add_frame_buffer(as<drm_mode_fb_cmd2>(argument));
    case DRM_IOCTL_MODE_RMFB:
      if (card.shown_frame_buffer == as<unsigned int>(argument)) card.shown_frame_buffer = 0;  // as the kernel does
      return frames_.erase(as<unsigned int>(argument)) == 1 ? 0 : -ENOENT;
    case DRM_IOCTL_MODE_PAGE_FLIP: return page_flip(as<drm_mode_crtc_page_flip>(argument));
    case DRM_IOCTL_MODE_DIRTYFB:
      ++card.flushes;
      return frames_.contains(as<drm_mode_fb_dirty_cmd>(argument).fb_id) ? 0 : -ENOENT;
    default: return -ENOTTY;
  }
}

int FakeKernel::get_resources(drm_mode_card_res& request) const {
  if (request.count_crtcs >= 1) *at<std::uint32_t>(request.crtc_id_ptr) = FakeCard::kCrtc;
  const auto connectors = static_cast<std::uint32_t>(card.connectors.size());
  for (std::uint32_t i = 0; i < connectors && request.count_connectors >= connectors; ++i)
    at<std::uint32_t>(request.connector_id_ptr)[i] = FakeCard::kFirstConnector + i;
  request.count_crtcs = 1;
  request.count_connectors = connectors;
  return 0;
}

int FakeKernel::get_connector(drm_mode_get_connector& request) const {
  const std::uint32_t index = request.connector_id - FakeCard::kFirstConnector;
  if (index >= card.connectors.size()) return -ENOENT;
  const FakeConnector& connector = card.connectors[index];
  const auto count = static_cast<std::uint32_t>(connector.connected ? connector.modes.size() : 0);
  if (request.count_modes >= count && count > 0)
    std::memcpy(at<drm_mode_modeinfo>(request.modes_ptr), connector.modes.data(), count * sizeof(drm_mode_modeinfo));
  if (request.count_encoders >= 1) *at<std::uint32_t>(request.encoders_ptr) = FakeCard::kEncoder;
  request.count_modes = count;
  request.count_encoders = 1;
  request.connection = connector.connected ? 1 : 2;
  request.encoder_id = 0;
  return 0;
}

int FakeKernel::create_dumb(drm_mode_create_dumb& request) {
  const std::uint32_t row = request.width * request.bpp / 8;
  Buffer buffer;
  buffer.width = request.width;
  buffer.height = request.height;
  buffer.stride_bytes = (row + card.stride_unit_bytes - 1) / card.stride_unit_bytes * card.stride_unit_bytes;
  buffer.bytes = (std::uint64_t{buffer.stride_bytes} * request.height + kPage - 1) / kPage * kPage;
  buffer.memory = memfd_create("dumb", MFD_CLOEXEC);
  if (buffer.memory < 0 || ftruncate(buffer.memory, static_cast<off_t>(buffer.bytes)) < 0) return -ENOMEM;
  request.handle = next_id_++;
  request.pitch = buffer.stride_bytes;
  request.size = buffer.bytes;
  buffers_[request.handle] = buffer;
  return 0;
}

int FakeKernel::add_frame_buffer(drm_mode_fb_cmd2& request) {
  const auto buffer = buffers_.find(request.handles[0]);
  if (buffer == buffers_.end()) return -ENOENT;
  if (!card.formats.contains(request.pixel_format) || request.pitches[0] != buffer->second.stride_bytes) return -EINVAL;
  request.fb_id = next_id_++;
  frames_[request.fb_id] = request.handles[0];
  return 0;
}

int FakeKernel::set_crtc(const drm_mode_crtc& request) {
  if (!master_) return -EACCES;
  if (request.crtc_id != FakeCard::kCrtc) return -ENOENT;
  ++card.crtc_settings;
  if (request.mode_valid == 0) {
    card.shown_frame_buffer = 0;
    return 0;
  }
  if (request.count_connectors != 1) return -EINVAL;
  const std::uint32_t connector = *at<const std::uint32_t>(request.set_connectors_ptr);
  if (connector - FakeCard::kFirstConnector >= card.connectors.size()) return -EINVAL;
  if (request.fb_id != FakeCard::kConsoleBuffer && !frames_.contains(request.fb_id)) return -ENOENT;
  card.shown_frame_buffer = request.fb_id;
  card.driven_connector = connector;
  return 0;
}

int FakeKernel::page_flip(const drm_mode_crtc_page_flip& request) {
  if (pending_flip_ != 0) return -EBUSY;
  if (!frames_.contains(request.fb_id) || (request.flags & DRM_MODE_PAGE_FLIP_EVENT) == 0) return -EINVAL;
  pending_flip_ = request.fb_id;
  pending_number_ = request.user_data;
  ++card.flips;
  if (card.on_flip) card.on_flip(card.flips);
  return 0;
}

int FakeKernel::do_map_at(void* address, std::size_t bytes, int file, std::uint64_t offset) {
  if (file < 0) {
    mappings_.erase(address);
    return ::mmap(address, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == address
               ? 0
               : -ENOMEM;
  }
  const auto handle = static_cast<std::uint32_t>(offset / kPage);
  const auto buffer = buffers_.find(handle);
  if (!files_.contains(file) || buffer == buffers_.end() || bytes > buffer->second.bytes) return -EINVAL;
  if (::mmap(address, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, buffer->second.memory, 0) != address)
    return -ENOMEM;
  mappings_[address] = handle;
  return 0;
}

void FakeKernel::vertical_blank() {
  if (pending_flip_ == 0) return;
  card.shown_frame_buffer = pending_flip_;
  pending_flip_ = 0;
  // Another program's events come before ours, alone and in one read with it, as the kernel hands them out.
  drm_event_vblank blank{}, flip{};
  blank.base = {DRM_EVENT_VBLANK, sizeof blank};
  blank.user_data = pending_number_;  // numbers are each sender's own
  flip.base = {DRM_EVENT_FLIP_COMPLETE, sizeof flip};
  flip.user_data = pending_number_;
  events_.push_back({blank});
  events_.push_back({blank, flip});
}

int FakeKernel::do_wait_readable(int file, int) {
  if (!files_.contains(file)) return -EBADF;
  if (events_.empty() && card.flips_arrive) vertical_blank();
  return events_.empty() ? 0 : 1;
}

std::ptrdiff_t FakeKernel::do_read(int file, void* into, std::size_t bytes) {
  if (!files_.contains(file) || events_.empty()) return -EAGAIN;
  const std::vector<drm_event_vblank> events = events_.front();
  const std::size_t size = events.size() * sizeof(drm_event_vblank);
  if (bytes < size) return -EAGAIN;
  events_.pop_front();
  std::memcpy(into, events.data(), size);
  return static_cast<std::ptrdiff_t>(size);
}

}  // namespace usuzumi::linux_hal::testing
