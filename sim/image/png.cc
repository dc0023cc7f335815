#include "sim/image/png.h"

#include <fmt/format.h>
#include <png.h>

#include <span>
#include <string>
#include <vector>

#include "sim/common/error.h"
#include "sim/common/files.h"

namespace usuzumi::sim {
namespace {

/// libpng's simplified interface: no longjmp, one message.
class PngControl {
 public:
  PngControl() { image.version = PNG_IMAGE_VERSION; }
  ~PngControl() { png_image_free(&image); }
  PngControl(const PngControl&) = delete;
  PngControl& operator=(const PngControl&) = delete;

  png_image image{};
};

[[noreturn]] void refuse(const std::filesystem::path& path, const char* reason) {
  throw Error(ExitCode::kBadInput, fmt::format("{}: not a readable PNG ({}); export it again", path.string(), reason));
}

std::vector<unsigned char> rgb_bytes(const Image& image) {
  std::vector<unsigned char> rgb(image.xrgb.size() * 3);
  auto* out = rgb.data();
  for (const std::uint32_t p : image.xrgb) {
    *out++ = static_cast<unsigned char>(p >> 16 & 0xFF);
    *out++ = static_cast<unsigned char>(p >> 8 & 0xFF);
    *out++ = static_cast<unsigned char>(p & 0xFF);
  }
  return rgb;
}

}  // namespace

Image read_png(const std::filesystem::path& path) {
  const std::vector<std::byte> file = read_file(path);
  PngControl png;
  if (png_image_begin_read_from_memory(&png.image, file.data(), file.size()) == 0) refuse(path, png.image.message);
  if (png.image.width > kMaxPngSize || png.image.height > kMaxPngSize)
    throw Error(ExitCode::kBadInput, fmt::format("{}: {}x{} pixels; at most {} each way are read", path.string(),
                                                 png.image.width, png.image.height, kMaxPngSize));
  png.image.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> rgb(PNG_IMAGE_SIZE(png.image));
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&png.image, &black, rgb.data(), 0, nullptr) == 0) refuse(path, png.image.message);

  Image image(png.image.width, png.image.height);
  const unsigned char* in = rgb.data();
  for (std::uint32_t& p : image.xrgb) {
    p = static_cast<std::uint32_t>(in[0]) << 16 | static_cast<std::uint32_t>(in[1]) << 8 | in[2];
    in += 3;
  }
  return image;
}

void write_png(const std::filesystem::path& path, const Image& image, PngEffort effort) {
  const std::vector<unsigned char> rgb = rgb_bytes(image);
  PngControl png;
  png.image.width = image.width;
  png.image.height = image.height;
  png.image.format = PNG_FORMAT_RGB;
  png.image.flags = effort == PngEffort::kFast ? PNG_IMAGE_FLAG_FAST : 0u;
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::vector<std::byte> file(bytes);
  if (png_image_write_to_memory(&png.image, file.data(), &bytes, 0, rgb.data(), 0, nullptr) == 0)
    throw Error(ExitCode::kCannotWrite,
                fmt::format("{}: the picture cannot be encoded ({})", path.string(), png.image.message));
  write_file_atomically(path, std::span(file).first(bytes));
}

}  // namespace usuzumi::sim
