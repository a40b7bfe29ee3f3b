// Targets of 8 bits are what the screen shows: the display transform gives their very bits back.
#include <gtest/gtest.h>

#include <cmath>

#include "gpu/surface/output_target.h"
#include "job/view/displayed.h"

namespace parity::job {
namespace {

using gpu::OutputTarget;

TEST(DisplayedTarget, ItsBitsAreThePicture) {
  for (const float exposureEv : {0.f, 0.37f, -3.f})
    for (const OutputTarget target : {OutputTarget::rgba8Srgb, OutputTarget::rgba8Gamma2}) {
      const gpu::TargetCodec codec(target, exposureEv);
      base::Image frame(256, 1, 3);
      std::vector<std::uint8_t> bits;
      for (int i = 0; i < 256; ++i) {
        const float light = 1.2f * static_cast<float>(i) / 255 / std::exp2(exposureEv); // some above white
        const glm::vec3 stored = codec.store(codec.write(glm::vec3(light))), shown = codec.read(stored);
        for (int c = 0; c < 3; ++c) frame.pixels[3 * static_cast<std::size_t>(i) + c] = shown[c];
        const double clipped = std::min(1.2 * i / 255, 1.);
        const double code = target == OutputTarget::rgba8Gamma2 ? std::sqrt(clipped)
                            : clipped <= 0.0031308              ? 12.92 * clipped
                                                                : 1.055 * std::pow(clipped, 1 / 2.4) - 0.055;
        bits.insert(bits.end(), 3, static_cast<std::uint8_t>(std::floor(255 * code + 0.5)));
      }
      EXPECT_EQ(displayImage(frame, base::DisplayTransform("sRGB"), exposureEv).pixels.pixels, bits) << exposureEv;
    }
}

} // namespace
} // namespace parity::job
