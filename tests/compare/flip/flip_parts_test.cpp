// What FLIP is made of, each against the standard library or its definition: roots and powers, decoding, filters.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/simd_level.h"
#include "compare/flip/flip.h"
#include "compare/flip/flip_constants.h"
#include "compare/flip/flip_filters.h"
#include "compare/flip/flip_hdr.h"
#include "compare/flip/flip_simd.h"
#include "flip_oracle_hdr.h"
#include "random_images.h"

namespace parity::compare {
namespace {

TEST(FlipParts, TheLargestColorDifferenceIsGreenAgainstBlue) {
  EXPECT_NEAR(static_cast<double>(flip_constants::kMaxColorDifference), oracle::largestColorDifference(), 1e-5);
}

TEST(FlipParts, FiltersSumToWhatTheyMust) {
  const auto sum = [](const std::vector<float>& half) {
    double total = static_cast<double>(half[0]);
    for (std::size_t i = 1; i < half.size(); ++i) total += 2 * static_cast<double>(half[i]);
    return total;
  };
  for (float ppd : {1.f, 10.f, 67.0206451f, 200.f, 1000.f}) {
    const FlipFilters f = makeFlipFilters(ppd);
    EXPECT_NEAR(sum(f.luma), 1, 1e-6) << ppd;
    EXPECT_NEAR(sum(f.redGreen), 1, 1e-6) << ppd;
    EXPECT_NEAR(std::pow(sum(f.blueYellowA), 2) + std::pow(sum(f.blueYellowB), 2), 1, 1e-6) << ppd;
    EXPECT_NEAR(sum(f.gauss), 1, 1e-6) << ppd;
    EXPECT_NEAR(sum(f.point), 0, 1e-6) << ppd;
    double edge = 0;
    for (float w : f.edge) edge += static_cast<double>(w);
    EXPECT_NEAR(edge, -1, 1e-6) << ppd;
    for (const std::vector<float>* half :
         {&f.luma, &f.redGreen, &f.blueYellowA, &f.blueYellowB, &f.gauss, &f.edge, &f.point}) {
      EXPECT_GE(half->size(), 2u) << ppd;
      EXPECT_LE(half->size(), static_cast<std::size_t>(f.radius) + 1) << ppd;
    }
    EXPECT_LE(f.luma.size(), f.gauss.size()) << ppd;
  }
}

TEST(FlipParts, TheFilterRadiusIsTenAtTheDefaultDistance) {
  EXPECT_EQ(flipFilterRadius({}), 10);
  EXPECT_EQ(makeFlipFilters(kDefaultPixelsPerDegree).gauss.size(), 10u); // radius 9
  EXPECT_EQ(flipFilterRadius({.ppd = 120}), 17);                         // ceil(0.13505 * 120 = 16.2)
}

TEST(FlipParts, PixelsPerDegreeOfTheDefaultScreen) {
  EXPECT_FLOAT_EQ(pixelsPerDegree(0.7f, 3840.f, 0.7f), kDefaultPixelsPerDegree);
}

class FlipDecoding : public ::testing::TestWithParam<std::string> {
protected:
  void SetUp() override { base::useSimdLevel(GetParam()); }
  void TearDown() override { base::useSimdLevel(""); }

  // Rows of every length around a vector's, decoded, against the exact planes.
  template <typename Exact>
  static void expectPlanes(const base::Image& image, const RowDecoder& decoder, double tolerance, Exact exact) {
    for (int count : {1, 3, 7, 8, 9, 16, 63, 64, 65, image.width}) {
      std::vector<float> planes[3];
      for (auto& plane : planes) plane.assign(static_cast<std::size_t>(image.width + kMaxSimdStep), 0.f);
      decodeRow(decoder, image.pixels.data(), 3, count, {planes[0].data(), planes[1].data(), planes[2].data()});
      for (int x = 0; x < count; ++x) {
        const float* rgb = image.at(x, 0);
        const oracle::Pixel linear =
            exact({static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2])});
        const oracle::Pixel c = oracle::toYCxCz(linear);
        const double want[] = {(c[0] + 16) / 116, c[1] / 500, c[2] / 200};
        for (std::size_t p = 0; p < 3; ++p)
          ASSERT_NEAR(static_cast<double>(planes[p][static_cast<std::size_t>(x)]), want[p], tolerance)
              << "column " << x << " of " << count << ", plane " << p;
      }
    }
  }
};

