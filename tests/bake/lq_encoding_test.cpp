// The mobile lightmap's 8 bits: how exact, what black and constant texels become, and what ASTC adds.
#include "bake/encode/lq_encoding.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "bake/lightmap_pages.h"
#include "base/parallel.h"

namespace parity::bake {
namespace {

using glm::dvec3;

constexpr double kHalfStep = 0.023; // of L + 2^-8: 2^(16 / 510) - 1 = .0220, and float's last bits
const LqOptions kPlain{.block = base::AstcBlock::none};

double relativeError(double L, double truth) { return std::abs(L - truth) / (truth + 1.0 / 256); }

// L, evenly over the 16 stops of the logarithm, black included.
double luminanceAt(double stop) { return std::exp2(stop - 8) - 1.0 / 256; }

// 64 x 64 texels of one instance. Every hue within the triangle of the primaries, all of its edge, at any of the stops.
std::vector<LightmapPage> makeColors(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<LightmapPage> pages = {makePage(64, 64)};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      dvec3 hue(uniform(random), uniform(random), uniform(random));
      if (y % 2 == 0) hue[x % 3] = 0;       // saturated
      if (y % 4 == 0) hue[(x + 1) % 3] = 0; // a primary
      setEven(pages[0], x, y, 0, hue * (luminanceAt(16 * uniform(random)) / std::max(lumaOf(hue), 1e-9)));
    }
  return pages;
}

double largestError(const std::vector<LightmapPage>& pages, const LqLightmap& lightmap) {
  double largest = 0;
  for (int y = 0; y < pages[0].owner.height; ++y)
    for (int x = 0; x < pages[0].owner.width; ++x) {
      const float* e = pages[0].irradiance.at(x, y);
      const double L = lumaOf({e[0], e[1], e[2]}) / (.282095 * kTestPi);
      largest = std::max(largest, relativeError(decodeTexel(lightmap.pages[0], x, y, lightmap.instances[0]).L, L));
    }
  return largest;
}

TEST(LqEncoding, KeepsGreysOverSixteenStopsWithinHalfAStep) {
  constexpr int kWide = 1024;
  std::vector<LightmapPage> pages = {makePage(kWide, 1)};
  for (int x = 0; x < kWide; ++x) setEven(pages[0], x, 0, 0, dvec3(luminanceAt(16.0 * x / (kWide - 1))));
  const LqLightmap lightmap = encodeLq(pages, 1, kPlain);
  const double largest = largestError(pages, lightmap);
  EXPECT_LE(largest, kHalfStep);
  EXPECT_GE(largest, 0.01); // 8 bits it is, and green's step is .59 of a grey's
  EXPECT_EQ(decodeTexel(lightmap.pages[0], 0, 0, lightmap.instances[0]).color, dvec3(0));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(lightmap.instances[0].colorAdd[c], 0);
}

TEST(LqEncoding, KeepsTheLuminanceOfAnyColourWithinHalfAStep) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const std::vector<LightmapPage> pages = makeColors(seed);
    LqLightmap lightmap = encodeLq(pages, 1, kPlain);
    EXPECT_LE(largestError(pages, lightmap), kHalfStep);

    // Each channel rounded for itself: what the joint choice is for.
    const LqScales& scales = lightmap.instances[0];
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const float* e = pages[0].irradiance.at(x, y);
        const dvec3 color = dvec3(e[0], e[1], e[2]) / (.282095 * kTestPi);
        const double L = lumaOf(color);
        for (int c = 0; c < 3; ++c)
          lightmap.pages[0].at(x, y)[c] = static_cast<std::uint8_t>(
              std::clamp(std::round((color[c] * (std::log2(L + 1.0 / 256) + 8) / 16 / L - scales.colorAdd[c]) /
                                    scales.colorScale[c] * 255),
                         0.0, 255.0));
      }
    EXPECT_GE(largestError(pages, lightmap), 1.5 * kHalfStep);
  }
}

// What green gives for luminance costs little hue: of E relative to its luminance.
TEST(LqEncoding, KeepsHuesWithinAFewSteps) {
  const LqLightmap lightmap = encodeLq(makeColors(1), 1, kPlain);
  EXPECT_LE(lightmap.figures.quantized.rms, 0.032); // of each channel for itself
  EXPECT_EQ(lightmap.figures.quantized.rms, lightmap.figures.stored.rms);
}

