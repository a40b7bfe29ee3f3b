#include "base/image/hdr_write.h"

#include <cmath>
#include <new>
#include <utility>

#include <stb/stb_image_write.h>

#include "base/error.h"

namespace parity::base {

namespace {

constexpr float kTooLarge = 0x1p127f; // its exponent does not fit

struct Target {
  std::vector<std::byte> bytes;
  bool isFull = false; // no memory: no exception may go through the library
};

void append(void* user, void* from, int size) {
  Target& target = *static_cast<Target*>(user);
  const auto* begin = static_cast<const std::byte*>(from);
  try {
    if (!target.isFull) target.bytes.insert(target.bytes.end(), begin, begin + size);
  } catch (const std::bad_alloc&) {
    target.isFull = true;
  }
}

} // namespace

std::vector<std::byte> encodeHdr(const Image& image, const std::string& name) {
  for (const float v : image.pixels) {
    if (!(v >= 0) || !std::isfinite(v))
      throw fileError(name, "", "the format cannot hold negative or non-finite values; use .exr");
    if (v >= kTooLarge) throw fileError(name, "", "the format cannot hold values of 1.7e38 and more; use .exr");
  }
  Target target;
  if (!stbi_write_hdr_to_func(append, &target, image.width, image.height, 3, image.pixels.data()) || target.isFull)
    throw fileError(name, "", target.isFull ? "out of memory" : "cannot be written");
  return std::move(target.bytes);
}

} // namespace parity::base
