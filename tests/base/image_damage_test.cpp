// Image files that cannot be read or written: one clear Error each, and nothing half-written.
#include <gtest/gtest.h>

#include "base/file.h"
#include "base/image/image_io.h"
#include "expect_error.h"
#include "file_size_limit.h"
#include "png_bytes.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

Image makeImage(int side) {
  Image image(side, side, 3);
  std::uint32_t state = 1; // noise, so that it does not compress
  for (float& v : image.pixels) v = static_cast<float>((state = state * 1664525 + 1013904223) >> 8) * 0x1p-24f;
  return image;
}

TEST(ReadImage, RefusesTruncatedFilesOfEveryFormat) {
  const TempFolder folder;
  const auto refusesCut = [&](const std::string& name, const std::string& whole) {
    for (const double share : {0.02, 0.3, 0.6, 0.9, 0.97}) {
      const std::filesystem::path file = folder / name;
      writeText(file, whole.substr(0, static_cast<std::size_t>(static_cast<double>(whole.size()) * share)));
      SCOPED_TRACE(share);
      testing::internal::CaptureStderr(); // no library may talk past us
      expectError([&] { readImage(file); }, file.string(), "");
      expectError([&] { decodeImage8(readFile(file), "embedded 7"); }, "embedded 7", "");
      EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    }
  };
  for (const std::string name : {"a.png", "a.exr", "a.hdr"}) {
    SCOPED_TRACE(name);
    writeImage(folder / name, makeImage(64));
    refusesCut(name, readText(folder / name));
  }
  refusesCut("a.jpg", readText(std::filesystem::path(PARITY_SOURCE_DIR) / "tests/base/data/ramp16.jpg"));
}

TEST(ReadImage, RefusesAPngWithAFlippedBit) {
  const TempFolder folder;
  writeImage(folder / "a.png", makeImage(64));
  const std::string whole = readText(folder / "a.png");
  for (const std::size_t at : {std::size_t{20}, std::size_t{50}, whole.size() / 2, whole.size() - 20}) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    writeText(folder / "a.png", damaged);
    expectError([&] { readImage(folder / "a.png"); }, "a.png", "");
  }
}

TEST(ReadImage, RefusesAnExrWithAFlippedBit) {
  const TempFolder folder;
  Image ramp(256, 256, 3); // what compresses has a checksum; what does not is stored as it is
  for (std::size_t i = 0; i < ramp.pixels.size(); ++i) ramp.pixels[i] = static_cast<float>(i % 1000);
  writeImage(folder / "a.exr", ramp);
  std::string damaged = readText(folder / "a.exr");
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 4);
  writeText(folder / "a.exr", damaged);
  expectError([&] { readImage(folder / "a.exr"); }, "a.exr", "damaged");
}

TEST(ReadImage, RefusesWhatIsNoFile) {
  const TempFolder folder;
  expectError([&] { readImage(folder / "no.png"); }, "no.png", "does not exist");
  expectError([&] { readImage8(folder / "no.png"); }, "no.png", "does not exist");
  expectError([&] { isIntegerImage(folder / "no.pfm"); }, "no.pfm", "does not exist");
  expectError([&] { readImage(folder.path()); }, folder.path().string(), "is a folder");
  writeText(folder / "empty.png", "");
  expectError([&] { readImage(folder / "empty.png"); }, "empty.png", "is empty");
  expectError([] { decodeImage8({}, "buffer 3"); }, "buffer 3", "is empty");
}

TEST(ReadImage, RefusesWhatIsNoImage) {
  const TempFolder folder;
  std::string text;
  for (int i = 0; i < 300; ++i) text += "a line of text\n";
  std::string noise;
  for (std::uint32_t i = 1; i < 6000; ++i) noise += static_cast<char>(i * i * 2654435761u >> 24);
  for (const std::string name : {"a.png", "a.exr", "a.hdr", "a.jpg", "a.txt", "a.mp4", "noextension"})
    for (const std::string& content : {text, noise}) {
      writeText(folder / name, content);
      expectError([&] { readImage(folder / name); }, name, "decoded");
      expectError([&] { decodeImage8(readFile(folder / name), "embedded"); }, "embedded", "is not one of PNG");
    }
}

