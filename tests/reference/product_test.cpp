// Sampling by the product of light and lobe: sums, bounds, and the density that it claims.
#include "reference/product_sampler.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "reference/environment_sampler.h"
#include "reference/linear_control.h"
#include "reference/surroundings.h"
#include "shading/shading.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

std::vector<double> evenRows(int height) {
  std::vector<double> rows;
  for (int y = 0; y <= height; ++y) rows.push_back(std::cos(pi * y / height));
  return rows;
}

TEST(LightPyramid, AddsUpToTheWholeForAnySize) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform;
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 5), std::pair(16, 8), std::pair(33, 16)}) {
    const std::vector<double> rows = evenRows(height);
    std::vector<glm::vec4> cells;
    double sum = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        cells.emplace_back(0, 0, 0, uniform(random));
        sum += static_cast<double>(cells.back().w) * (rows[y] - rows[y + 1]) * 2 * pi / width;
      }
    const LightPyramid light(width, height, cells, rows);
    EXPECT_NEAR(light.power(light.whole()), sum, 1e-14 * sum) << width;
    EXPECT_EQ(light.power({0, width, 0}), 0);
    EXPECT_EQ(light.power({0, 0, height}), 0);
  }
}

TEST(LightPyramid, NoDirectionOfABlockIsFartherFromItsMiddleThanItsRadius) {
  constexpr int kWidth = 37, kHeight = 18;
  const std::vector<glm::vec4> cells(kWidth * kHeight, glm::vec4(1));
  const LightPyramid light(kWidth, kHeight, cells, evenRows(kHeight));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  for (int level = -3; level <= light.whole().level; ++level) {
    double used = 0;
    for (int i = 0; i < 4000; ++i) {
      const double across = uniform(random) * kWidth, down = uniform(random) * kHeight, u = uniform(random);
      const PanoramaBlock part{-3, static_cast<int>(across * 8), static_cast<int>(down * 8)};
      const PanoramaBlock block{level, part.x >> (level + 3), part.y >> (level + 3)};
      const BlockFrame frame = light.frame(block);
      const double angle =
          std::acos(std::clamp(glm::dot(light.directionIn(part, {u, 1 - u}), frame.middle), -1.0, 1.0));
      ASSERT_LE(angle, frame.radius + 1e-7) << "level " << level << ", row " << block.y;
      used = std::max(used, angle / frame.radius);
    }
    EXPECT_GT(used, 0.4) << "level " << level;
  }
}

// Of a sky whose radiance is a linear function: the moments of blocks of any level are the sums of their parts'.
TEST(LightPyramid, MomentsAreIntegralsOfRadianceTimesDirection) {
  constexpr int kWidth = 16, kHeight = 8;
  const std::vector<double> rows = evenRows(kHeight);
  std::vector<glm::vec4> cells;
  for (int i = 0; i < kWidth * kHeight; ++i) cells.emplace_back(1 + i % 5, 2 + i % 7, 3, 1);
  const LightPyramid light(kWidth, kHeight, cells, rows);
  for (const PanoramaBlock& block : {PanoramaBlock{-1, 7, 3}, PanoramaBlock{0, 5, 1}, PanoramaBlock{2, 1, 1}}) {
    const int parts = 1 << (block.level + 4); // sub-blocks of level -4, along either axis
    glm::dvec3 sum(0.0), x(0.0), y(0.0), z(0.0);
    for (int j = block.y * parts; j < (block.y + 1) * parts; ++j)
      for (int i = block.x * parts; i < (block.x + 1) * parts; ++i) {
        const PanoramaBlock cell = LightPyramid::cellOf({-4, i, j});
        const double area = (rows[cell.y] - rows[cell.y + 1]) * 2 * pi / kWidth / 256;
        const glm::dvec3 d = light.directionIn({-4, i, j}, {0.5, 0.5});
        const glm::dvec3 L(cells[static_cast<std::size_t>(cell.y * kWidth + cell.x)]);
        sum += area * L, x += area * d.x * L, y += area * d.y * L, z += area * d.z * L;
      }
    const PanoramaBlock cell = block.level <= 0 ? LightPyramid::cellOf(block) : PanoramaBlock();
    const LightMoments moments = light.moments(block, cells[static_cast<std::size_t>(cell.y * kWidth + cell.x)]);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(moments.light[c], sum[c], 1e-6 * sum[c]);
      EXPECT_NEAR(moments.x[c], x[c], 2e-4 * sum[c]); // the sum takes the middle of its parts
      EXPECT_NEAR(moments.y[c], y[c], 2e-4 * sum[c]);
      EXPECT_NEAR(moments.z[c], z[c], 2e-4 * sum[c]);
    }
  }
}

