// The material swap against frames composed by hand: only the one material's entries carry the other path's colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>

#include "gpu/surface/frame_builder.h"
#include "gpu/surface/material_swap.h"
#include "support/not_finite.h"

namespace parity::gpu {
namespace {

using tests::kNan;
constexpr std::uint32_t kWidth = 4;
const std::vector<std::uint32_t> kMaterialOf = {0, 1, 2}; // of instance i material i

// One row of four pixels. Each entry: pixel, instance, grey value by both paths, opacity.
struct Entry {
  std::uint32_t pixel, instance;
  float reference, test, opacity = 1;
};
struct Layer { // copied into lists; a surface is not
  std::shared_ptr<Surface> surface = std::make_shared<Surface>();
  ShadedSurface reference, test;
};
Layer makeLayer(const std::vector<Entry>& entries, bool blended = false, bool premultiplied = false) {
  Layer layer;
  layer.surface->blended = blended;
  layer.surface->width = kWidth;
  layer.surface->height = 1;
  layer.test.premultiplied = premultiplied;
  std::vector<glm::vec4> reference, test;
  for (const Entry& e : entries) {
    layer.surface->pixels.push_back(e.pixel);
    layer.surface->instances.push_back(e.instance);
    reference.emplace_back(glm::vec3(e.reference), e.opacity);
    test.emplace_back(glm::vec3(premultiplied ? e.test * e.opacity : e.test), e.opacity);
  }
  layer.reference.color = std::move(reference);
  layer.test.color = std::move(test);
  return layer;
}

using Sample = std::vector<Layer>;

// What is compared: both paths' frames, the coverage made of the same layers, and the swaps.
struct Composed {
  base::Image reference, test;
  std::vector<base::PixelList> coverage;
  std::vector<SwappedPixels> swaps;
};

// The coverage by its definition: opacity times what the layers in front let through, mean over the samples.
std::vector<base::PixelList> coverageOf(const std::vector<Sample>& samples) {
  std::vector<base::PixelList> lists(3);
  for (std::uint32_t p = 0; p < kWidth; ++p)
    for (std::uint32_t m = 0; m < 3; ++m) {
      float sum = 0;
      for (const Sample& sample : samples) {
        float through = 1;
        for (auto layer = sample.rbegin(); layer != sample.rend(); ++layer)
          for (std::size_t i = 0; i < layer->surface->size(); ++i) {
            if (layer->surface->pixels[i] != p) continue;
            const float opacity = layer->surface->blended ? layer->reference.color[i].w : 1;
            if (kMaterialOf[layer->surface->instances[i]] == m) sum += through * opacity;
            through *= 1 - opacity;
          }
      }
      if (!(sum > 0)) continue;
      lists[m].pixels.push_back(p);
      lists[m].weights.push_back(sum / static_cast<float>(samples.size()));
    }
  return lists;
}

Composed compose(const std::vector<Sample>& samples, float background = 0.25f,
                 const std::optional<TargetCodec>& target = std::nullopt, std::vector<char> wanted = {}) {
  const int count = static_cast<int>(samples.size());
  FrameBuilder reference(kWidth, 1, count, {}, glm::vec3(background)),
      test(kWidth, 1, count, {}, glm::vec3(background), target);
  SwapBuilder swap(kMaterialOf, 3, kWidth, count, {glm::vec3(background)}, target, std::move(wanted));
  for (const Sample& sample : samples) {
    reference.begin({0, 1}), test.begin({0, 1}), swap.begin({0, 1}, sample.size());
    for (const Layer& layer : sample) {
      reference.lay(*layer.surface, layer.reference);
      test.lay(*layer.surface, layer.test);
      const SwapPlane plane{layer.reference.color, layer.test.color};
      swap.lay(*layer.surface, layer.reference, layer.test, {&plane, 1});
    }
    reference.end(), test.end(), swap.end();
  }
  Composed out{reference.take().color, test.take().color, coverageOf(samples), {}};
  const base::Image* finished = &out.test;
  out.swaps = swap.take(out.coverage, {&finished, 1});
  return out;
}

float valueOf(const Composed& composed, std::size_t material, std::uint32_t pixel) {
  const auto& pixels = composed.coverage[material].pixels;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (pixels[i] == pixel) return composed.swaps[material].planes[0].pixels[3 * i];
  ADD_FAILURE() << "material " << material << " has no pixel " << pixel;
  return kNan;
}

TEST(MaterialSwap, AnOpaquePixelShowsTheTestColour) {
  const Composed found = compose({{makeLayer({{0, 0, 0.5f, 0.7f}, {1, 1, 0.1f, 60000.f}})}});
  EXPECT_EQ(valueOf(found, 0, 0), 0.7f);
  EXPECT_EQ(valueOf(found, 1, 1), 60000.f);
  EXPECT_EQ(found.swaps[0].whole, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(found.swaps[2].planes.empty()) << "it is not seen";
}

TEST(MaterialSwap, BehindAPaneEachMaterialIsSwappedAlone) {
  // A pane of opacity .25 before a wall.
  const Composed found = compose({{makeLayer({{0, 0, 0.4f, 0.8f}}), makeLayer({{0, 1, 1.f, 3.f, 0.25f}}, true)}});
  EXPECT_FLOAT_EQ(found.reference.pixels[0], 0.75f * 0.4f + 0.25f * 1);
  EXPECT_FLOAT_EQ(valueOf(found, 0, 0), 0.75f * 0.8f + 0.25f * 1);
  EXPECT_FLOAT_EQ(valueOf(found, 1, 0), 0.75f * 0.4f + 0.25f * 3);
  EXPECT_TRUE(found.swaps[0].whole.empty());
  EXPECT_TRUE(found.swaps[1].whole.empty());
}

TEST(MaterialSwap, AnEqualPaneIsTheReferencePictureBitByBitWhateverLiesBehind) {
  for (const bool premultiplied : {false, true}) {
    const Composed found =
        compose({{makeLayer({{0, 0, 0.337f, 7.1f}, {1, 0, 0.2f, kNan}}),
                  makeLayer({{0, 1, 0.5f, 0.5f, 0.0625f}, {1, 1, 0.5f, 0.5f, 0.0625f}}, true, premultiplied)}});
    EXPECT_EQ(valueOf(found, 1, 0), found.reference.pixels[0]);
    EXPECT_EQ(valueOf(found, 1, 1), found.reference.pixels[3]) << "mobile's NaN behind it is not the pane's";
  }
}

TEST(MaterialSwap, SeveralLayersOfOneMaterialAreSwappedTogether) {
  const Composed found = compose({{makeLayer({{0, 0, 0.4f, 0.8f}}), makeLayer({{0, 1, 1, 2, 0.5f}}, true),
                                   makeLayer({{0, 0, 0.2f, 0.6f, 0.25f}}, true)}});
  const float behind = 0.5f * 0.8f + 0.5f * 1; // own wall, the other's pane as the reference has it
  EXPECT_FLOAT_EQ(valueOf(found, 0, 0), 0.75f * behind + 0.25f * 0.6f);
  EXPECT_FLOAT_EQ(valueOf(found, 1, 0), 0.75f * (0.5f * 0.4f + 0.5f * 2) + 0.25f * 0.2f);
}

TEST(MaterialSwap, OpacitiesThatDifferAreTheTestPathsOwn) {
  Layer pane = makeLayer({{0, 1, 1, 1, 0.5f}}, true);
  pane.test.color = {glm::vec4(1, 1, 1, 0.75f)}; // its textures are compressed
  const Composed found = compose({{makeLayer({{0, 0, 0.2f, 0.2f}}), pane}});
  EXPECT_FLOAT_EQ(valueOf(found, 1, 0), 0.25f * 0.2f + 0.75f * 1);
  EXPECT_FLOAT_EQ(valueOf(found, 0, 0), found.reference.pixels[0]);
}

TEST(MaterialSwap, SamplesAreAveragedAndThoseWithoutTheMaterialStayAsTheyAre) {
  // Material 0 covers half of pixel 0, the background the rest; all of pixel 1.
  const std::vector<Sample> samples = {{makeLayer({{0, 0, 0.5f, 0.9f}, {1, 0, 0.3f, 0.7f}})},
                                       {makeLayer({{1, 0, 0.3f, 0.5f}})}};
  const Composed found = compose(samples, 0.25f);
  EXPECT_FLOAT_EQ(valueOf(found, 0, 0), (0.9f + 0.25f) / 2);
  EXPECT_EQ(valueOf(found, 0, 1), found.test.pixels[3]);
  EXPECT_EQ(found.swaps[0].whole, std::vector<std::uint32_t>{1});
}

TEST(MaterialSwap, LargeLightBesideDarkLightLosesNothing) {
  const std::vector<Sample> samples = {{makeLayer({{0, 0, 60000.f, 0.1f}})}, {makeLayer({{0, 1, 0.2f, 0.2f}})}};
  const Composed found = compose(samples);
  EXPECT_NEAR(valueOf(found, 0, 0), 0.15f, 1e-6);
  EXPECT_EQ(valueOf(found, 1, 0), found.reference.pixels[0]);
}

// The formula of the design: reference + sum over the material's entries of weight * (test - reference).
TEST(MaterialSwap, RandomLayersAreTheSumOfWeightedDifferences) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::uniform_int_distribution<std::uint32_t> instance(0, 2);
  for (int round = 0; round < 50; ++round) {
    std::vector<Sample> samples(3);
    for (Sample& sample : samples)
      for (int k = 0; k < 5; ++k) {
        std::vector<Entry> entries;
        for (std::uint32_t p = 0; p < kWidth; ++p)
          if (uniform(random) < 0.7f)
            entries.push_back({p, instance(random), uniform(random), uniform(random), uniform(random)});
        sample.push_back(makeLayer(entries, k > 0, round % 2 == 0));
      }
    const Composed found = compose(samples);
    for (std::size_t m = 0; m < 3; ++m)
      for (const std::uint32_t p : found.coverage[m].pixels) {
        double expected = found.reference.pixels[3 * p];
        for (const Sample& sample : samples) {
          double through = 1;
          for (auto layer = sample.rbegin(); layer != sample.rend(); ++layer)
            for (std::size_t i = 0; i < layer->surface->size(); ++i) {
              if (layer->surface->pixels[i] != p) continue;
              const double opacity = layer->surface->blended ? layer->reference.color[i].w : 1;
              const double test = layer->test.color[i].x / (layer->test.premultiplied ? opacity : 1);
              if (kMaterialOf[layer->surface->instances[i]] == m)
                expected += through * opacity * (test - layer->reference.color[i].x) / 3;
              through *= 1 - opacity;
            }
        }
        EXPECT_NEAR(valueOf(found, m, p), expected, 2e-6) << "material " << m << ", pixel " << p;
      }
  }
}

TEST(MaterialSwap, OpaquePixelsTakeWhatTheTargetReturns) {
  for (const OutputTarget target :
       {OutputTarget::rgba16f, OutputTarget::r11g11b10f, OutputTarget::rgba8Srgb, OutputTarget::rgba8Gamma2}) {
    const TargetCodec codec(target, 0);
    const Composed found = compose({{makeLayer({{0, 0, 0.5f, 0.3217f}, {1, 0, 0.5f, 3.f}})}}, 0.25f, codec);
    EXPECT_EQ(valueOf(found, 0, 0), found.test.pixels[0]);
    EXPECT_EQ(valueOf(found, 0, 1), found.test.pixels[3]);
    EXPECT_NE(valueOf(found, 0, 0), 0.3217f);
  }
}

TEST(MaterialSwap, WhatADisplayedTargetMakesOfThePictureBehindIsNotThePanes) {
  const TargetCodec codec(OutputTarget::rgba8Srgb, 0);
  // Light above white behind an equal pane: the target cuts it off, and rounds it.
  const Composed found = compose({{makeLayer({{0, 0, 5.f, 5.f}, {1, 0, 0.3217f, 0.9f}}),
                                   makeLayer({{0, 1, 0.5f, 0.5f, 0.05f}, {1, 1, 0.5f, 0.5f, 0.05f}}, true)}},
                                 0.25f, codec);
  const float step = 0.01f; // of 8 bits in that light
  EXPECT_NEAR(valueOf(found, 1, 0), found.reference.pixels[0], step);
  EXPECT_NEAR(valueOf(found, 1, 1), found.reference.pixels[3], step);
}

TEST(MaterialSwap, ATargetThatBlendsRootsIsChargedToThePane) {
  const TargetCodec codec(OutputTarget::rgba8Gamma2, 0);
  const Composed found =
      compose({{makeLayer({{0, 0, 0.64f, 0.64f}}), makeLayer({{0, 1, 0.04f, 0.04f, 0.5f}}, true)}}, 0.25f, codec);
  // In roots the mean of .8 and .2 is .5, which the screen takes for an sRGB code; of light it is .34.
  const float shown = std::pow((0.5f + 0.055f) / 1.055f, 2.4f), wall = std::pow((0.8f + 0.055f) / 1.055f, 2.4f);
  EXPECT_NEAR(found.test.pixels[0], shown, 0.01f);
  EXPECT_NEAR(valueOf(found, 1, 0), shown + 0.5f * (0.64f - wall), 0.01f) << "less what it makes of the wall alone";
}

TEST(MaterialSwap, OnlyWantedMaterialsAreSwapped) {
  const Composed found = compose({{makeLayer({{0, 0, 0.4f, 0.8f}}), makeLayer({{0, 1, 1, 2, 0.5f}}, true)}}, 0.25f,
                                 std::nullopt, {1, 0, 0});
  EXPECT_FLOAT_EQ(valueOf(found, 0, 0), 0.5f * 0.8f + 0.5f * 1);
  EXPECT_TRUE(found.swaps[0].whole.empty()) << "another material lies over it";
  EXPECT_TRUE(found.swaps[1].planes.empty());
}

// Two rows, a tile each; in the second a pane over the background alone, and a ball before another's.
TEST(MaterialSwap, TilesFollowEachOther) {
  for (const int samples : {1, 2}) {
    SwapBuilder swap(kMaterialOf, 3, kWidth, samples, {glm::vec3(0.25f)});
    for (std::uint32_t row = 0; row < 2; ++row)
      for (int sample = 0; sample < samples; ++sample) {
        const Layer below = row == 0 ? makeLayer({{1, 0, 0.1f, 0.2f}, {3, 1, 0.3f, 0.4f}})
                                     : makeLayer({{4, 0, 0.5f, 0.6f}, {6, 1, 0.7f, 0.8f}});
        const Layer above = row == 0 ? makeLayer({}, true) : makeLayer({{5, 2, 1, 2, 0.5f}, {6, 2, 1, 2, 0.5f}}, true);
        swap.begin({row, 1}, 2);
        for (const Layer* layer : {&below, &above}) {
          const SwapPlane plane{layer->reference.color, layer->test.color};
          swap.lay(*layer->surface, layer->reference, layer->test, {&plane, 1});
        }
        swap.end();
      }
    const std::vector<base::PixelList> coverage = {{"a", {1, 4}, {}}, {"b", {3, 6}, {}}, {"c", {5, 6}, {}}};
    const std::vector<SwappedPixels> found = swap.take(coverage, {});
    const float wanted[3][2] = {{0.2f, 0.6f}, {0.4f, 0.5f * 0.8f + 0.5f}, {1 + 0.125f, 1 + 0.35f}};
    for (std::size_t m = 0; m < 3; ++m)
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_FLOAT_EQ(found[m].planes[0].pixels[3 * i], wanted[m][i]) << m << ' ' << i;
    EXPECT_EQ(found[0].whole, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(found[1].whole, std::vector<std::uint32_t>{0}) << "the second is below the pane";
  }
}

// Behind the only layer of a sample is the background; nothing else is kept to lie behind another.
TEST(MaterialSwap, TheOnlyLayerIsComposedAsIfOthersCame) {
  for (const bool blended : {false, true})
    for (const int samples : {1, 2}) {
      const Layer layer = makeLayer({{0, 0, 0.3f, 0.7f, 0.0625f}, {2, 1, 0.2f, kNan, 0}, {3, 0, 0, 5, 1}}, blended);
      const auto swapped = [&](std::size_t layers) {
        SwapBuilder swap(kMaterialOf, 3, kWidth, samples, {glm::vec3(0.25f), glm::vec3(1)});
        const SwapPlane plane{layer.reference.color, layer.test.color}, planes[] = {plane, plane};
        for (int sample = 0; sample < samples; ++sample) {
          swap.begin({0, 1}, layers);
          swap.lay(*layer.surface, layer.reference, layer.test, planes);
          swap.end();
        }
        return swap.take({{"a", {0, 3}, {}}, {"b", {2}, {}}, {"c", {}, {}}}, {});
      };
      const std::vector<SwappedPixels> alone = swapped(1), expected = swapped(2);
      for (std::size_t m = 0; m < 2; ++m) {
        EXPECT_EQ(alone[m].whole, expected[m].whole);
        ASSERT_EQ(alone[m].planes.size(), 2u);
        for (std::size_t p = 0; p < 2; ++p)
          EXPECT_TRUE(std::ranges::equal(
              alone[m].planes[p].pixels, expected[m].planes[p].pixels,
              [](float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }))
              << m << p << blended << samples;
      }
      const float over = blended ? 0.0625f : 1;
      EXPECT_FLOAT_EQ(alone[0].planes[0].pixels[0], (1 - over) * 0.25f + over * 0.7f);
    }
}

TEST(MaterialSwap, TilesOfOneLayerAndOfTwoFollowEachOther) {
  SwapBuilder swap(kMaterialOf, 3, kWidth, 1, {glm::vec3(0.25f)});
  for (std::uint32_t row = 0; row < 4; ++row) {
    const bool hasPane = row % 2 == 1;
    std::vector<Layer> layers = {makeLayer({{kWidth * row, 0, 0.5f, 0.75f}})};
    if (hasPane) layers.push_back(makeLayer({{kWidth * row, 1, 1, 2, 0.5f}, {kWidth * row + 1, 1, 1, 2, 0.5f}}, true));
    swap.begin({row, 1}, layers.size());
    for (const Layer& layer : layers) {
      const SwapPlane plane{layer.reference.color, layer.test.color};
      swap.lay(*layer.surface, layer.reference, layer.test, {&plane, 1});
    }
    swap.end();
  }
  const auto found = swap.take({{"a", {0, 4, 8, 12}, {}}, {"b", {4, 5, 12, 13}, {}}, {"c", {}, {}}}, {});
  const auto expectValues = [&](std::size_t material, const std::vector<float>& expected) {
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_FLOAT_EQ(found[material].planes[0].pixels[3 * i], expected[i]) << material << ' ' << i;
  };
  const float throughPane = 0.5f * 0.75f + 0.5f, pane = 0.5f * 0.5f + 1, paneAlone = 0.5f * 0.25f + 1;
  expectValues(0, {0.75f, throughPane, 0.75f, throughPane});
  expectValues(1, {pane, paneAlone, pane, paneAlone});
}

TEST(MaterialSwap, PlanesAreComposedSideBySide) {
  const Layer layer = makeLayer({{2, 0, 0.5f, 0.7f}});
  const std::vector<glm::vec4> black = {glm::vec4(0, 0, 0, 1)}, bright = {glm::vec4(9, 9, 9, 1)};
  SwapBuilder swap(kMaterialOf, 3, kWidth, 1, {glm::vec3(0.25f), glm::vec3(0)});
  swap.begin({0, 1}, 1);
  const SwapPlane planes[] = {{layer.reference.color, layer.test.color}, {PlaneView(black), PlaneView(bright)}};
  swap.lay(*layer.surface, layer.reference, layer.test, planes);
  swap.end();
  const std::vector<base::PixelList> coverage = {{"a", {2}, {}}, {"b", {}, {}}, {"c", {}, {}}};
  const auto found = swap.take(coverage, {});
  EXPECT_EQ(found[0].planes[0].pixels[0], 0.7f);
  EXPECT_EQ(found[0].planes[1].pixels[0], 9);
}

} // namespace
} // namespace parity::gpu