TEST(LqEncoding, HasScalesOfEachInstanceAndExactEnds) {
  std::vector<LightmapPage> pages = {makePage(8, 8), makePage(8, 8)};
  setEven(pages[0], 1, 1, 0, dvec3(0));
  setEven(pages[0], 2, 1, 0, {3, 2, 1});
  setEven(pages[1], 1, 1, 2, {.5, .25, .125});
  const LqLightmap lightmap = encodeLq(pages, 3, kPlain);
  ASSERT_EQ(lightmap.instances.size(), 3u);
  EXPECT_EQ(lightmap.instances[0].colorAdd.x, 0);
  const LqScales &none = lightmap.instances[1], &constant = lightmap.instances[2];
  EXPECT_EQ(none.colorScale, glm::vec4(0));
  EXPECT_EQ(none.colorAdd, glm::vec4(0));
  EXPECT_EQ(constant.colorScale, glm::vec4(0));
  EXPECT_EQ(constant.directionScale, glm::vec4(0));
  EXPECT_NEAR(constant.directionAdd.w, .282095f, 1e-6);
  const DecodedTexel exact[] = {decodeTexel(lightmap.pages[0], 2, 1, lightmap.instances[0]),
                                decodeTexel(lightmap.pages[1], 1, 1, constant)};
  const dvec3 expected[] = {{3, 2, 1}, {.5, .25, .125}};
  for (int i = 0; i < 2; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(exact[i].color[c], expected[i][c], 1e-5 * expected[i][c]);
}

// A light from one direction over a plane and a normal map: radiance follows S(n) / S(N0).
TEST(LqEncoding, BendsWithTheNormalAsTheShDo) {
  std::mt19937 random(5);
  std::normal_distribution<double> gauss;
  const auto direction = [&] { return glm::normalize(dvec3(gauss(random), gauss(random), gauss(random))); };
  std::vector<LightmapPage> pages = {makePage(32, 32)};
  std::vector<dvec3> sources, normals;
  std::vector<double> l0s, ratios;
  for (int i = 0; i < 1024; ++i) {
    normals.push_back(direction());
    sources.push_back(direction());
    if (glm::dot(sources[i], normals[i]) < 0) sources[i] = -sources[i];
    l0s.push_back(std::exp2(i % 12 - 6));
    ratios.push_back((i % 100) / 100.0); // how much of it comes from one direction
    setTexel(pages[0], i % 32, i / 32, 0, dvec3(2, 1, .5) * l0s[i], l0s[i],
             sources[i] * (std::sqrt(3.0) * ratios[i] * l0s[i]), normals[i]);
  }
  const LqLightmap lightmap = encodeLq(pages, 1, kPlain);
  for (int i = 0; i < 1024; ++i) {
    const DecodedTexel texel = decodeTexel(lightmap.pages[0], i % 32, i / 32, lightmap.instances[0]);
    const auto S = [&](const dvec3& n) {
      return .282095 * l0s[i] + .325735 * glm::dot(sources[i], n) * std::sqrt(3.0) * ratios[i] * l0s[i];
    };
    for (const dvec3& n : {normals[i], sources[i], direction()}) {
      const double expected = 2 * l0s[i] / kTestPi * std::max(0.0, S(n)) / S(normals[i]);
      // A step of LogL and, of S / l0, three half steps of its components (at most 2 x .564 / 255 each).
      const double step = .05 * expected + 3 * .0023 * 2 * l0s[i] * l0s[i] / kTestPi / S(normals[i]);
      ASSERT_NEAR(texel.at(n).r, expected, step + .05 / 256) << i;
    }
  }
}

TEST(LqEncoding, OfLightFromBehindTheNormalIsWhatArrivesBeforeIt) {
  std::vector<LightmapPage> pages = {makePage(4, 4)};
  setTexel(pages[0], 0, 0, 0, dvec3(1), 1, {0, -std::sqrt(3.0), 0}, {0, 1, 0});
  setTexel(pages[0], 1, 0, 0, dvec3(1), 0, {0, 0, 0}, {0, 1, 0}); // no SH, yet irradiance
  const LqLightmap lightmap = encodeLq(pages, 1, kPlain);
  const DecodedTexel behind = decodeTexel(lightmap.pages[0], 0, 0, lightmap.instances[0]),
                     even = decodeTexel(lightmap.pages[0], 1, 0, lightmap.instances[0]);
  EXPECT_TRUE(std::isfinite(behind.L));
  EXPECT_NEAR(behind.at({0, 1, 0}).r, 1 / kTestPi, .03);
  EXPECT_GT(behind.at({0, -1, 0}).r, 2 / kTestPi); // there is more behind
  EXPECT_NEAR(even.at({0, 1, 0}).r, 1 / kTestPi, .05);
}

// Two objects' soft gradients, and a page whose texels are owned in stripes of 5, apart by 3.
LightmapPage makeScene(bool striped) {
  LightmapPage page = makePage(96, 96);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      if (striped && (x % 8 >= 5 || y % 8 >= 5)) continue;
      const double u = x / 95.0, v = y / 95.0, L = .02 + 2 * std::pow(std::sin(3 * u + 2 * v), 2);
      const dvec3 l1(.8 * std::sin(2 * u), .5 + .3 * v, .8 * std::cos(3 * v));
      setTexel(page, x, y, y < 48 ? 0 : 1, dvec3(1, .8 + .1 * u, .6 + .2 * v) * L, L, l1 * L, {0, 1, 0});
    }
  return page;
}

