// libpng's calls, its jump past our frames turned into an Error.
#include "base/image/png_write.h"

#include <array>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include <png.h>

#include "base/error.h"

namespace parity::base {

namespace {

// What libpng's functions reach by their void pointer.
struct Output {
  std::vector<std::byte> bytes;
  std::array<char, 128> reason{};
};

// libpng jumps over frames: they hold nothing that has a destructor.
[[noreturn]] void fail(png_structp png, const char* reason) {
  auto* output = static_cast<Output*>(png_get_error_ptr(png));
  std::strncpy(output->reason.data(), reason, output->reason.size() - 1);
  png_longjmp(png, 1);
}

void ignoreWarning(png_structp /*png*/, const char* /*reason*/) {}

bool append(std::vector<std::byte>& bytes, const png_byte* data, std::size_t size) {
  try {
    const auto* begin = reinterpret_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

void write(png_structp png, png_bytep data, std::size_t size) {
  if (!append(static_cast<Output*>(png_get_io_ptr(png))->bytes, data, size)) png_error(png, "out of memory");
}

void flush(png_structp /*png*/) {}

// False after an error, whose reason the output holds.
bool writeFile(png_structp png, png_infop info, const Image8& image, int compression) {
  constexpr std::array kColorTypes{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                   PNG_COLOR_TYPE_RGB_ALPHA};
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               kColorTypes[static_cast<std::size_t>(image.channels - 1)], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
               PNG_FILTER_TYPE_BASE);
  png_set_compression_level(png, compression);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_AVG); // trying all five for each row costs more than it saves
  png_write_info(png, info);
  const std::size_t stride = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  for (int y = 0; y < image.height; ++y) png_write_row(png, image.pixels.data() + static_cast<std::size_t>(y) * stride);
  png_write_end(png, info);
  return true;
}

} // namespace

std::vector<std::byte> encodePng(const Image8& image, int compression, const std::string& name) {
  struct Destroy {
    void operator()(png_struct* png) const { png_destroy_write_struct(&png, nullptr); }
  };
  Output output;
  const std::unique_ptr<png_struct, Destroy> png(
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, fail, ignoreWarning));
  if (!png) throw fileError(name, "cannot be written", "libpng does not start");
  png_infop info = png_create_info_struct(png.get());
  png_set_write_fn(png.get(), &output, write, flush);
  const bool written = info && writeFile(png.get(), info, image, compression);
  png_destroy_info_struct(png.get(), &info);
  if (!written) throw fileError(name, "cannot be written", output.reason[0] ? output.reason.data() : "out of memory");
  return std::move(output.bytes);
}

} // namespace parity::base
