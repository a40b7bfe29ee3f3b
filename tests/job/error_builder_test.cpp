// The error of a picture from the errors of its layers.
#include <gtest/gtest.h>

#include <cmath>

#include "job/scene/reference_path.h"

namespace parity::job {
namespace {

gpu::Surface surfaceOf(std::vector<std::uint32_t> pixels, bool blended) {
  gpu::Surface surface;
  surface.width = 2;
  surface.height = 2;
  surface.blended = blended;
  surface.pixels = std::move(pixels);
  return surface;
}

ReferenceSurface shadedBy(const std::vector<float>& errors, float opacity) {
  ReferenceSurface shaded;
  shaded.standardErrors = errors;
  shaded.samples.assign(errors.size(), 16);
  shaded.shaded.color = std::vector(errors.size(), glm::vec4(1, 1, 1, opacity));
  return shaded;
}

TEST(ErrorBuilder, ALayersErrorCountsByWhatIsSeenOfIt) {
  ErrorBuilder builder(2, 2, 2);
  const gpu::Tile lower{1, 1};
  builder.begin(lower);
  builder.lay(surfaceOf({2}, false), shadedBy({0.4f}, 1));
  builder.lay(surfaceOf({2, 3}, true), shadedBy({0.2f, 0.2f}, 0.25f));
  builder.lay(surfaceOf({3, 2}, true), shadedBy({0.1f, 0.3f}, 0.5f));
  builder.end();
  builder.begin(lower);
  builder.lay(surfaceOf({2}, false), shadedBy({0.4f}, 1));
  builder.end();
  base::Image color(2, 2, 3);
  for (float& value : color.pixels) value = 0.5f;
  const base::Image error = builder.take(color);
  EXPECT_EQ(error.pixels[0], 0);
  EXPECT_EQ(error.pixels[1], 0);
  // Independent errors add in squares, each times its weight: 0.75 * 0.5, 0.25 * 0.5, 0.5; then the sample without.
  EXPECT_NEAR(error.pixels[2], std::sqrt(0.15 * 0.15 + 0.025 * 0.025 + 0.15 * 0.15 + 0.4 * 0.4) / 2 / 0.5, 1e-6);
  EXPECT_NEAR(error.pixels[3], std::sqrt(0.025 * 0.025 + 0.05 * 0.05) / 2 / 0.5, 1e-6);
  EXPECT_EQ(builder.samples().pixels[2], 64);
  EXPECT_EQ(builder.samples().pixels[3], 32);
}

} // namespace
} // namespace parity::job