ProductLobe makeLobe(double NoV, double alpha, double lambert) {
  return {.normal = {0, 1, 0},
          .view = {std::sqrt(1 - NoV * NoV), NoV, 0},
          .alpha = alpha,
          .F0 = 0.5,
          .F90 = 1,
          .lambert = lambert};
}

// Of samples in blocks of 16 x 16 cells: chi^2 within 5 sigma; the density integrates to 1; every sample lies in its
// cell.
TEST(ProductSampler, SamplesFollowTheDensityThatTheyCarry) {
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  constexpr int kBlock = 16, kColumns = tests::kPanoramaWidth / kBlock, kRows = tests::kPanoramaHeight / kBlock;
  constexpr int kCount = 200000;
  for (const ProductLobe& lobe : {makeLobe(0.8, 0.3, 0), makeLobe(0.2, 0.05, 0.3), makeLobe(0.6, 1, 0)}) {
    const ProductSampler product(sky.light(), lobe);
    std::vector<double> expected(kRows * kColumns, 0.0), seen(kRows * kColumns, 0.0);
    double total = 0;
    for (int y = 0; y < tests::kPanoramaHeight; ++y)
      for (int x = 0; x < tests::kPanoramaWidth; ++x) {
        double mass = 0; // cells may be divided further
        for (int part = 0; part < 64 * 64; ++part) {
          const std::uint32_t node = product.nodeOf({x + (part % 64 + 0.5) / 64, y + (part / 64 + 0.5) / 64});
          if (product.nodes()[node].block.level >= 0) {
            mass = product.gain(node) * sky.light().power({0, x, y});
            break;
          }
          mass += product.gain(node) * sky.light().power({0, x, y}) / 4096;
        }
        total += mass;
        expected[static_cast<std::size_t>(y / kBlock * kColumns + x / kBlock)] += kCount * mass;
        if (tests::cellDirection(x, y).y > 0.01) {
          ASSERT_GT(mass, 0) << x << ", " << y;
        }
      }
    EXPECT_NEAR(total, 1, 1e-9);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < kCount; ++i) {
      const double u = uniform(random), v = uniform(random);
      const ProductSampler::Sample s = product.sample({u, v});
      ASSERT_NEAR(glm::length(s.direction), 1, 1e-12);
      if (i < 1000) {
        const glm::dvec2 place = sky.placeOf(s.direction);
        ASSERT_EQ(glm::ivec2(place), glm::ivec2(s.x, s.y));
        ASSERT_EQ(product.nodeOf(place), s.node);
      }
      ++seen[static_cast<std::size_t>(s.y / kBlock * kColumns + s.x / kBlock)];
    }
    double chi2 = 0;
    int blocks = 0;
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (expected[i] > 10) chi2 += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i], ++blocks;
    ASSERT_GT(blocks, 50);
    EXPECT_LT(std::abs(chi2 - blocks), 5 * std::sqrt(2.0 * blocks)) << blocks;
  }
}

// What it is for: of points taken by it, hardly any two count differently.
TEST(ProductSampler, SamplesCountNearlyAlike) {
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  for (const float roughness : {0.2f, 0.5f, 1.f}) {
    SurfaceSample sample = tests::makePoint(0.7, roughness, 1);
    const Lobes lobes(sample, tests::plainModel(), roughness, nullptr);
    const double alpha = double(roughness) * double(roughness);
    const ProductSampler product(sky.light(),
                                 {.normal = {0, 1, 0}, .view = sample.view, .alpha = alpha, .F0 = 1, .F90 = 1});
    double sum = 0, squares = 0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
      const double u = uniform(random), v = uniform(random);
      const ProductSampler::Sample s = product.sample({u, v});
      const glm::dvec3 L(s.direction.x, -s.direction.z, s.direction.y), V(sample.view.x, 0, sample.view.y);
      const double value = L.z > 0 ? lobes.evaluate(V, L, {}).specular.y / product.gain(s.node) : 0;
      sum += value / kCount;
      squares += value * value / kCount;
    }
    RecordProperty("spread", std::to_string(std::sqrt(squares / (sum * sum) - 1)));
    EXPECT_LT(std::sqrt(squares / (sum * sum) - 1), 0.6) << roughness;
  }
}

// A lobe, asked for four directions at once.
template <typename Lobe> LinearControl::Lobe inFours(const Lobe& lobe) {
  return [lobe](const FourDirections& d) {
    std::array<Float4, 3> values;
    for (int i = 0; i < 4; ++i) {
      const glm::dvec3 value = lobe(glm::dvec3(d.x[i], d.y[i], d.z[i]));
      for (int c = 0; c < 3; ++c) values[static_cast<std::size_t>(c)][i] = static_cast<float>(value[c]);
    }
    return values;
  };
}

