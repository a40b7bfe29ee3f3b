// SSIM and MS-SSIM against their definitions in double precision, pixel by pixel, and closed forms.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "compare/metrics/measure.h"
#include "compare/metrics/ssim_maps.h"
#include "compare/pooling/region.h"

namespace parity::compare {
namespace {

constexpr double kC1 = 1e-4, kC2 = 9e-4;

struct Planar {
  int width, height;
  std::vector<double> values;
  double at(int x, int y) const { // mirrored, the edge's own pixel repeated
    const auto mirror = [](int i, int n) {
      while (i < 0 || i >= n) i = i < 0 ? -1 - i : 2 * n - 1 - i;
      return i;
    };
    return values[static_cast<std::size_t>(mirror(y, height)) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(mirror(x, width))];
  }
};

Planar planarOf(const base::Image& luma) { return {luma.width, luma.height, {luma.pixels.begin(), luma.pixels.end()}}; }

struct Local {
  double ssim, structure;
};

// Wang 2004, equations 13-16: weighted means, variances and covariance of an 11x11 window.
Local compareWindow(const Planar& a, const Planar& b, int x, int y) {
  double total = 0, ma = 0, mb = 0;
  const auto forWindow = [&](const auto& body) {
    for (int v = -5; v <= 5; ++v)
      for (int u = -5; u <= 5; ++u) body(std::exp(-(u * u + v * v) / 4.5), a.at(x + u, y + v), b.at(x + u, y + v));
  };
  forWindow([&](double w, double p, double q) { total += w, ma += w * p, mb += w * q; });
  ma /= total, mb /= total;
  double va = 0, vb = 0, covariance = 0;
  forWindow([&](double w, double p, double q) {
    va += w * (p - ma) * (p - ma);
    vb += w * (q - mb) * (q - mb);
    covariance += w * (p - ma) * (q - mb);
  });
  va /= total, vb /= total, covariance /= total;
  const double structure = (2 * covariance + kC2) / (va + vb + kC2);
  return {structure * (2 * ma * mb + kC1) / (ma * ma + mb * mb + kC1), structure};
}

base::Image randomLuma(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  base::Image image(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      *image.at(x, y) = 0.7f * (0.5f + 0.5f * std::sin(0.2f * static_cast<float>(x + 2 * y))) +
                        0.3f * static_cast<float>(random() % 256) / 255.f;
  return image;
}

base::Image rgbOf(const base::Image& luma) {
  base::Image out(luma.width, luma.height, 3);
  for (std::size_t i = 0; i < luma.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) out.pixels[3 * i + c] = luma.pixels[i];
  return out;
}

TEST(Ssim, IsTheDefinitionInEveryPixelOfAnySize) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, std::pair{3, 2}, std::pair{11, 11}, std::pair{40, 7}, std::pair{207, 83}}) {
    const base::Image a = randomLuma(width, height, 1), b = randomLuma(width, height, 2);
    const SsimMaps maps = ssimMaps(a, b, {0, 0, width, height});
    const Planar pa = planarOf(a), pb = planarOf(b);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Local exact = compareWindow(pa, pb, x, y);
        ASSERT_NEAR(static_cast<double>(*maps.ssim.at(x, y)), exact.ssim, 1e-5) << x << ", " << y << " of " << width;
        ASSERT_NEAR(static_cast<double>(*maps.structure.at(x, y)), exact.structure, 1e-5) << x << ", " << y;
      }
  }
}

// Flat and nearly flat images: the variances cancel to nothing there.
TEST(Ssim, KeepsItsDigitsInFlatFields) {
  base::Image a(40, 40, 1, 0.9f), b = a;
  std::mt19937 random(3);
  for (float& v : b.pixels) v += static_cast<float>(random() % 3) / 255.f - 1.f / 255.f;
  const SsimMaps maps = ssimMaps(a, b, {0, 0, 40, 40});
  const Planar pa = planarOf(a), pb = planarOf(b);
  for (int i = 0; i < 40; ++i)
    EXPECT_NEAR(static_cast<double>(*maps.ssim.at(i, i)), compareWindow(pa, pb, i, i).ssim, 1e-4);
}

TEST(Ssim, OfConstantImagesIsTheLuminanceTerm) {
  const base::Image a(20, 20, 1, 0.25f), b(20, 20, 1, 0.75f);
  const double expected = (2 * 0.25 * 0.75 + kC1) / (0.25 * 0.25 + 0.75 * 0.75 + kC1);
  for (const float v : ssimMaps(a, b, {0, 0, 20, 20}).ssim.pixels) EXPECT_NEAR(static_cast<double>(v), expected, 1e-6);
}

TEST(Ssim, OfANegativeIsNegativeAndOfIdenticalImagesExactlyOne) {
  const base::Image a = randomLuma(64, 64, 4);
  base::Image negative = a;
  for (float& v : negative.pixels) v = 1.f - v;
  for (const float v : ssimMaps(a, a, {0, 0, 64, 64}).ssim.pixels) EXPECT_EQ(v, 1.f);
  const base::Image ra = rgbOf(a), rn = rgbOf(negative);
  EXPECT_LT(measureRegions({ra, rn}, {wholeImage(64, 64)}, {.metrics = {"ssim"}}).regions[0].find("ssim.mean"), -0.2);
}

