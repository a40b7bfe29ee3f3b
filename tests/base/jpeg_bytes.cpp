#include "base/jpeg_bytes.h"

#include <cstdint>
#include <cstdio> // jpeglib.h needs it
#include <cstdlib>

#include <jpeglib.h>

namespace parity::base {

std::vector<std::byte> makeNoisyJpeg(int width, int height) {
  jpeg_compress_struct image = {};
  jpeg_error_mgr errors = {};
  image.err = jpeg_std_error(&errors);
  jpeg_create_compress(&image);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&image, &memory, &size);
  image.image_width = static_cast<JDIMENSION>(width);
  image.image_height = static_cast<JDIMENSION>(height);
  image.input_components = 3;
  image.in_color_space = JCS_RGB;
  jpeg_set_defaults(&image);
  jpeg_start_compress(&image, TRUE);
  std::vector<unsigned char> row(static_cast<std::size_t>(3 * width));
  std::uint32_t state = 1;
  for (int y = 0; y < height; ++y) {
    for (unsigned char& value : row) value = static_cast<unsigned char>((state = state * 1664525 + 1013904223) >> 24);
    unsigned char* line = row.data();
    jpeg_write_scanlines(&image, &line, 1);
  }
  jpeg_finish_compress(&image);
  const auto* begin = reinterpret_cast<const std::byte*>(memory);
  std::vector<std::byte> bytes(begin, begin + size);
  jpeg_destroy_compress(&image);
  std::free(memory);
  return bytes;
}

} // namespace parity::base
