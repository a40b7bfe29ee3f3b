// WebP: every value as stored, and damage is refused.
#include <vector>

#include <gtest/gtest.h>
#include <webp/encode.h>

#include "base/file.h"
#include "base/image/image_io.h"
#include "base/image/webp.h"
#include "expect_error.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

// By the format's own library, without loss; exact keeps the colour where alpha is 0.
std::vector<std::byte> encode(const Image8& rgba) {
  WebPConfig config;
  WebPConfigInit(&config);
  config.lossless = config.exact = 1;
  WebPPicture picture;
  WebPPictureInit(&picture);
  picture.use_argb = 1;
  picture.width = rgba.width;
  picture.height = rgba.height;
  WebPPictureImportRGBA(&picture, rgba.pixels.data(), 4 * rgba.width);
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  EXPECT_TRUE(WebPEncode(&config, &picture));
  const auto* bytes = reinterpret_cast<const std::byte*>(writer.mem);
  std::vector<std::byte> file(bytes, bytes + writer.size);
  WebPMemoryWriterClear(&writer);
  WebPPictureFree(&picture);
  return file;
}

Image8 makePicture() {
  Image8 image(7, 5, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i * 37 % 256);
  return image;
}

TEST(Webp, GivesEveryValueAsStored) {
  const Image8 picture = makePicture();
  const std::vector<std::byte> file = encode(picture);
  EXPECT_EQ(decodeImage8(file, "a", 4), picture) << "alpha is not multiplied into the colour";
  const TempFolder folder;
  writeBytes(folder / "a.webp", file);
  EXPECT_EQ(readImage8(folder / "a.webp", 4), picture);
  const Image8 rgb = decodeImage8(file, "a", 3), two = decodeImage8(file, "a", 2), one = decodeImage8(file, "a", 1);
  for (std::size_t p = 0; p < picture.pixelCount(); ++p) {
    EXPECT_EQ(rgb.pixels[3 * p + 2], picture.pixels[4 * p + 2]);
    EXPECT_EQ(two.pixels[2 * p + 1], picture.pixels[4 * p + 3]);
    EXPECT_EQ(one.pixels[p], picture.pixels[4 * p]);
  }
}

TEST(Webp, RefusesWhatIsCutOffOrDamaged) {
  std::vector<std::byte> file = encode(makePicture());
  for (const std::size_t size :
       {std::size_t{11}, std::size_t{12}, std::size_t{20}, std::size_t{25}, file.size() / 2, file.size() - 4})
    expectError([&] { decodeWebp(std::span(file).first(size), "leaf", 4); }, "leaf", "cannot be decoded");
  file[16] = file[17] = file[20] = std::byte{0xff};
  expectError([&] { decodeWebp(file, "leaf", 4); }, "leaf", "cannot be decoded");
}

} // namespace
} // namespace parity::base