TEST(ReadImage, RefusesSizesOutOfRange) {
  const TempFolder folder;
  const auto refuses = [&](std::uint32_t width, std::uint32_t height, const std::string& reason) {
    const std::vector<std::byte> bytes = makePng({.width = width, .height = height}, std::vector<std::uint8_t>{});
    writeBytes(folder / "a.png", bytes);
    testing::internal::CaptureStderr();
    expectError([&] { readImage(folder / "a.png"); }, (folder / "a.png").string(), reason);
    expectError([&] { decodeImage8(bytes, "embedded"); }, "embedded", reason);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  };
  refuses(0, 0, "has no pixels (0 x 0");
  refuses(0, 16, "has no pixels");
  refuses(16, 0, "has no pixels");
  refuses(16385, 1, "largest allowed side");
  refuses(1, 100000, "largest allowed side");
  writeText(folder / "a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 20000 +X 2\n" + std::string(100, 'x'));
  expectError([&] { readImage(folder / "a.hdr"); }, "a.hdr", "largest allowed side");
  writeText(folder / "a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n");
  expectError([&] { readImage(folder / "a.hdr"); }, "a.hdr", "");
}

TEST(WriteImage, RefusesImagesWithoutPixelsOrOfWrongSize) {
  const TempFolder folder;
  for (const std::string name : {"a.png", "a.exr", "a.hdr", "a.pfm"}) {
    expectError([&] { writeImage(folder / name, Image()); }, name, "has no pixels");
    expectError([&] { writeImage(folder / name, Image(0, 5, 3)); }, name, "has no pixels");
    Image torn(4, 4, 3);
    torn.pixels.pop_back();
    expectError([&] { writeImage(folder / name, torn); }, name, "does not fit");
  }
  expectError([&] { writeImage8(folder / "a.png", Image8()); }, "a.png", "has no pixels");
  EXPECT_TRUE(folder.entries().empty());
}

TEST(WriteImage, RefusesFormatsAndChannelsThatDoNotFit) {
  const TempFolder folder;
  const Image image(2, 2, 3);
  for (const std::string name : {"a", "a.jpg", "a.tif", "a.exr.bak"})
    expectError([&] { writeImage(folder / name, image); }, name, "use .png, .exr, .hdr or .pfm");
  expectError([&] { writeImage8(folder / "a.exr", Image8(2, 2, 3)); }, "a.exr", ".png only");
  expectError([&] { writeImage(folder / "a.png", Image(2, 2, 5)); }, "a.png", "5 channels");
  expectError([&] { writeImage(folder / "a.exr", image, {.channelNames = {"R"}}); }, "a.exr", "1 channel names");
  expectError([&] { writeImage(folder / "a.exr", image, {.channelNames = {"R", "G", "R"}}); }, "a.exr", "twice");
  expectError([&] { writeImage(folder / "a.exr", image, {.channelNames = {"R", "G", ""}}); }, "a.exr", "empty");
  EXPECT_TRUE(folder.entries().empty());
}

TEST(WriteImage, LeavesNothingHalfWrittenOnAFullDisk) {
  const TempFolder folder;
  for (const std::string name : {"a.png", "a.exr", "a.hdr", "a.pfm"}) {
    const Image old(3, 3, 3, 0.5f);
    writeImage(folder / name, old);
    const std::string before = readText(folder / name);
    for (const int side : {20, 200}) { // below and above the size of any buffer
      const FileSizeLimit limit(500);
      expectError([&] { writeImage(folder / name, makeImage(side)); }, (folder / name).string(), "cannot be written");
      expectError([&] { writeImage(folder / ("new-" + name), makeImage(side)); }, "new-" + name, "cannot be written");
    }
    EXPECT_EQ(readText(folder / name), before) << name;
  }
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a.exr", "a.hdr", "a.pfm", "a.png"}));
}

TEST(WriteImage, RefusesATargetThatIsAFolder) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "a.png");
  expectError([&] { writeImage(folder / "a.png", makeImage(4)); }, "a.png", "is a folder");
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"a.png"});
}

} // namespace
} // namespace parity::base
