// parity flip and what files hold beyond the pixels that it compares: never "identical" where that differs.
#include <cstdint>
#include <cstring>

#include "base/image/image_io.h"
#include "cli/flip/flip_pictures.h"

namespace parity::tests {
namespace {

void append(std::string& bytes, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

// A TIFF 6.0 file of `pages` grey 8-bit images of 4x4, little-endian, uncompressed.
std::string makeTiff(int pages, std::uint32_t orientation) {
  constexpr std::uint32_t kPixels = 16, kHead = 8, kTags = 10, kPage = 2 + 12 * kTags + 4 + kPixels;
  std::string bytes = "II*";
  bytes += '\0';
  append(bytes, kHead, 4);
  for (int page = 0; page < pages; ++page) {
    const std::uint32_t start = kHead + static_cast<std::uint32_t>(page) * kPage;
    append(bytes, kTags, 2);
    const auto tag = [&](std::uint32_t name, std::uint32_t value) {
      append(bytes, name, 2), append(bytes, 4, 2), append(bytes, 1, 4), append(bytes, value, 4);
    };
    tag(256, 4), tag(257, 4), tag(258, 8), tag(259, 1), tag(262, 1); // size, bits, raw, grey
    tag(273, start + kPage - kPixels), tag(274, orientation), tag(277, 1), tag(278, 4), tag(279, kPixels);
    append(bytes, page + 1 < pages ? start + kPage : 0, 4);
    for (std::uint32_t p = 0; p < kPixels; ++p) bytes += static_cast<char>(10 * p);
  }
  return bytes;
}

class FlipLayers : public FolderTest {
protected:
  // RGB of a picture and further channels of one value each.
  std::string writeLayers(const std::string& name, const std::vector<std::string>& further, float value) const {
    const base::Image rgb = makePicture(16, 8);
    base::Image all(16, 8, 3 + static_cast<int>(further.size()), value);
    for (std::size_t p = 0; p < rgb.pixelCount(); ++p)
      std::copy_n(rgb.pixels.data() + 3 * p, 3, all.pixels.data() + p * static_cast<std::size_t>(all.channels));
    base::WriteOptions options;
    options.channelNames = {"R", "G", "B"};
    options.channelNames.insert(options.channelNames.end(), further.begin(), further.end());
    base::writeImage(m_folder / name, all, options);
    return path(name);
  }
};

TEST_F(FlipLayers, PixelsAtAnotherPlaceOfThePictureAreNotComparable) {
  base::writeImage(m_folder / "a.exr", makePicture(16, 8));
  std::string bytes = readWholeFile(m_folder / "a.exr");
  const std::string name("dataWindow\0box2i\0", 17); // then its size and xMin, yMin, xMax, yMax
  const std::size_t at = bytes.find(name);
  ASSERT_NE(at, std::string::npos);
  for (const std::size_t corner : {std::size_t{0}, std::size_t{8}}) {
    std::int32_t x = 0;
    char* place = bytes.data() + at + name.size() + 4 + corner;
    std::memcpy(&x, place, 4);
    x += 500;
    std::memcpy(place, &x, 4);
  }
  const std::string a = path("a.exr"), moved = write("moved.exr", bytes);
  expectRefused(runParity({"flip", a, moved}), 3, {"moved.exr", "at +500+0", "at +0+0"});
  EXPECT_TRUE(exitedWith(0, runParity({"flip", moved, moved})));
}

TEST_F(FlipLayers, OtherOrientationIsNotComparable) {
  const std::string upright = write("upright.tif", makeTiff(1, 1)), turned = write("turned.tif", makeTiff(1, 6));
  expectRefused(runParity({"flip", upright, turned}), 3, {"turned.tif", "orientation 6", "orientation 1"});
  const RunResult same = runParity({"flip", turned, turned});
  EXPECT_TRUE(exitedWith(0, same));
  EXPECT_TRUE(contains(same.out, "not applied")) << same.out;
}

TEST_F(FlipLayers, FurtherImagesOfAFileAreNeverCalledIdentical) {
  const std::string one = write("one.tif", makeTiff(1, 1)), two = write("two.tif", makeTiff(2, 1));
  expectRefused(runParity({"flip", one, two}), 3, {"two.tif", "2 images", "1 image"});
  const RunResult result = runParity({"flip", two, two});
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_TRUE(contains(result.out, "holds 2 images; only the first is compared")) << result.out;
  EXPECT_TRUE(contains(linesOf(result.out).back(), "the compared parts of the files")) << result.out;
  EXPECT_EQ(flipJson({two, two})["pairs"][0]["identical"], false);
  EXPECT_TRUE(exitedWith(0, runParity({"flip", one, two, "--ignore-layers"})));
}

TEST_F(FlipLayers, LayersThatDifferAreNotComparableUnlessIgnored) {
  const std::string plain = writeLayers("plain.exr", {}, 0), near = writeLayers("near.exr", {"Z", "id"}, 1),
                    far = writeLayers("far.exr", {"Z", "id"}, 2), other = writeLayers("other.exr", {"Z", "N"}, 1);
  expectRefused(runParity({"flip", plain, near}), 3, {"near.exr", "Z", "none", "--ignore-layers"});
  expectRefused(runParity({"flip", near, other}), 3, {"other.exr", "N", "id"});
  expectRefused(runParity({"flip", near, far}), 3, {"far.exr", "Z", "differs"});
  EXPECT_EQ(flipJson({near, near})["pairs"][0]["identical"], true) << "the layers were compared bit by bit";
  const nlohmann::json ignored = flipJson({near, far, "--ignore-layers"})["pairs"][0];
  EXPECT_EQ(ignored["identical"], false);
  EXPECT_EQ(ignored["regions"][0]["figures"]["metrics"]["flip.max"], 0);
}

TEST_F(FlipLayers, IdsWithoutAPixelInTheAreaAreNamed) {
  base::writeImage(m_folder / "a.png", makePicture(16, 8));
  base::Image ids(16, 8, 1, 3.f);
  for (int y = 0; y < 8; ++y) *ids.at(15, y) = 9;
  base::writeImage(m_folder / "ids.exr", ids);
  const std::string a = path("a.png");
  const RunResult result = runParity({"flip", a, a, "--mask", path("ids.exr"), "--region", "0,0,4,4"});
  EXPECT_TRUE(contains(result.out, "region: id 3, 16 pixels (area 0,0,4,4 of mask ")) << result.out;
  EXPECT_TRUE(contains(result.out, "id 9")) << result.out;
}

} // namespace
} // namespace parity::tests
