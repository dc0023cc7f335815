#include "hal/linux/drm_display.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <drm_fourcc.h>

namespace usuzumi::linux_hal {
namespace {

constexpr std::uint32_t kMostCards = 16;  // of /dev/dri/card0, card1, …: the kernel's primary nodes end far above it

struct DrmFormat {
  std::uint32_t fourcc, bits;
};

DrmFormat drm_format(command::PixelFormat format) {
  if (format == command::PixelFormat::kRgb565) return {DRM_FORMAT_RGB565, 16};
  return {DRM_FORMAT_XRGB8888, 32};
}

bool progressive(const drm_mode_modeinfo& mode) {
  return (mode.flags & (DRM_MODE_FLAG_INTERLACE | DRM_MODE_FLAG_DBLSCAN)) == 0;
}

/// Sizes of pictures, each once.
struct SizeList {
  static constexpr std::size_t kMost = 256;
  struct Size {
    std::uint16_t width, height;
    bool operator==(const Size&) const = default;
  };
  std::array<Size, kMost> sizes{};
  std::size_t count = 0;

  /// Whether it is a new one.
  bool add(Size size) {
    for (std::size_t i = 0; i < count; ++i)
      if (sizes[i] == size) return false;
    if (count == kMost) return false;
    sizes[count++] = size;
    return true;
  }
};

std::size_t whole_pages(std::size_t bytes) {
  return (bytes + Display::kPictureAlignment - 1) / Display::kPictureAlignment * Display::kPictureAlignment;
}

/// What a person can do about it.
const char* advice(int result) {
  switch (-result) {
    case EACCES:
    case EPERM: return ": no permission; run as a member of its group (video), and see that no other program shows "
                       "pictures on this card";
    case EBUSY: return ": in use by another program (a desktop, another instrument); stop that one first";
    case ENOENT: return ": not there; load the driver of the display, or name another by --card";
    case ENODEV:
    case ENXIO: return ": the device is gone; look for the driver's words in dmesg";
    case EINVAL: return ": refused by the driver; try another --size or --card";
    case ENOMEM:
    case ENOSPC: return ": no memory for pictures of this size; give the driver more (cma=), or ask for a smaller "
                        "--size";
    case ENOTTY:
    case EOPNOTSUPP: return ": no card that sets modes; name another by --card";
    case ENOSYS: return ": the driver has no plain buffers; name another card by --card";
    default: return ": failed; look for the driver's words in dmesg";
  }
}

}  // namespace

Status DrmDisplay::failed(const char* what, int result) {
  text_.clear();
  text_.text("display ").text(path_).text(what).text(advice(result));
  return text_.errno_status(result);
}

Status DrmDisplay::open(const DrmConfig& config) {
  release();
  config_ = config;
  if (config.card != nullptr) return open_card(config.card);
  // A card without a display (a GPU alone) is passed over; where none has one, the first card says what is wrong.
  StatusText path, first_failed;
  for (std::uint32_t n = 0; n < kMostCards; ++n) {
    path.clear();
    path.text("/dev/dri/card").number(n);
    const Status status = open_card(path.c_str());
    if (status.ok() || status.code == StatusCode::kInvalidArgument) return status;
    if (card_exists_ && first_failed.empty()) first_failed = path;
  }
  if (!first_failed.empty()) return open_card(first_failed.c_str());
  text_.clear();
  return text_.text("display: no card in /dev/dri; load the driver of the display (virtio-gpu, stm, rcar-du)")
      .errno_status(-ENODEV);
}

Status DrmDisplay::open_card(const char* path) {
  const std::size_t length = std::strlen(path);
  if (length >= sizeof path_) {
    text_.clear();
    return text_.text("display: the path of the card is too long; characters")
        .status(StatusCode::kInvalidArgument, static_cast<std::uint32_t>(length));
  }
  std::memcpy(path_, path, length + 1);
  int result = device_.open(path_);
  card_exists_ = result != -ENOENT;
  if (result < 0) return failed("", result);
  // Whoever opens a card first is its master. Old kernels let only root ask; then setting the mode finds it out.
  result = device_.set_master();
  const Status status = result == -EBUSY ? failed("", result) : pick_mode();
  if (!status.ok()) {
    device_.drop_master();
    device_.close();
  }
  return status;
}

Status DrmDisplay::pick_mode() {
  DrmResources resources;
  const int result = device_.read_resources(resources);
  if (result < 0) return failed("", result);
  bool connected = false;
  int unread = 0;              // errno of the first connector that cannot be read
  std::uint32_t unserved = 0;  // a connector that has the size, and no CRTC
  for (std::size_t i = 0; i < resources.connector_count; ++i) {
    const int read = device_.read_connector(resources.connectors[i], connector_);
    if (read < 0 && unread == 0) unread = read;
    if (read < 0 || !connector_.connected || connector_.mode_count == 0) continue;
    connected = true;
    const drm_mode_modeinfo* const mode = mode_of_size();
    if (mode == nullptr) continue;
    mode_ = *mode;
    if (pick_crtc(resources)) return ok_status();
    unserved = connector_.id;
  }
  if (unserved == 0 && connected) return refuse_size(resources);
  if (unserved == 0 && unread != 0) return failed(": a connector", unread);
  text_.clear();
  text_.text("display ").text(path_);
  if (unserved != 0)
    return text_.text(": no CRTC serves the connector; connector").status(StatusCode::kUnavailable, unserved);
  return text_.text(": nothing is connected; check the panel's cable and its node in the device tree; connectors")
      .status(StatusCode::kUnavailable, static_cast<std::uint32_t>(resources.connector_count));
}

const drm_mode_modeinfo* DrmDisplay::mode_of_size() const {
  for (std::size_t i = 0; i < connector_.mode_count; ++i) {
    const drm_mode_modeinfo& mode = connector_.modes[i];
    if (mode.hdisplay == config_.width && mode.vdisplay == config_.height && progressive(mode)) return &mode;
  }
  return nullptr;
}

Status DrmDisplay::refuse_size(const DrmResources& resources) {
  text_.clear();
  text_.text("display ").text(path_).text(" has no ").size(config_.width, config_.height).text("; it has");
  constexpr std::size_t kRoomOfOne = 32;
  SizeList told;
  for (std::size_t c = 0; c < resources.connector_count; ++c) {
    if (device_.read_connector(resources.connectors[c], connector_) < 0 || !connector_.connected) continue;
    for (std::size_t i = 0; i < connector_.mode_count; ++i) {
      const drm_mode_modeinfo& mode = connector_.modes[i];
      if (!progressive(mode) || !told.add({mode.hdisplay, mode.vdisplay})) continue;
      if (text_.room() > 2 * kRoomOfOne) text_.text(" ").size(mode.hdisplay, mode.vdisplay);
    }
  }
  if (told.count == 0) text_.text(" interlaced ones alone");
  return text_.text("; sizes in all").status(StatusCode::kInvalidArgument, static_cast<std::uint32_t>(told.count));
}

bool DrmDisplay::pick_crtc(const DrmResources& resources) {
  drm_mode_get_encoder encoder;
  if (connector_.current_encoder != 0 && device_.read_encoder(connector_.current_encoder, encoder) == 0 &&
      encoder.crtc_id != 0) {
    crtc_ = encoder.crtc_id;
    return true;
  }
  for (std::size_t e = 0; e < connector_.encoder_count; ++e) {
    if (device_.read_encoder(connector_.encoders[e], encoder) < 0) continue;
    for (std::size_t c = 0; c < resources.crtc_count; ++c) {
      if ((encoder.possible_crtcs >> c & 1u) == 0) continue;
      crtc_ = resources.crtcs[c];
      return true;
    }
  }
  return false;
}

std::uint32_t DrmDisplay::do_stride_bytes(std::uint32_t width, std::uint32_t height, command::PixelFormat format) {
  if (!device_.is_open()) return 0;
  // Only the driver knows which rows it wants, and whether it takes the format: a buffer made for trial tells both.
  const DrmFormat drm = drm_format(format);
  DumbBuffer trial;
  if (device_.create_buffer(width, height, drm.bits, drm.fourcc, trial) < 0) return 0;
  const std::uint32_t stride_bytes = trial.stride_bytes;
  device_.destroy_buffer(trial);
  return stride_bytes;
}

Status DrmDisplay::refuse_pictures(const Scanout& scanout) {
  const bool rgb565 = scanout.format == command::PixelFormat::kRgb565;
  const DrmFormat drm = drm_format(scanout.format);
  DumbBuffer trial;
  const int result = device_.create_buffer(scanout.width, scanout.height, drm.bits, drm.fourcc, trial);
  device_.destroy_buffer(trial);
  const bool not_taken = result == -EINVAL || result == -ENOENT;  // ENOENT is virtio-gpu's word for a format
  StatusText& text = refused_[rgb565 ? 0 : 1];
  text.clear();
  text.text("display ").text(path_).text(not_taken ? " takes no " : ": ").text(rgb565 ? "RGB565" : "XRGB8888");
  text.text(" pictures of ").size(scanout.width, scanout.height);
  if (not_taken)
    return text.text(rgb565 ? "; leave out --rgb565" : "; name another by --card").text("; errno")
        .status(StatusCode::kInvalidArgument, static_cast<std::uint32_t>(-result));
  if (result < 0) return text.text(advice(result)).errno_status(result);
  return text.text(" were refused a moment ago; start the program anew; width")
      .status(StatusCode::kUnavailable, scanout.width);
}

int DrmDisplay::make_pictures(const Scanout& scanout) {
  const DrmFormat drm = drm_format(scanout.format);
  int result = device_.create_buffer(scanout.width, scanout.height, drm.bits, drm.fourcc, black_);
  const std::size_t bytes = std::size_t{scanout.stride_bytes} * scanout.height;
  mapped_bytes_ = 0;
  for (std::uint32_t i = 0; i < 2 && result == 0; ++i) {
    result = device_.create_buffer(scanout.width, scanout.height, drm.bits, drm.fourcc, pictures_[i]);
    if (result < 0) break;
    if (pictures_[i].stride_bytes != scanout.stride_bytes || pictures_[i].bytes < bytes) return -EINVAL;
    std::byte* const at = config_.vram.bytes.data() + (scanout.picture[i] - config_.vram.base);
    mapped_bytes_ = whole_pages(bytes);
    result = device_.map_buffer(pictures_[i], at, mapped_bytes_);
    if (result == 0) std::memset(at, 0, bytes);
  }
  return result;
}

Status DrmDisplay::do_start(const Scanout& scanout) {
  if (!device_.is_open()) return {StatusCode::kFailedPrecondition, "display started before open()", 0};
  if (scanout.width != mode_.hdisplay || scanout.height != mode_.vdisplay) {
    text_.clear();
    text_.text("display ").text(path_).text(" was opened for ").size(mode_.hdisplay, mode_.vdisplay);
    return text_.text(", not for ").size(scanout.width, scanout.height).text("; width")
        .status(StatusCode::kInvalidArgument, scanout.width);
  }
  if (scanout.stride_bytes == 0) return refuse_pictures(scanout);
  const std::size_t bytes = whole_pages(std::size_t{scanout.stride_bytes} * scanout.height);
  for (const BusAddress picture : scanout.picture)
    if (picture % kPictureAlignment != 0 || picture < config_.vram.base ||
        picture - config_.vram.base > config_.vram.bytes.size() ||
        bytes > config_.vram.bytes.size() - (picture - config_.vram.base))
      return {StatusCode::kInvalidArgument, "display: a picture lies outside VRAM, or not at a page; address", picture};
  release_crtc();
  destroy_pictures();
  scanout_ = scanout;
  int result = make_pictures(scanout);
  const bool made = result == 0;
  if (made) result = device_.read_crtc(crtc_, found_);
  if (result == 0) result = device_.set_crtc(crtc_, black_.frame_buffer, connector_.id, &mode_);
  started_ = result == 0;
  if (started_) return ok_status();
  destroy_pictures();
  return failed(made ? ": setting the mode" : ": pictures", result);
}

Status DrmDisplay::do_show(std::uint32_t picture, const PictureRectangle*) {
  if (!started_ || picture > 1)
    return {StatusCode::kFailedPrecondition, "display: show() of a picture that is not", picture};
  const std::uint32_t frame_buffer = pictures_[picture].frame_buffer;
  int result = device_.flip(crtc_, frame_buffer);
  if (result == -EBUSY) {  // of a flip that was given up: it may end late
    result = device_.wait_for_flip(config_.flip_timeout_ms);
    if (result == 0) result = device_.flip(crtc_, frame_buffer);
  }
  if (result == -EINVAL || result == -ENOSYS || result == -EOPNOTSUPP) {
    // A driver without flips. Setting the mode again shows the picture, and returns when it is shown.
    result = device_.set_crtc(crtc_, frame_buffer, connector_.id, &mode_);
    if (result == 0) result = device_.flush(frame_buffer, scanout_.width, scanout_.height);
    return result == 0 ? ok_status() : failed(": showing a picture", result);
  }
  if (result == 0) result = device_.wait_for_flip(config_.flip_timeout_ms);
  if (result == 0) return ok_status();
  if (result != -ETIMEDOUT) return failed(": page flip", result);
  text_.clear();
  text_.text("display ").text(path_);
  return text_.text(": no vertical blank came; look at the panel's clock and supply; waited ms")
      .status(StatusCode::kDeadlineExceeded, static_cast<std::uint32_t>(config_.flip_timeout_ms));
}

void DrmDisplay::release() {
  if (!device_.is_open()) return;
  release_crtc();
  destroy_pictures();
  device_.drop_master();
  device_.close();
}

void DrmDisplay::release_crtc() {
  if (!started_) return;
  started_ = false;
  const bool lit_before = found_.mode_valid != 0 && found_.fb_id != 0;
  // What was shown may be gone with the program that showed it; then the CRTC is switched off.
  if (!lit_before || device_.set_crtc(crtc_, found_.fb_id, connector_.id, &found_.mode) < 0)
    device_.set_crtc(crtc_, 0, 0, nullptr);
}

void DrmDisplay::destroy_pictures() {
  for (std::uint32_t i = 0; i < 2; ++i) {
    if (mapped_bytes_ > 0 && pictures_[i].handle != 0)
      kernel_.map_at(config_.vram.bytes.data() + (scanout_.picture[i] - config_.vram.base), mapped_bytes_, -1, 0);
    device_.destroy_buffer(pictures_[i]);
  }
  mapped_bytes_ = 0;
  device_.destroy_buffer(black_);
}

}  // namespace usuzumi::linux_hal
