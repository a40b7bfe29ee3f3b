// Small sound pictures of every format that is read, with an ICC profile where the format holds one.
#include "fuzz/image_seeds.h"

#include <algorithm>
#include <span>

#include "base/png_bytes.h"
#include "base/profiled_images.h"
#include "fuzz/environment_seeds.h"

namespace parity::tests {
namespace {

std::vector<std::byte> toBytes(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

} // namespace

std::map<std::string, std::vector<std::byte>> makeImageSeeds() {
  std::map<std::string, std::vector<std::byte>> seeds;
  const auto add = [&](const std::string& kind, const std::string& profile) {
    for (auto& [name, bytes] : base::makeProfiledImages(profile)) seeds[kind + name.substr(1)] = std::move(bytes);
  };
  add("plain", "");
  add("profile", base::makeIccProfile("cprt", 144, 24, "text" + std::string(20, 'a')));
  add("names", base::makeIccProfile("desc", 144, 36,
                                    "mluc" + std::string("\0\0\0\0\0\0\0\1\0\0\0\14enUS\0\0\0\10\0\0\0\34", 24) +
                                        std::string("\0a\0b\0c\0d", 8)));
  add("wraps", base::makeWrappingProfiles().front());
  const std::vector<std::uint8_t> samples(16, 7);
  seeds["grey16.png"] =
      base::makePng({.width = 2, .height = 2, .bitDepth = 16, .colorType = 0}, std::span(samples).first(8));
  seeds["rgba.png"] = base::makePng({.width = 2, .height = 2, .colorType = 6}, samples);
  seeds["text.ppm"] = toBytes("P3\n2 1\n255\n1 2 3 4 5 6\n");
  seeds["bytes.pgm"] = toBytes("P5\n2 2\n255\nabcd");
  std::string bitmap = std::string("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0", 30);
  seeds["small.bmp"] = toBytes(bitmap + std::string(24 + 16, '\0'));
  for (auto& [name, bytes] : makeEnvironmentSeeds())
    if (!name.ends_with(".pfm")) seeds["environment-" + name] = std::move(bytes);
  return seeds;
}

} // namespace parity::tests
