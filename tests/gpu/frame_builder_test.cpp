// Frames from shaded surfaces: samples, layers, background, terms.
#include <gtest/gtest.h>

#include "gpu/frame_builder.h"
#include "shading/terms.h"

namespace parity::gpu {
namespace {

// Two pixels side by side; the surface covers those listed.
Surface makeSurface(std::vector<std::uint32_t> pixels) {
  Surface surface;
  surface.width = 2;
  surface.height = 1;
  surface.instances.assign(pixels.size(), 0);
  surface.pixels = std::move(pixels);
  return surface;
}

TEST(FrameBuilder, showsTheBackgroundWhereNothingIsSeen) {
  FrameBuilder builder(2, 1, 1, false, glm::vec3(0.1f, 0.2f, 0.3f));
  builder.add(makeSurface({1}), {{glm::vec4(5, 6, 7, 1)}, {}}, nullptr, nullptr, {0, 1});
  EXPECT_EQ(builder.take().color.pixels, (std::vector<float>{0.1f, 0.2f, 0.3f, 5, 6, 7}));
}

TEST(FrameBuilder, averagesSamplesInLinearLight) {
  FrameBuilder builder(2, 1, 2, false, glm::vec3(0));
  builder.add(makeSurface({0}), {{glm::vec4(1, 1, 1, 1)}, {}}, nullptr, nullptr, {0, 1});
  builder.add(makeSurface({0, 1}), {{glm::vec4(3, 3, 3, 1), glm::vec4(8, 8, 8, 1)}, {}}, nullptr, nullptr, {0, 1});
  EXPECT_EQ(builder.take().color.pixels, (std::vector<float>{2, 2, 2, 4, 4, 4}));
}

TEST(FrameBuilder, laysTheBlendedLayerOverColourAndTermsAlike) {
  FrameBuilder builder(2, 1, 1, true, glm::vec3(1));
  ShadedSurface below{{glm::vec4(4, 4, 4, 1)},
                      std::vector<std::vector<glm::vec4>>(shading::kTermCount, {glm::vec4(0)})};
  below.terms[0][0] = glm::vec4(4, 4, 4, 0);
  ShadedSurface above{{glm::vec4(8, 8, 8, 0.25f), glm::vec4(8, 8, 8, 0.5f)},
                      std::vector<std::vector<glm::vec4>>(shading::kTermCount, {glm::vec4(0), glm::vec4(0)})};
  above.terms[7] = {glm::vec4(8, 8, 8, 0), glm::vec4(8, 8, 8, 0)};
  const Surface opaque = makeSurface({0}), blended = makeSurface({0, 1});
  builder.add(opaque, below, &blended, &above, {0, 1});
  const base::Frame frame = builder.take();
  EXPECT_EQ(frame.color.pixels,
            (std::vector<float>{5, 5, 5, 4.5f, 4.5f, 4.5f})); // over the surface, over the background
  EXPECT_EQ(frame.terms[0].pixels[0], 3);
  EXPECT_EQ(frame.terms[7].pixels[0], 2);
  EXPECT_EQ(frame.terms[7].pixels[3], 4);
}

TEST(FrameBuilder, addsPremultipliedColourAndTermsAsTheyAre) {
  FrameBuilder builder(2, 1, 1, true, glm::vec3(1));
  const auto terms = [](float value) {
    return std::vector<std::vector<glm::vec4>>(shading::kTermCount, {glm::vec4(value)});
  };
  const ShadedSurface below{{glm::vec4(4, 4, 4, 1)}, terms(4)}, above{{glm::vec4(2, 2, 2, 0.25f)}, terms(2), true};
  const Surface opaque = makeSurface({0}), blended = makeSurface({0});
  builder.add(opaque, below, &blended, &above, {0, 1});
  const base::Frame frame = builder.take();
  EXPECT_EQ(frame.color.pixels, (std::vector<float>{5, 5, 5, 1, 1, 1}));
  for (const base::Image& term : frame.terms) EXPECT_EQ(term.pixels[0], 5);
}

} // namespace
} // namespace parity::gpu