// What decides where samples go and what the control is, against the lobe itself.
TEST(LinearControl, FitsToWhatTheLobeIs) {
  for (const auto& [term, curve] : {std::pair(GeometryTerm::heightCorrelated, FresnelCurve::schlick),
                                    std::pair(GeometryTerm::schlickSmith, FresnelCurve::dielectric)}) {
    const Model model{.surface = {.geometryTerm = term, .fresnel = curve}};
    const DirectionalAlbedo albedo(term, curve);
    for (const float roughness : {0.03f, 0.3f, 1.f}) {
      SurfaceSample sample = tests::makePoint(0.6, roughness, 0.5f);
      sample.baseColor = {0.9f, 0.5f, 0.1f};
      const Lobes lobes(sample, model, roughness, &albedo);
      const glm::dvec3 view(0.8, 0, 0.6);
      const LobeView atView = lobes.viewAt(view.z);
      for (int i = 0; i < 8; ++i) {
        FourDirections four;
        std::array<glm::dvec3, 4> directions;
        for (int k = 0; k < 4; ++k) { // about the mirror image of the view
          const glm::dvec3 beside(0, std::sin(2.4 * k), std::cos(2.4 * k));
          directions[k] = glm::normalize(glm::dvec3(-0.8, 0, 0.6) + 0.07 * i * beside);
          if (directions[k].z < 0.05) directions[k] = {-0.8, 0, 0.6};
          for (int c = 0; c < 3; ++c)
            (c == 0 ? four.x : c == 1 ? four.y : four.z)[k] = static_cast<float>(directions[k][c]);
        }
        const std::array<Float4, 3> estimate = lobes.estimateSpecular(four, {0, 0, 1}, glm::vec3(view), atView);
        for (int k = 0; k < 4; ++k) {
          const glm::dvec3 exact = lobes.evaluate(view, directions[k], atView).specular;
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(estimate[static_cast<std::size_t>(c)][k], exact[c], 1e-2 * exact[c] + 1e-4)
                << roughness << ", " << i << ", " << k;
        }
      }
    }
  }
}

// Of a lobe that is linear, the control is the lobe wherever it is fitted, and its integral is that of light times
// control: by sampling.
TEST(LinearControl, KnowsItsIntegral) {
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  for (const double alpha : {0.01, 0.2, 1.0}) {
    const ProductLobe lobe = makeLobe(0.7, alpha, 0);
    const ProductSampler product(sky.light(), lobe);
    const auto linear = [](const glm::dvec3& d) { return glm::dvec3(d.y, 0.3 + d.x, 2 * d.z - d.y); };
    const LinearControl exact(sky, product, lobe.normal, inFours(linear));
    const auto peaked = [&](const glm::dvec3& d) {
      return glm::dvec3(1, 2, 3) * shading::f64::D_GGX(std::max(alpha, 0.05), glm::normalize(lobe.view + d).y) * d.y;
    };
    const LinearControl bent(sky, product, lobe.normal, inFours(peaked));
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> uniform;
    constexpr int kCount = 100000;
    glm::dvec3 sum(0.0), squares(0.0);
    for (int i = 0; i < kCount; ++i) {
      const double u = uniform(random), v = uniform(random);
      const ProductSampler::Sample s = product.sample({u, v});
      const glm::dvec3 control = exact.at(s.node, s.direction);
      if (control != glm::dvec3(0)) {
        ASSERT_NEAR(glm::distance(control, linear(s.direction)), 0, 2e-2); // a block is bent
      }
      const glm::dvec4 light(sky.cell(s.x, s.y));
      const glm::dvec3 value = bent.at(s.node, s.direction) * glm::dvec3(light) / (light.w * product.gain(s.node));
      sum += value / double(kCount);
      squares += value * value / double(kCount);
    }
    for (int c = 0; c < 3; ++c) {
      ASSERT_GT(sum[c], 0);
      EXPECT_NEAR(bent.integral()[c] / sum[c], 1, 5 * std::sqrt((squares[c] / (sum[c] * sum[c]) - 1) / kCount));
    }
  }
}

TEST(ProductSampler, TellsThatNothingIsAboveTheHorizon) {
  const EnvironmentSampler below(
      tests::makePanorama([](const glm::dvec3& d) { return d.y < -0.5 ? glm::vec3(1) : glm::vec3(0); }));
  EXPECT_TRUE(ProductSampler(below.light(), makeLobe(0.5, 0.5, 0.5)).isBlack());
  EXPECT_FALSE(ProductSampler(below.light(), {.normal = {0, -1, 0}, .view = {0, -1, 0}, .lambert = 1}).isBlack());
}

} // namespace
} // namespace parity::reference
