// What parity flip takes pictures for: bit depths, channels, alpha, colour spaces, LDR or HDR, masks.
#include <array>
#include <cstdint>
#include <cstring>

#include "base/image/image_io.h"
#include "cli/flip/flip_pictures.h"
#include "support/exr_primaries.h"

namespace parity::tests {
namespace {

class FlipInputs : public FlipPictures {};

double decodeSrgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

TEST_F(FlipInputs, RangeIsChosenByContentAndSaid) {
  const base::Image dim = makePicture(32, 32), bright = makePicture(32, 32, 3);
  const std::string png = write("a.png", dim), low = write("low.exr", dim), high = write("high.exr", bright),
                    pfm = write("high.pfm", bright);
  const auto range = [&](const std::vector<std::string>& arguments) {
    const nlohmann::json pair = flipJson(arguments)["pairs"][0];
    EXPECT_NE(pair["rangeReason"], "");
    return pair["range"].get<std::string>();
  };
  EXPECT_EQ(range({low, low}), "ldr") << "floats, none above 1";
  EXPECT_EQ(range({high, pfm}), "hdr");
  EXPECT_EQ(range({low, high}), "hdr") << "the pair is judged together";
  EXPECT_EQ(range({png, high}), "ldr") << "integers hold no HDR";
  EXPECT_EQ(range({high, pfm, "--ldr"}), "ldr");
  EXPECT_EQ(range({png, png, "--hdr"}), "hdr");
  const RunResult printed = runParity({"flip", high, pfm});
  EXPECT_TRUE(contains(printed.out, "HDR: floats up to 2.4")) << printed.out;
  EXPECT_TRUE(contains(printed.out, "exposures from")) << printed.out;
}

TEST_F(FlipInputs, AlphaIsCompositedOverTheBackgroundInLinearLight) {
  // Half transparent red of a PNG (not multiplied by alpha) over linear 0.25.
  base::Image rgba(16, 16, 4, 0.5f), flat(16, 16, 3);
  for (std::size_t p = 0; p < rgba.pixelCount(); ++p) {
    const float stored[] = {204 / 255.f, 51 / 255.f, 102 / 255.f, 128 / 255.f};
    for (int c = 0; c < 4; ++c) rgba.pixels[4 * p + c] = stored[c];
    for (int c = 0; c < 3; ++c)
      flat.pixels[3 * p + c] = static_cast<float>(decodeSrgb(stored[c]) * stored[3] + 0.25 * (1 - stored[3]));
  }
  const std::string png = write("rgba.png", rgba);
  // The same in an EXR, which is linear and multiplied by alpha.
  base::Image exr = rgba;
  for (std::size_t p = 0; p < exr.pixelCount(); ++p)
    for (int c = 0; c < 3; ++c)
      exr.pixels[4 * p + c] = static_cast<float>(decodeSrgb(exr.pixels[4 * p + c])) * exr.pixels[4 * p + 3];
  const std::string associated = write("rgba.exr", exr);
  // And what both come to, opaque.
  base::Image opaque(16, 16, 4, 1.f);
  for (std::size_t p = 0; p < opaque.pixelCount(); ++p)
    std::copy_n(flat.pixels.data() + 3 * p, 3, opaque.pixels.data() + 4 * p);
  const std::string expected = write("opaque.exr", opaque);
  for (const std::string& image : {png, associated}) {
    const nlohmann::json json = flipJson({expected, image, "--background", "0.25,0.25,0.25"});
    EXPECT_LT(firstFigures(json)["flip.max"].get<double>(), 2e-3) << image;
    EXPECT_GT(firstFigures(flipJson({expected, image}))["flip.max"].get<double>(), 0.05) << "over black it differs";
  }
}

TEST_F(FlipInputs, AlphaAsAChannelHasARowOfItsOwn) {
  base::Image a(16, 16, 4, 0.5f), b = a;
  for (std::size_t p = 0; p < b.pixelCount(); ++p) b.pixels[4 * p + 3] = 1;
  const nlohmann::json json = flipJson({write("a.png", a), write("b.png", b), "--alpha", "channel"});
  const nlohmann::json rows = json["pairs"][0]["regions"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["name"], "image");
  EXPECT_EQ(rows[0]["figures"]["metrics"]["flip.max"], 0) << "the colour is the same";
  EXPECT_EQ(rows[1]["name"], "alpha");
  EXPECT_NEAR(rows[1]["figures"]["metrics"]["rmse"].get<double>(), 127 / 255., 1e-6);
  flipJson({path("a.png"), path("b.png"), "--alpha", "channel", "--metric", "flip.mean", "--fail", "0.01"}, 2);
}

TEST_F(FlipInputs, DeclaredColourSpaceIsConverted) {
  // Neutral greys are neutral in both; ACEScg green is not Rec.709 green.
  base::Image green(16, 16, 3);
  for (std::size_t p = 0; p < green.pixelCount(); ++p) green.pixels[3 * p + 1] = 0.5f;
  const std::string file = write("green.exr", green);
  const nlohmann::json linear = flipJson({file, file, "--colorspace", "linear"}),
                       acescg = flipJson({file, file, "--colorspace", "acescg"});
  const auto luma = [](const nlohmann::json& json) {
    return json["pairs"][0]["regions"][0]["figures"]["referenceLuma"].get<double>();
  };
  EXPECT_GT(luma(acescg), luma(linear) + 0.01) << "AP1 green clips brighter on an sRGB screen";
  EXPECT_TRUE(contains(acescg["pairs"][0]["referenceSpace"], "acescg"));
  // A float file that is declared sRGB is the PNG of the same values.
  base::Image levels = changed(makePicture(16, 16), [](float v) { return std::round(v * 255) / 255; });
  const std::string exr = write("levels.exr", levels), png = write("levels.png", levels);
  EXPECT_LT(firstFigures(flipJson({exr, png, "--colorspace", "srgb"}))["flip.max"].get<double>(), 1e-4);
}

TEST_F(FlipInputs, PrimariesThatAFileDeclaresAreHeeded) {
  const base::Image image = makePicture(16, 16);
  const std::string plain = write("plain.exr", image), aces = write("aces.exr", image), odd = write("odd.exr", image);
  writeFile(aces,
            withPrimaries(readWholeFile(aces), {0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f}));
  writeFile(odd, withPrimaries(readWholeFile(odd), {0.5f, 0.3f, 0.2f, 0.6f, 0.1f, 0.1f, 0.3127f, 0.329f}));
  const nlohmann::json pair = flipJson({plain, aces})["pairs"][0];
  EXPECT_EQ(pair["referenceSpace"], "linear, assumed of floats");
  EXPECT_EQ(pair["testSpace"], "acescg, declared by the file");
  EXPECT_EQ(flipJson({aces, plain, "--colorspace", "acescg"})["pairs"][0]["identical"], true);
  expectRefused(runParity({"flip", plain, odd}), 4, {"odd.exr", "chromaticities", "--colorspace"});
  EXPECT_EQ(flipJson({odd, plain, "--colorspace", "linear"})["pairs"][0]["identical"], true);
}

TEST_F(FlipInputs, EachIdOfAMaskIsARegion) {
  base::Image a = makePicture(32, 32), b = a, ids(32, 32, 1);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      *ids.at(x, y) = x < 16 ? 0.f : y < 16 ? 7.f : 40000.f;
      if (x >= 16 && y >= 16) b.at(x, y)[0] = 1;
    }
  const std::vector<std::string> pair = {write("a.exr", a), write("b.exr", b), "--mask", write("ids.exr", ids)};
  const nlohmann::json rows = flipJson(join({pair, {"--metrics", "flip,rmse"}}))["pairs"][0]["regions"];
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["name"], "id 0");
  EXPECT_EQ(rows[0]["figures"]["pixels"], 512);
  EXPECT_EQ(rows[0]["figures"]["metrics"]["rmse"], 0);
  EXPECT_EQ(rows[1]["name"], "id 7");
  EXPECT_EQ(rows[2]["name"], "id 40000");
  EXPECT_GT(rows[2]["figures"]["metrics"]["rmse"], 0.1);
  EXPECT_EQ(flipJson(join({pair, {"--ignore-id", "0"}}))["pairs"][0]["regions"].size(), 2u);
  const nlohmann::json failed = flipJson(join({pair, {"--metric", "rmse", "--fail", "0.1"}}), 2);
  EXPECT_TRUE(contains(failed["pairs"][0]["reason"], "id 40000")) << failed["pairs"][0]["reason"];
  expectRefused(runParity(join({{"flip"}, pair, {"--ignore-id", "3"}})), 4, {"id 3", "no pixel"});
  expectRefused(runParity(join({{"flip"}, pair, {"--ignore-id", "0", "--ignore-id", "7", "--ignore-id", "40000"}})), 4,
                {"no pixel is left"});
}