TEST_P(FlipDecoding, SrgbIsTheStandardsTransferFunction) {
  const base::Image ramp = [] {
    base::Image image(1000, 1, 3);
    for (int x = 0; x < 1000; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, 0)[c] = static_cast<float>((x * (c + 1)) % 1000) / 999.f;
    return image;
  }();
  expectPlanes(ramp, {}, 4e-7, [](const oracle::Pixel& c) {
    return oracle::Pixel{oracle::decodeSrgb(c[0]), oracle::decodeSrgb(c[1]), oracle::decodeSrgb(c[2])};
  });
}

TEST_P(FlipDecoding, BytesAndTheirFloatsAreDecodedToTheSameBits) {
  base::Image8 bytes(300, 1, 3);
  for (std::size_t i = 0; i < bytes.pixels.size(); ++i) bytes.pixels[i] = static_cast<std::uint8_t>(i * 7);
  base::Image floats(300, 1, 3);
  for (std::size_t i = 0; i < bytes.pixels.size(); ++i)
    floats.pixels[i] = static_cast<float>(bytes.pixels[i]) * (1.f / 255.f);
  std::vector<float> a(3 * 400), b(3 * 400);
  decodeRow(bytes.pixels.data(), 3, 300, {a.data(), a.data() + 400, a.data() + 800});
  decodeRow(RowDecoder{}, floats.pixels.data(), 3, 300, {b.data(), b.data() + 400, b.data() + 800});
  for (std::size_t i = 0; i < 300; ++i)
    for (std::size_t p = 0; p < 3; ++p) ASSERT_EQ(a[400 * p + i], b[400 * p + i]) << i;
}

TEST_P(FlipDecoding, ToneCurvesAreTheDefinitions) {
  const base::Image image = test::makeHdrImage(500, 1, 3);
  for (Tonemapper tonemapper : {Tonemapper::aces, Tonemapper::hable, Tonemapper::reinhard})
    for (float exposure : {0.01f, 1.f, 40.f}) {
      RowDecoder decoder = makeRowDecoder(tonemapper);
      decoder.exposure = exposure;
      expectPlanes(image, decoder, 1e-6, [&](oracle::Pixel c) {
        for (double& v : c) v *= static_cast<double>(exposure);
        oracle::Pixel shown = oracle::tonemap(tonemapper, c);
        for (double& v : shown) v = std::clamp(v, 0., 1.);
        return shown;
      });
    }
}

// Where a value overflows when exposed, or is negative: still numbers; and black stays black.
TEST_P(FlipDecoding, NoValueBecomesNanAtAnyExposure) {
  base::Image image(64, 1, 3);
  const float values[] = {0, -0.f, 1e-40f, 3e38f, -3e38f, -1, 1e10f};
  for (std::size_t i = 3; i < image.pixels.size(); ++i) image.pixels[i] = values[(i * i + i / 3) % 7];
  for (Tonemapper tonemapper : {Tonemapper::aces, Tonemapper::hable, Tonemapper::reinhard})
    for (float ev : {-kMaxExposureEv, 0.f, 17.f, kMaxExposureEv}) {
      RowDecoder decoder = makeRowDecoder(tonemapper);
      decoder.exposure = std::exp2(ev);
      std::vector<float> planes(3 * 192);
      decodeRow(decoder, image.pixels.data(), 3, 64, {planes.data(), planes.data() + 192, planes.data() + 384});
      for (float v : planes) ASSERT_TRUE(std::isfinite(v)) << ev;
      for (std::size_t p = 0; p < 3; ++p) ASSERT_EQ(planes[192 * p], 0.f) << ev; // the first pixel
    }
}

INSTANTIATE_TEST_SUITE_P(SimdLevels, FlipDecoding, ::testing::ValuesIn(base::simdLevels()),
                         [](const auto& instance) { return instance.param; });

TEST(FlipParts, AnUnknownSimdLevelIsAUsageError) {
  EXPECT_THROW(base::useSimdLevel("AVX9"), base::Error);
  EXPECT_FALSE(base::simdLevels().empty());
}

} // namespace
} // namespace parity::compare
