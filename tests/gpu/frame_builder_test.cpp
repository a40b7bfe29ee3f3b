// Frames from shaded surfaces: samples, layers, background, terms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gpu/surface/frame_builder.h"
#include "shading/terms.h"

namespace parity::gpu {
namespace {

// Two pixels side by side; the surface covers those listed.
Surface makeSurface(std::vector<std::uint32_t> pixels, bool blended = false) {
  Surface surface;
  surface.blended = blended;
  surface.width = 2;
  surface.height = 1;
  surface.instances.assign(pixels.size(), 0);
  surface.pixels = std::move(pixels);
  return surface;
}

struct ShadedLayer {
  Surface surface;
  ShadedSurface shaded;
};

// A sample with these layers, from the back to the front.
template <typename... Layers> void add(FrameBuilder& builder, const Layers&... layers) {
  builder.begin({0, 1});
  (builder.lay(layers.surface, layers.shaded), ...);
  builder.end();
}

TEST(FrameBuilder, ShowsTheBackgroundWhereNothingIsSeen) {
  FrameBuilder builder(2, 1, 1, {}, glm::vec3(0.1f, 0.2f, 0.3f));
  add(builder, ShadedLayer{makeSurface({1}), {{glm::vec4(5, 6, 7, 1)}, {}}});
  EXPECT_EQ(builder.take().color.pixels, (std::vector<float>{0.1f, 0.2f, 0.3f, 5, 6, 7}));
}

// Two rows, a tile each. One sample is composed in the picture itself, two beside it.
TEST(FrameBuilder, TilesAreRowsOfThePicture) {
  for (const int samples : {1, 2}) {
    FrameBuilder builder(2, 2, samples, {1}, glm::vec3(0.5f));
    for (std::uint32_t row = 0; row < 2; ++row)
      for (int sample = 0; sample < samples; ++sample) {
        Surface surface = makeSurface({2 * row + row}); // a pixel of each row
        surface.height = 2;
        const float value = static_cast<float>(1 + row);
        builder.begin({row, 1});
        builder.lay(surface, {{glm::vec4(value, value, value, 1)}, {{glm::vec4(10 * value)}}});
        builder.end();
      }
    const base::Frame frame = builder.take();
    EXPECT_EQ(frame.color.pixels, (std::vector<float>{1, 1, 1, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 2, 2, 2}));
    EXPECT_EQ(frame.terms[0].pixels, (std::vector<float>{10, 10, 10, 0, 0, 0, 0, 0, 0, 20, 20, 20}));
  }
}

TEST(FrameBuilder, ComposesTheTermsThatAreAskedFor) {
  for (const int samples : {1, 2}) {
    FrameBuilder builder(2, 1, samples, {0, 1}, glm::vec3(0));
    for (int sample = 0; sample < samples; ++sample)
      add(builder, ShadedLayer{makeSurface({1}), {{glm::vec4(1)}, {{glm::vec4(3)}, {glm::vec4(5)}}}});
    const base::Frame frame = builder.take();
    ASSERT_EQ(frame.terms.size(), 2u);
    EXPECT_TRUE(frame.terms[0].empty());
    EXPECT_EQ(frame.terms[1].pixels, (std::vector<float>{0, 0, 0, 5, 5, 5}));
  }
}

TEST(FrameBuilder, OfTermsLeavesTheColourOut) {
  for (const int samples : {1, 2}) {
    const ShadedLayer below{makeSurface({1}), {{glm::vec4(1)}, {{glm::vec4(3)}, {glm::vec4(5)}}}},
        above{makeSurface({1}, true), {{glm::vec4(0.25f)}, {ShadedPlane::zeros(1), {glm::vec4(9)}}}};
    FrameBuilder whole(2, 1, samples, {0, 1}, glm::vec3(7)), terms = FrameBuilder::ofTerms(2, 1, samples, {0, 1});
    for (int sample = 0; sample < samples; ++sample)
      for (FrameBuilder* builder : {&whole, &terms}) add(*builder, below, above);
    const base::Frame expected = whole.take(), found = terms.take();
    EXPECT_TRUE(found.color.empty());
    EXPECT_EQ(found.terms, expected.terms);
    EXPECT_EQ(found.terms[1].pixels, (std::vector<float>{0, 0, 0, 6, 6, 6}));
  }
}

TEST(FrameBuilder, AveragesSamplesInLinearLight) {
  FrameBuilder builder(2, 1, 2, {}, glm::vec3(0));
  add(builder, ShadedLayer{makeSurface({0}), {{glm::vec4(1, 1, 1, 1)}, {}}});
  add(builder, ShadedLayer{makeSurface({0, 1}), {{glm::vec4(3, 3, 3, 1), glm::vec4(8, 8, 8, 1)}, {}}});
  EXPECT_EQ(builder.take().color.pixels, (std::vector<float>{2, 2, 2, 4, 4, 4}));
}

TEST(FrameBuilder, LaysTheBlendedLayerOverColourAndTermsAlike) {
  FrameBuilder builder(2, 1, 1, std::vector<char>(shading::kBaseTermCount, 1), glm::vec3(1));
  ShadedSurface below{{glm::vec4(4, 4, 4, 1)}, std::vector<ShadedPlane>(shading::kTermCount, ShadedPlane::zeros(1))};
  below.terms[0] = {glm::vec4(4, 4, 4, 0)};
  ShadedSurface above{{glm::vec4(8, 8, 8, 0.25f), glm::vec4(8, 8, 8, 0.5f)},
                      std::vector<ShadedPlane>(shading::kTermCount, {glm::vec4(0), glm::vec4(0)})};
  above.terms[7] = {glm::vec4(8, 8, 8, 0), glm::vec4(8, 8, 8, 0)};
  add(builder, ShadedLayer{makeSurface({0}), below}, ShadedLayer{makeSurface({0, 1}, true), above});
  const base::Frame frame = builder.take();
  EXPECT_EQ(frame.color.pixels,
            (std::vector<float>{5, 5, 5, 4.5f, 4.5f, 4.5f})); // over the surface, over the background
  EXPECT_EQ(frame.terms[0].pixels[0], 3);
  EXPECT_EQ(frame.terms[7].pixels[0], 2);
  EXPECT_EQ(frame.terms[7].pixels[3], 4);
}

TEST(FrameBuilder, AddsPremultipliedColourAndTermsAsTheyAre) {
  FrameBuilder builder(2, 1, 1, std::vector<char>(shading::kBaseTermCount, 1), glm::vec3(1));
  const auto terms = [](float value) { return std::vector<ShadedPlane>(shading::kTermCount, {glm::vec4(value)}); };
  const ShadedSurface below{{glm::vec4(4, 4, 4, 1)}, terms(4)}, above{{glm::vec4(2, 2, 2, 0.25f)}, terms(2), true};
  add(builder, ShadedLayer{makeSurface({0}), below}, ShadedLayer{makeSurface({0}, true), above});
  const base::Frame frame = builder.take();
  EXPECT_EQ(frame.color.pixels, (std::vector<float>{5, 5, 5, 1, 1, 1}));
  for (const base::Image& term : frame.terms) EXPECT_EQ(term.pixels[0], 5);
}

// One pixel: an opaque surface of light 0.64, over it a layer of light 0.04 at half opacity.
glm::vec3 blend(const std::optional<TargetCodec>& target) {
  FrameBuilder builder(2, 1, 1, {}, glm::vec3(0), target);
  const ShadedSurface below{{glm::vec4(0.64f, 0.64f, 0.64f, 1)}, {}}, above{{glm::vec4(0.04f, 0.04f, 0.04f, 0.5f)}, {}};
  add(builder, ShadedLayer{makeSurface({0}), below}, ShadedLayer{makeSurface({0}, true), above});
  const base::Frame frame = builder.take();
  return {frame.color.pixels[0], frame.color.pixels[1], frame.color.pixels[2]};
}

TEST(FrameBuilder, BlendsInTheNumbersOfItsTarget) {
  EXPECT_FLOAT_EQ(blend(std::nullopt).x, 0.34f);
  // Halves: 0.64 is 1311/2048; half of it and 0.02 is 0.340068, 1393 of 2^-12.
  EXPECT_EQ(blend(TargetCodec(OutputTarget::rgba16f, 0)).x, 1393 * 0x1p-12f);
  // sRGB: 0.64 is code 209, of light 0.63760; half of it and 0.02 is 0.33880: code 157, of light 0.337164.
  EXPECT_NEAR(blend(TargetCodec(OutputTarget::rgba8Srgb, 0)).x, 0.337164f, 1e-6f);
  // Gamma 2.0: codes 204 (0.8) and 51 (0.2) blend as they are: 127.5 is 128, shown as light 0.21586.
  EXPECT_NEAR(blend(TargetCodec(OutputTarget::rgba8Gamma2, 0)).x, 0.215861f, 1e-6f);
}

// As hardware does: what each layer leaves is stored before the next one is blended over it.
TEST(FrameBuilder, RoundsAfterEachLayer) {
  FrameBuilder builder(2, 1, 1, {}, glm::vec3(0), TargetCodec(OutputTarget::rgba8Gamma2, 0));
  const float light = 9 / 255.f * (9 / 255.f);
  const ShadedSurface half{{glm::vec4(0, 0, 0, 0.5f)}, {}};
  add(builder, ShadedLayer{makeSurface({0}), {{glm::vec4(light, light, light, 1)}, {}}},
      ShadedLayer{makeSurface({0}, true), half}, ShadedLayer{makeSurface({0}, true), half});
  // Code 9, then 4.5 is 5 and 2.5 is 3; rounded once, at the end, it were 2.25: 2.
  EXPECT_NEAR(builder.take().color.pixels[0], 3 / 255.f / 12.92f, 1e-7f) << "the light of sRGB code 3";
}

TEST(FrameBuilder, ResolvesSamplesAsItsTargetWould) {
  const auto resolve = [](OutputTarget target) {
    FrameBuilder builder(2, 1, 2, {}, glm::vec3(0), TargetCodec(target, 0));
    add(builder, ShadedLayer{makeSurface({0}), {{glm::vec4(1)}, {}}});
    add(builder, ShadedLayer{makeSurface({}), {}});
    return builder.take().color.pixels[0];
  };
  EXPECT_EQ(resolve(OutputTarget::rgba16f), 0.5f);
  EXPECT_NEAR(resolve(OutputTarget::rgba8Srgb), 0.502886f, 1e-6f) << "half the light is code 187.5, so 188";
  EXPECT_NEAR(resolve(OutputTarget::rgba8Gamma2), 0.215861f, 1e-6f) << "half of the codes is 128";
}

TEST(FrameBuilder, StoresTheBackgroundInItsTarget) {
  FrameBuilder builder(2, 1, 1, {}, glm::vec3(0.18f), TargetCodec(OutputTarget::rgba8Gamma2, 0));
  add(builder, ShadedLayer{makeSurface({}), {}});
  EXPECT_NEAR(builder.take().color.pixels[0], 0.149960f, 1e-6f) << "code 108";
}

TEST(FrameBuilder, ATargetLeavesTermsAndNonFinitePixelsAlone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  FrameBuilder builder(2, 1, 1, std::vector<char>(shading::kBaseTermCount, 1), glm::vec3(0),
                       TargetCodec(OutputTarget::rgba8Gamma2, 0));
  ShadedSurface shaded{{glm::vec4(kNan, 1, 1, 1), glm::vec4(0.3f, 0.3f, 0.3f, 1)},
                       std::vector<ShadedPlane>(shading::kTermCount, ShadedPlane::zeros(2))};
  shaded.terms[2] = {glm::vec4(0), glm::vec4(0.3f)};
  add(builder, ShadedLayer{makeSurface({0, 1}), shaded});
  const base::Frame frame = builder.take();
  EXPECT_TRUE(std::isnan(frame.color.pixels[0]));
  EXPECT_EQ(frame.terms[2].pixels[3], 0.3f);
}

} // namespace
} // namespace parity::gpu
