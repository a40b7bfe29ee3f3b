// parity flip never passes what it could not compare.
#include <limits>

#include "base/image/image_io.h"
#include "cli/flip/flip_pictures.h"

namespace parity::tests {
namespace {

class FlipRefusals : public FlipPictures {};

TEST_F(FlipRefusals, NanOrInfinityInEitherImageIsAnErrorWithCountAndPlace) {
  const std::string good = write("good.exr", makePicture(8, 8));
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    base::Image image = makePicture(8, 8);
    image.at(3, 2)[1] = image.at(5, 6)[0] = value;
    const std::string bad = write("bad.exr", image);
    for (const std::vector<std::string>& pair : {std::vector{good, bad}, {bad, good}, {bad, bad}})
      expectRefused(runParity(join({{"flip"}, pair})), 4, {"bad.exr", "x 3, y 2", "2 pixels are NaN or infinite"});
  }
}

TEST_F(FlipRefusals, NonFinitePixelsCountedAsTheWorstErrorStillFail) {
  base::Image image = makePicture(8, 8);
  const std::string good = write("good.exr", image);
  image.at(3, 2)[1] = std::nanf("");
  const std::string bad = write("bad.exr", image);
  for (const std::vector<std::string>& pair : {std::vector{good, bad}, {bad, good}, {bad, bad}}) {
    const nlohmann::json json =
        flipJson(join({pair, {"--non-finite", "worst", "--metric", "flip.mean", "--fail", "0.99"}}), 2);
    EXPECT_EQ(json["pairs"][0]["regions"][0]["figures"]["nonFinite"], 1);
    EXPECT_EQ(firstFigures(json)["flip.max"], 1);
    EXPECT_TRUE(contains(json["pairs"][0]["reason"], "NaN")) << json["pairs"][0]["reason"];
  }
}

TEST_F(FlipRefusals, DifferentSizesAndChannelsAreNotComparable) {
  const std::string rgb = write("rgb.png", makePicture(16, 8)), other = write("other.png", makePicture(8, 16)),
                    grey = write("grey.png", base::Image(16, 8, 1, 0.5f)),
                    rgba = write("rgba.png", base::Image(16, 8, 4, 1.f));
  expectRefused(runParity({"flip", rgb, other}), 3, {"other.png", "8x16", "16x8"});
  expectRefused(runParity({"flip", rgb, grey}), 3, {"grey.png", "grey", "RGB"});
  expectRefused(runParity({"flip", rgb, rgba}), 3, {"rgba.png", "RGB + alpha", "--alpha ignore"});
  EXPECT_TRUE(exitedWith(0, runParity({"flip", rgb, rgba, "--alpha", "ignore"})));
}

// A header that promises more than there is: nothing of it may be taken.
std::string bigEndian(unsigned value, int bytes) {
  std::string text;
  for (int i = bytes; i-- > 0;) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

// T.81: a progressive frame of three components and one scan without data.
std::string makeProgressiveJpeg(unsigned side) {
  std::string text = "\xff\xd8\xff\xdb" + std::string("\0\x43\0", 3) + std::string(64, '\1');
  text += std::string("\xff\xc2\0\x11\x08", 5) + bigEndian(side, 2) + bigEndian(side, 2) +
          std::string("\3\1\x11\0\2\x11\0\3\x11\0", 10);
  for (const char table : {'\x00', '\x10'})
    text += std::string("\xff\xc4\0\x14", 4) + table + '\1' + std::string(16, '\0');
  return text + std::string("\xff\xda\0\x0c\3\1\0\2\0\3\0\0\0\0", 14) + std::string(300, '\0') + "\xff\xd9";
}

TEST_F(FlipRefusals, PairsThatTakeMoreThanTheLimitAreRefusedByTheirHeaders) {
  const auto write = [&](const std::string& name, const std::string& bytes) {
    writeFile(m_folder / name, bytes);
    return path(name);
  };
  const std::string png = write("huge.png", "\x89PNG\r\n\x1a\n" + bigEndian(13, 4) + "IHDR" + bigEndian(16384, 4) +
                                                bigEndian(16384, 4) + std::string("\x08\2\0\0\0", 5));
  const std::string jpeg = write("huge.jpg", makeProgressiveJpeg(16384));
  for (const std::string& file : {png, jpeg}) {
    const RunResult result = runParity({"flip", file, file});
    expectRefused(result, 4, {file, "16384x16384", "needs 13569 MiB", "the limit is 6144 MiB", "--max-memory"});
    EXPECT_LT(result.peakMiB, 200) << file;
    expectRefused(runParity({"flip", file, file, "--max-image", "8192"}), 4, {file, "8192", "--max-image"});
  }
}

TEST_F(FlipRefusals, LimitsOfSizeAndMemoryAreThoseOfTheOptions) {
  const std::string a = path("a.png");
  base::writeImage(a, makePicture(64, 32));
  EXPECT_TRUE(exitedWith(0, runParity({"flip", a, a, "--max-image", "64", "--max-memory", "257M"})));
  expectRefused(runParity({"flip", a, a, "--max-image", "63"}), 4, {a, "64 x 32", "--max-image"});
  expectRefused(runParity({"flip", a, a, "--max-memory", "256M"}), 4, {a, "64x32", "--max-memory"});
  const RunResult much = runParity({"flip", a, a, "--max-memory", "much"});
  EXPECT_TRUE(exitedWith(64, much));
  EXPECT_TRUE(contains(much.err, "--max-memory: 'much'")) << much.err;
}

// What is promised is kept: 2048^2 pixels of noise, 52 bytes each beside the program; 34 of pairs of 8 bits.
TEST_F(FlipRefusals, PeakOfAPairIsWithinWhatItsHeadersLead) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's memory is counted, too";
#endif
  const std::string a = path("a.png"), b = path("b.png");
  for (const std::string& file : {a, b}) {
    base::Image8 image(2048, 2048, 3);
    std::uint32_t state = file == a ? 1 : 2;
    for (std::uint8_t& v : image.pixels) v = static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
    base::writeImage8(file, image);
  }
  const RunResult result = runParity({"flip", a, b});
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_LT(result.peakMiB, (2048L * 2048 * 52 >> 20) + 256);
  const std::string small = write("small.png", makePicture(16, 8));
  const long own = runParity({"flip", small, small}).peakMiB;
  EXPECT_LT(result.peakMiB - own, 2048L * 2048 * 44 >> 20) << "of the program alone " << own; // 58 without bytes
}

TEST_F(FlipRefusals, EmptyMaskAndMaskOfAnotherSizeAreErrors) {
  const std::string a = write("a.png", makePicture(16, 8)), b = write("b.png", makePicture(16, 8, 0.8f));
  const std::string black = write("black.png", base::Image(16, 8, 1, 0.f)),
                    small = write("small.png", base::Image(8, 8, 1, 1.f)),
                    half = write("half.exr", base::Image(16, 8, 1, 0.5f));
  expectRefused(runParity({"flip", a, b, "--mask", black}), 4, {"black.png", "empty"});
  expectRefused(runParity({"flip", a, b, "--mask", small}), 3, {"small.png", "8x8", "16x8"});
  expectRefused(runParity({"flip", a, b, "--mask", half}), 4, {"half.exr", "x 0, y 0", "0.5", "whole numbers"});
  expectRefused(runParity({"flip", a, b, "--mask", path("no.png")}), 4, {"no.png", "exist"});
  expectRefused(runParity({"flip", a, b, "--region", "8,0,9,8"}), 3, {"--region", "16x8"});
}

TEST_F(FlipRefusals, HdrPairThatIsMostlyBlackIsStillMeasured) {
  base::Image image(64, 64, 3);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = 4 + 0.1f * static_cast<float>(x + y);
  const std::string a = write("a.exr", image), b = write("b.exr", changed(image, [](float v) { return 0.3f * v; }));
  const nlohmann::json json = flipJson({a, b, "--metric", "hdrflip.max", "--fail", "0.1"}, 2);
  EXPECT_EQ(json["pairs"][0]["range"], "hdr");
  EXPECT_GT(firstFigures(json)["hdrflip.max"].get<double>(), 0.1);
}

TEST_F(FlipRefusals, TwoBlackImagesAreIdenticalAndSaySo) {
  for (const char* name : {"black.png", "black.exr"}) {
    const std::string black = write(name, base::Image(16, 16, 3));
    const RunResult result = runParity({"flip", black, black, "--metric", "flip.mean", "--fail", "0.1"});
    EXPECT_TRUE(exitedWith(0, result));
    EXPECT_TRUE(contains(result.out, "identical")) << result.out;
    EXPECT_TRUE(contains(result.out, "black")) << result.out;
    EXPECT_TRUE(exitedWith(0, runParity({"flip", black, black, "--hdr"})));
  }
}

TEST_F(FlipRefusals, TransparentImagesAreIdenticalButNothingWasSeen) {
  const std::string clear = write("clear.png", base::Image(16, 16, 4, 0.f));
  const RunResult result = runParity({"flip", clear, clear, "--metric", "flip.mean", "--fail", "0.1"});
  EXPECT_TRUE(contains(linesOf(result.out).back(), "nothing is visible")) << result.out;
}

TEST_F(FlipRefusals, OutputThatWouldOverwriteAnInputIsAUsageError) {
  const std::string a = write("a.png", makePicture(16, 8)), b = write("b.png", makePicture(16, 8));
  const RunResult result = runParity({"flip", a, b, "-o", a});
  EXPECT_TRUE(exitedWith(64, result));
  EXPECT_TRUE(contains(result.err, "a compared reference image")) << result.err;
  const std::string mask = write("mask.png", base::Image(16, 8, 1, 1.f)), both = path("both");
  std::filesystem::create_symlink("a.png", m_folder / "link.png");
  const std::string link = path("link.png");
  for (const std::vector<std::string>& outputs : std::vector<std::vector<std::string>>{
           {"--json", b}, {"--csv", a}, {"--junit", mask}, {"-o", link}, {"--json", both, "--csv", both}}) {
    const RunResult other = runParity(join({{"flip", a, b, "--mask", mask}, outputs}));
    EXPECT_TRUE(exitedWith(64, other)) << outputs[0];
  }
  EXPECT_FALSE(std::filesystem::exists(both));
  EXPECT_EQ(base::readImage(b).width, 16);
}

} // namespace
} // namespace parity::tests