// Only the masked half counts: it is the same, the other is not.
TEST_F(FlipInputs, WhiteOfAMaskIsInAndAnAreaLimitsIt) {
  base::Image a = makePicture(48, 32), b = a, mask(48, 32, 1);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 48; ++x) {
      if (x < 12) b.at(x, y)[0] = 1;
      *mask.at(x, y) = x >= 24 ? 1.f : 0.f;
    }
  const std::vector<std::string> pair = {write("a.png", a), write("b.png", b)};
  EXPECT_GT(firstFigures(flipJson(pair))["rmse"], 0.05);
  const nlohmann::json masked = flipJson(join({pair, {"--mask", write("mask.png", mask)}}));
  EXPECT_EQ(masked["pairs"][0]["regions"][0]["name"], "mask");
  EXPECT_EQ(masked["pairs"][0]["regions"][0]["figures"]["pixels"], 24 * 32);
  EXPECT_EQ(firstFigures(masked)["flip.max"], 0) << "beyond the filters' reach of the change";
  const nlohmann::json area = flipJson(join({pair, {"--region", "24,8,10,4"}}));
  EXPECT_EQ(area["pairs"][0]["regions"][0]["figures"]["pixels"], 40);
  EXPECT_EQ(firstFigures(area)["flip.max"], 0);
}

TEST_F(FlipInputs, ViewingConditionsMakeThePixelsPerDegree) {
  const std::vector<std::string> pair = {write("a.png", makePicture(32, 32)),
                                         write("b.png", makePicture(32, 32, 0.7f))};
  // 0.7 m away from 3840 pixels over 0.7 m: 3840 pi/180 = 67.02.
  const std::vector<std::string> viewing = {"--distance", "0.7", "--resolution-x", "3840", "--screen-width", "0.7"};
  EXPECT_EQ(firstFigures(flipJson(join({pair, viewing}))), firstFigures(flipJson(pair)));
  EXPECT_NE(firstFigures(flipJson(join({pair, {"--ppd", "20"}}))), firstFigures(flipJson(pair)));
  EXPECT_TRUE(exitedWith(64, runParity(join({{"flip"}, pair, {"--distance", "0.7"}}))));
}

} // namespace
} // namespace parity::tests
