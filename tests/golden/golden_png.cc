#include "tests/golden/golden_png.h"

#include <png.h>

#include <stdexcept>

namespace usuzumi::golden {

scenes::RgbPicture read_png(const std::filesystem::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) throw std::runtime_error(path.string() + ": " + image.message);
  image.format = PNG_FORMAT_RGB;
  scenes::RgbPicture picture{image.width, image.height, {}};
  picture.rgb.resize(std::size_t{image.width} * image.height * 3);
  if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) == 0) throw std::runtime_error(path.string() + ": " + image.message);
  return picture;
}

void write_png(const std::filesystem::path& path, const scenes::RgbPicture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = picture.width;
  image.height = picture.height;
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, path.c_str(), 0, picture.rgb.data(), 0, nullptr) == 0)
    throw std::runtime_error(path.string() + ": " + image.message);
}

}  // namespace usuzumi::golden
