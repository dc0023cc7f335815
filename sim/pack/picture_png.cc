#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <vector>

#include "sim/pack/picture_file.h"

namespace usuzumi::sim {
namespace {

/// What libpng's callbacks need. libpng leaves by longjmp, so nothing with a destructor lives between setjmp and it.
struct PngSource {
  std::span<const std::byte> rest;
  char message[128] = {};
};

void read_bytes(png_structp png, png_bytep out, png_size_t size) {
  auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (size > source.rest.size()) png_error(png, "the file ends too early");
  std::memcpy(out, source.rest.data(), size);
  source.rest = source.rest.subspan(size);
}

void on_error(png_structp png, png_const_charp message) {
  auto& source = *static_cast<PngSource*>(png_get_error_ptr(png));
  std::strncpy(source.message, message, sizeof source.message - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

/// Eight bits each of red, green, blue and alpha, without any gamma: what the file stores.
void ask_for_rgba(png_structp png) {
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
}

class PngReader {
 public:
  explicit PngReader(std::span<const std::byte> file) : source_{file} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, on_error, on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool read_header() {
    if (png_ == nullptr || info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, &source_, read_bytes);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_read_info(png_, info_);
    return true;
  }
  std::uint32_t width() const { return png_get_image_width(png_, info_); }
  std::uint32_t height() const { return png_get_image_height(png_, info_); }
  const char* message() const { return source_.message; }

  bool read_rows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    ask_for_rgba(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != std::size_t{4} * width()) png_error(png_, "rows of an unexpected size");
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  PngSource source_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

std::optional<Picture> decode_png(std::span<const std::byte> file, std::string& fault) {
  PngReader reader(file);
  if (!reader.read_header()) {
    fault = fmt::format("is a damaged PNG ({})", reader.message());
    return std::nullopt;
  }
  std::optional<Picture> picture = picture_of(reader.width(), reader.height(), fault);
  if (!picture) return std::nullopt;
  std::vector<png_bytep> rows;  // Rgba8 has the bytes R, G, B, A in rising address order, as libpng writes them
  for (std::uint32_t y = 0; y < picture->height; ++y)
    rows.push_back(reinterpret_cast<png_bytep>(picture->texels.data() + std::size_t{y} * picture->width));
  if (reader.read_rows(rows.data())) return picture;
  fault = fmt::format("is a damaged PNG ({})", reader.message());
  return std::nullopt;
}

}  // namespace usuzumi::sim