TEST(Ssim, RegionsPoolTheMapOfLuma) {
  const base::Image a = randomLuma(60, 50, 5), b = randomLuma(60, 50, 6), ra = rgbOf(a), rb = rgbOf(b);
  const base::PixelList list{"m", {1, 2, 700, 2999}, {1.f, 0.5f, 0.25f, 1.f}};
  const Figures f = measureRegions({ra, rb}, {list}, {.metrics = {"ssim"}}).regions[0];
  const Planar pa = planarOf(a), pb = planarOf(b);
  double sum = 0, total = 0, least = 1;
  for (std::size_t i = 0; i < list.pixels.size(); ++i) {
    const int pixel = static_cast<int>(list.pixels[i]);
    const double value = compareWindow(pa, pb, pixel % 60, pixel / 60).ssim;
    sum += static_cast<double>(list.weights[i]) * value;
    total += static_cast<double>(list.weights[i]);
    least = std::min(least, value);
  }
  EXPECT_NEAR(f.find("ssim.mean").value(), sum / total, 1e-5);
  EXPECT_NEAR(f.find("ssim.min").value(), least, 1e-5);
  EXPECT_NEAR(f.find("ssim.p05").value(), least, 1e-5);
}

Planar halve(const Planar& in) {
  Planar out{(in.width + 1) / 2, (in.height + 1) / 2, {}};
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      out.values.push_back(
          (in.at(2 * x, 2 * y) + in.at(2 * x + 1, 2 * y) + in.at(2 * x, 2 * y + 1) + in.at(2 * x + 1, 2 * y + 1)) / 4);
  return out;
}

// Wang 2003, equation 7 with the exponents of section 4, of the first `scales` scales; the weights of a region shrink
// by the same means of 2x2.
double multiScale(Planar a, Planar b, Planar weights, std::size_t scales) {
  constexpr std::array<double, 5> kExponents = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
  double used = 0, all = 0, product = 1;
  for (std::size_t i = 0; i < 5; ++i) all += kExponents[i], used += i < scales ? kExponents[i] : 0;
  for (std::size_t scale = 0; scale < scales; ++scale) {
    if (scale > 0) a = halve(a), b = halve(b), weights = halve(weights);
    double sum = 0, total = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) {
        const double weight = weights.at(x, y);
        if (weight == 0) continue;
        const Local local = compareWindow(a, b, x, y);
        sum += weight * (scale + 1 == scales ? local.ssim : local.structure);
        total += weight;
      }
    product *= std::pow(std::max(sum / total, 0.), kExponents[scale] * all / used);
  }
  return product;
}

struct Size {
  int width, height;
  std::size_t scales;
};

TEST(MsSsim, IsTheDefinitionAtFiveScalesAndAtTheFewerThatFit) {
  for (const Size& size : {Size{181, 177, 5}, Size{176, 176, 5}, Size{175, 190, 4}, Size{50, 45, 3}, Size{23, 22, 2},
                           Size{21, 30, 1}, Size{2, 5, 1}}) {
    const base::Image a = randomLuma(size.width, size.height, 7), b = randomLuma(size.width, size.height, 8);
    const base::Image ra = rgbOf(a), rb = rgbOf(b);
    const Planar everywhere{size.width, size.height, std::vector<double>(a.pixels.size(), 1.)};
    const Figures f =
        measureRegions({ra, rb}, {wholeImage(size.width, size.height)}, {.metrics = {"msssim"}}).regions[0];
    EXPECT_NEAR(f.find("msssim").value(), multiScale(planarOf(a), planarOf(b), everywhere, size.scales), 1e-5)
        << size.width << " x " << size.height;
  }
}

TEST(MsSsim, OfARegionWeighsEachScaleByTheRegionsShareOfItsPixels) {
  const int width = 95, height = 93;
  const base::Image a = randomLuma(width, height, 9), b = randomLuma(width, height, 10), ra = rgbOf(a), rb = rgbOf(b);
  std::mt19937 random(11);
  for (const bool weighted : {false, true}) {
    base::PixelList list{"m", {}, {}};
    Planar weights{width, height, std::vector<double>(a.pixels.size(), 0.)};
    for (std::uint32_t pixel = 0; pixel < a.pixels.size(); ++pixel) {
      const std::uint32_t x = pixel % width, y = pixel / width;
      if (x < 30 || y < 41 || random() % 4 == 0) continue; // down to the far corner, with holes
      list.pixels.push_back(pixel);
      const float weight = weighted ? static_cast<float>(1 + random() % 4) / 4.f : 1.f;
      if (weighted) list.weights.push_back(weight);
      weights.values[pixel] = static_cast<double>(weight);
    }
    const Figures f = measureRegions({ra, rb}, {list}, {.metrics = {"msssim"}}).regions[0];
    EXPECT_NEAR(f.find("msssim").value(), multiScale(planarOf(a), planarOf(b), weights, 4), 1e-5);
  }
}

TEST(MsSsim, OfIdenticalImagesIsOneAndOfANegativeZero) {
  const base::Image a = randomLuma(180, 180, 12), ra = rgbOf(a);
  base::Image negative = ra;
  for (float& v : negative.pixels) v = 1.f - v;
  const MeasureRequest request{.metrics = {"msssim"}};
  EXPECT_EQ(measureRegions({ra, ra}, {wholeImage(180, 180)}, request).regions[0].find("msssim"), 1);
  EXPECT_EQ(measureRegions({ra, negative}, {wholeImage(180, 180)}, request).regions[0].find("msssim"), 0);
}

} // namespace
} // namespace parity::compare
