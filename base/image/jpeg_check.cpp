#include "base/image/jpeg_check.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio> // jpeglib.h needs it
#include <vector>

#include <jpeglib.h>
// after it
#include <jerror.h>

namespace parity::base {
namespace {

struct Errors {
  jpeg_error_mgr manager = {}; // first: libjpeg knows no more than it
  std::jmp_buf leave = {};
  char first[JMSG_LENGTH_MAX] = {}; // warning
  std::size_t rowBytes = 0;         // 0: no image
};

Errors& errorsOf(j_common_ptr common) { return *reinterpret_cast<Errors*>(common->err); }

// Of entropy coded data; other warnings are of what a header says oddly.
bool isOfData(int code) {
  constexpr std::array kCodes = {JWRN_HIT_MARKER,      JWRN_JPEG_EOF,    JWRN_HUFF_BAD_CODE,
                                 JWRN_EXTRANEOUS_DATA, JWRN_MUST_RESYNC, JWRN_BOGUS_PROGRESSION};
  return std::ranges::find(kCodes, code) != kCodes.end();
}

void onMessage(j_common_ptr common, int level) {
  Errors& errors = errorsOf(common);
  if (level < 0 && isOfData(errors.manager.msg_code) && errors.manager.num_warnings++ == 0)
    errors.manager.format_message(common, errors.first);
}

// Of plain data alone: libjpeg leaves it by longjmp. row: of `rowBytes`, as the first call told, which decodes nothing.
void decode(std::span<const std::byte> bytes, Errors& errors, unsigned char* row) {
  jpeg_decompress_struct image = {};
  image.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = [](j_common_ptr common) { std::longjmp(errorsOf(common).leave, 1); };
  errors.manager.emit_message = onMessage;
  if (setjmp(errors.leave) == 0) {
    jpeg_create_decompress(&image);
    jpeg_mem_src(&image, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&image, TRUE);
    image.scale_num = 1;
    image.scale_denom = 8;
    image.dct_method = JDCT_FASTEST;
    image.do_fancy_upsampling = FALSE;
    image.out_color_space = image.jpeg_color_space;
    jpeg_calc_output_dimensions(&image);
    if (!row) {
      errors.rowBytes = static_cast<std::size_t>(image.output_width) * static_cast<std::size_t>(image.num_components);
    } else {
      jpeg_start_decompress(&image);
      while (image.output_scanline < image.output_height) jpeg_read_scanlines(&image, &row, 1);
      jpeg_finish_decompress(&image);
    }
  }
  jpeg_destroy_decompress(&image);
}

} // namespace

std::string findJpegDamage(std::span<const std::byte> bytes) {
  Errors errors;
  decode(bytes, errors, nullptr);
  if (errors.rowBytes == 0) return {};
  std::vector<unsigned char> row(errors.rowBytes);
  errors = {};
  decode(bytes, errors, row.data());
  return errors.first;
}

} // namespace parity::base