TEST(LqEncoding, StatesWhatAstcCosts) {
  const std::vector<LightmapPage> pages = {makeScene(false)};
  const LqLightmap plain = encodeLq(pages, 2, kPlain), fine = encodeLq(pages, 2, {base::AstcBlock::astc4x4}),
                   coarse = encodeLq(pages, 2, {base::AstcBlock::astc6x6});
  EXPECT_TRUE(std::isinf(plain.figures.colorDb));
  EXPECT_GT(fine.figures.colorDb, 40);
  EXPECT_GT(coarse.figures.colorDb, 34);
  EXPECT_GT(fine.figures.colorDb, coarse.figures.colorDb);
  EXPECT_GT(fine.figures.directionDb, coarse.figures.directionDb);
  EXPECT_GT(coarse.figures.directionDb, 34);
  EXPECT_LT(plain.figures.stored.rms, fine.figures.stored.rms);
  EXPECT_LT(fine.figures.stored.rms, coarse.figures.stored.rms);
  EXPECT_EQ(fine.figures.quantized.rms, plain.figures.stored.rms);

  // The figures, once more from the pictures.
  double squares = 0, errors = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const dvec3 decoded = decodeTexel(coarse.pages[0], x, y, coarse.instances[y < 48 ? 0 : 1]).at({0, 1, 0});
      const float* e = pages[0].irradiance.at(x, y);
      const dvec3 truth(e[0], e[1], e[2]);
      for (int c = 0; c < 3; ++c) {
        squares += std::pow(double(coarse.pages[0].at(x, y)[c]) - plain.pages[0].at(x, y)[c], 2);
        errors += std::pow((decoded[c] * kTestPi - truth[c]) / (lumaOf(truth) + kTestPi / 256), 2);
      }
    }
  EXPECT_NEAR(coarse.figures.colorDb, 10 * std::log10(255 * 255 * 96 * 96 * 3 / squares), 1e-6);
  EXPECT_NEAR(coarse.figures.stored.rms, std::sqrt(errors / (96 * 96 * 3)), 1e-6);
}

// Texels that nobody owns lie between the stripes: they may cost those beside them hardly anything.
TEST(LqEncoding, LosesHardlyMoreBesideTexelsOfNobody) {
  for (const base::AstcBlock block : {base::AstcBlock::astc4x4, base::AstcBlock::astc6x6}) {
    const LqFigures whole = encodeLq({makeScene(false)}, 2, {block}).figures,
                    striped = encodeLq({makeScene(true)}, 2, {block}).figures;
    EXPECT_GT(striped.colorDb, whole.colorDb - 2);
    EXPECT_GT(striped.directionDb, whole.directionDb - 3);
  }
}

TEST(LqEncoding, IsTheSameForAnyNumberOfThreads) {
  const std::vector<LightmapPage> pages = {makeScene(true)};
  const LqLightmap expected = encodeLq(pages, 2, {});
  const base::ThreadLimit one(1);
  const LqLightmap again = encodeLq(pages, 2, {});
  EXPECT_EQ(again.pages, expected.pages);
}

TEST(LqEncoding, OfAPageWithoutOwnersIsEmpty) {
  const LqLightmap lightmap = encodeLq({makePage(8, 4)}, 1, {});
  EXPECT_EQ(lightmap.pages[0].width, 8);
  EXPECT_EQ(lightmap.pages[0].height, 8);
  EXPECT_EQ(lightmap.figures.stored.rms, 0);
  EXPECT_TRUE(std::isinf(lightmap.figures.colorDb));
}

} // namespace
} // namespace parity::bake
