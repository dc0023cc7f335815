#include <fmt/format.h>

#include <csetjmp>
#include <cstdio>
#include <vector>

// Behind <cstdio>, whose FILE they use without including it.
#include <jerror.h>
#include <jpeglib.h>

#include "sim/pack/picture_file.h"

namespace usuzumi::sim {
namespace {

/// libjpeg leaves by longjmp, so nothing with a destructor lives between setjmp and it.
struct JpegErrors {
  jpeg_error_mgr manager;  // first: libjpeg knows the whole by its address
  std::jmp_buf out;
  char message[JMSG_LENGTH_MAX] = {};
};

void on_error(j_common_ptr info) {
  auto* errors = reinterpret_cast<JpegErrors*>(info->err);
  info->err->format_message(info, errors->message);
  std::longjmp(errors->out, 1);
}

/// Warnings (level -1) that mean lost pixels are errors here; libjpeg would go on with grey.
void on_message(j_common_ptr info, int level) {
  const int code = info->err->msg_code;
  if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE)) on_error(info);
}

/// Of an inverted CMYK sample pair, as Adobe's programs store them: ink 0 is full.
std::uint32_t inked(std::uint32_t colour, std::uint32_t key) { return (colour * key + 127) / 255; }

class JpegReader {
 public:
  JpegReader() {
    info_.err = jpeg_std_error(&errors_.manager);
    errors_.manager.error_exit = on_error;
    errors_.manager.emit_message = on_message;
  }
  ~JpegReader() { jpeg_destroy_decompress(&info_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  bool read_header(std::span<const std::byte> file) {
    if (setjmp(errors_.out) != 0) return false;
    jpeg_create_decompress(&info_);
    jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(file.data()), file.size());
    jpeg_read_header(&info_, TRUE);
    four_ = info_.num_components == 4;
    info_.out_color_space = four_ ? JCS_CMYK : JCS_RGB;
    info_.dct_method = JDCT_ISLOW;
    return true;
  }

  /// `row` has four bytes for each of a row's texels.
  bool read_rows(unsigned char* row, Rgba8* texels) {
    if (setjmp(errors_.out) != 0) return false;
    read_rows_or_leave(row, texels);
    return true;
  }

  std::uint32_t width() const { return info_.image_width; }
  std::uint32_t height() const { return info_.image_height; }
  const char* message() const { return errors_.message; }

 private:
  void read_rows_or_leave(unsigned char* row, Rgba8* texels) {
    jpeg_start_decompress(&info_);
    while (info_.output_scanline < info_.output_height) {
      JSAMPROW rows[1] = {row};
      jpeg_read_scanlines(&info_, rows, 1);
      const unsigned char* in = row;
      for (std::uint32_t x = 0; x < info_.output_width; ++x, in += four_ ? 4 : 3)
        *texels++ = four_ ? from_cmyk(in) : rgba8(in[0], in[1], in[2]);
    }
    jpeg_finish_decompress(&info_);
  }

  Rgba8 from_cmyk(const unsigned char* in) const {
    const auto ink = [&](std::size_t i) {
      return info_.saw_Adobe_marker != 0 ? std::uint32_t{in[i]} : 255u - std::uint32_t{in[i]};
    };
    return rgba8(inked(ink(0), ink(3)), inked(ink(1), ink(3)), inked(ink(2), ink(3)));
  }

  jpeg_decompress_struct info_{};
  JpegErrors errors_{};
  bool four_ = false;
};

}  // namespace

std::optional<Picture> decode_jpeg(std::span<const std::byte> file, std::string& fault) {
  JpegReader reader;
  if (!reader.read_header(file)) {
    fault = fmt::format("is a damaged JPEG ({})", reader.message());
    return std::nullopt;
  }
  std::optional<Picture> picture = picture_of(reader.width(), reader.height(), fault);
  if (!picture) return std::nullopt;
  std::vector<unsigned char> row(std::size_t{4} * picture->width);
  if (reader.read_rows(row.data(), picture->texels.data())) return picture;
  fault = fmt::format("is a damaged JPEG ({})", reader.message());
  return std::nullopt;
}

}  // namespace usuzumi::sim
