// parity render: terms that add up to the colour, every kind of file, both paths, samples.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/image/image_io.h"
#include "cli/checks.h"
#include "shading/terms.h"

namespace parity::tests {
namespace {

class RenderTest : public RenderingTest {
protected:
  // The picture read back from the file.
  base::Image render(const std::string& scene, const std::string& by, const std::string& file,
                     const std::vector<std::string>& more) const {
    return RenderingTest::render(scene, by, more, file);
  }
};

TEST(RenderTerms, AreListedWithTheirPaths) {
  const RunResult listed = runParity({"render", "--list-terms"});
  EXPECT_TRUE(exitedWith(0, listed));
  for (const char* name : {"skySpecular", "NoL", "--path mobile", "--path highend"})
    EXPECT_TRUE(contains(listed.out, name)) << name << " in " << listed.out;
}

// In black surroundings the colour of every pixel is the sum of the terms, 1e-3 relative (docs/design.md 10d).
TEST_F(RenderTest, TermsAddUpToTheColorOnBothPaths) {
  for (const std::string scene :
       {"builtin:spheres", "builtin:lamps", "builtin:lights", "builtin:shadows", "builtin:lobes"})
    for (const std::string path : {"highend", "mobile"}) {
      const std::size_t terms = scene == "builtin:lobes" ? shading::kTermCount : shading::kBaseTermCount;
      const base::Image image =
          render(scene, path, "terms.exr", {"--terms", "--background", "0,0,0", "--sun", "30,50,4", "--size", "96x96"});
      ASSERT_EQ(image.channels, static_cast<int>(3 * (1 + terms)));
      std::size_t lit = 0;
      for (std::size_t p = 0; p < image.pixelCount(); ++p)
        for (int c = 0; c < 3; ++c) {
          const float* pixel = image.pixels.data() + p * static_cast<std::size_t>(image.channels);
          double sum = 0;
          for (std::size_t t = 1; t <= terms; ++t) {
            ASSERT_GE(pixel[3 * t + static_cast<std::size_t>(c)], 0) << scene << " " << path << " pixel " << p;
            sum += pixel[3 * t + static_cast<std::size_t>(c)];
          }
          // docs/design.md 10d: 1e-3 in fp32, 4e-3 in half, the mobile path's default.
          const double limit = path == "mobile" ? 4e-3 : 1e-3;
          ASSERT_NEAR(sum, pixel[c], limit * std::abs(pixel[c]) + 1e-7) << scene << " " << path << " pixel " << p;
          lit += c == 0 && sum > 0;
        }
      EXPECT_GT(lit, image.pixelCount() / 5) << scene << " " << path;
      const std::string header = readWholeFile(m_folder / "terms.exr").substr(0, 4096);
      for (std::size_t t = 0; t < shading::kTermCount; ++t)
        EXPECT_EQ(contains(header, std::string(shading::kTermNames[t]) + ".R"), t < terms) << shading::kTermNames[t];
    }
}

TEST_F(RenderTest, EveryKindOfFileHoldsTheSamePicture) {
  const std::vector<std::string> size = {"--size", "48x32"};
  const base::Image exr = render("builtin:furnace", "mobile", "a.exr", size);
  ASSERT_EQ(exr.width, 48);
  ASSERT_EQ(exr.height, 32);
  ASSERT_EQ(exr.channels, 3);
  EXPECT_EQ(render("builtin:furnace", "mobile", "a.pfm", size), exr);
  EXPECT_EQ(render("builtin:furnace", "mobile", "a.PNG", size), render("builtin:furnace", "mobile", "a.png", size));
  const base::Image hdr = render("builtin:furnace", "mobile", "a.hdr", size);
  const base::Image png = render("builtin:furnace", "mobile", "a.png", size);
  for (std::size_t i = 0; i < exr.pixels.size(); ++i) {
    const double linear = exr.pixels[i];
    // RGBE holds 8 bits below the largest channel; IEC 61966-2-1 encodes what a PNG holds.
    EXPECT_NEAR(hdr.pixels[i], linear, linear / 128 + 1e-6);
    const double clamped = std::min(linear, 1.0);
    const double encoded = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
    EXPECT_NEAR(png.pixels[i], encoded, 0.6 / 255);
  }
}

TEST_F(RenderTest, ExposureScalesThePngAlone) {
  const base::Image plain = render("builtin:furnace", "mobile", "plain.exr", {"--size", "32x32"});
  EXPECT_EQ(render("builtin:furnace", "mobile", "ev.exr", {"--size", "32x32", "--exposure", "-1"}), plain);
  const base::Image raw =
      render("builtin:furnace", "mobile", "raw.png", {"--size", "32x32", "--exposure", "-1", "--display", "raw"});
  for (std::size_t i = 0; i < plain.pixels.size(); ++i)
    EXPECT_NEAR(raw.pixels[i], std::min(plain.pixels[i] / 2, 1.f), 0.6 / 255);
}

// A white sphere of radius 0.45 that shows 1 everywhere (roughness 0 in a white environment) before black: with four
// samples its edge takes quarters, and its area is pi 0.45^2.
TEST_F(RenderTest, FourSamplesMakeEdgesOfQuarters) {
  for (const auto& [samples, tolerance] : {std::pair{"1", 0.02}, std::pair{"4", 0.01}}) {
    const base::Image image = render("builtin:furnace", "highend", "edge.exr",
                                     {"--size", "128x128", "--background", "0,0,0", "--samples", samples});
    constexpr double kUnitsPerPixel = 2 * 2.05 / 128; // the scene's orthographic camera
    double area = 0;
    int counts[5] = {};
    for (int y = 0; y < 32; ++y) // roughness 0 is the first sphere of the first row, centred at (-1.5, 1)
      for (int x = 0; x < 32; ++x) {
        const double quarters = image.at(x, y + 17)[0] * 4;
        ASSERT_NEAR(quarters, std::round(quarters), 0.03) << x << "," << y;
        ASSERT_LT(quarters, 4.5) << x << "," << y;
        ++counts[std::lround(quarters)];
        area += quarters / 4 * kUnitsPerPixel * kUnitsPerPixel;
      }
    EXPECT_NEAR(area / (std::numbers::pi * 0.45 * 0.45), 1, tolerance) << samples << " samples";
    for (int q = 1; q < 4; ++q) EXPECT_EQ(counts[q] > 0, std::string(samples) == "4") << q << "/4";
  }
}

TEST_F(RenderTest, SpecularAaIsOffUnlessAskedFor) {
  const std::vector<std::string> options = {"--size", "48x48", "--sun", "30,50,4"};
  const base::Image plain = render("builtin:spheres", "mobile", "a.exr", options);
  EXPECT_EQ(render("builtin:spheres", "mobile", "b.exr", join({options, {"--specular-aa", "off"}})), plain);
  EXPECT_NE(render("builtin:spheres", "mobile", "c.exr", join({options, {"--specular-aa", "toksvig"}})), plain);
}

TEST_F(RenderTest, PathsAndPresetsDiffer) {
  const std::vector<std::string> options = {"--size", "48x48", "--sun", "30,50,4"};
  const base::Image highend = render("builtin:spheres", "highend", "a.exr", options);
  const base::Image ue4 = render("builtin:spheres", "mobile", "b.exr", options);
  const base::Image karis =
      render("builtin:spheres", "mobile", "c.exr", join({options, {"--mobile-preset", "karis2014"}}));
  EXPECT_NE(highend, ue4);
  EXPECT_NE(ue4, karis);
  EXPECT_NE(highend, karis);
}

} // namespace
} // namespace parity::tests
