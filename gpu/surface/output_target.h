// Render targets of the mobile path: what a pixel becomes when it is stored, blended over and shown (docs/targets.md).
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace parity::gpu {

// In the order of their names.
enum class OutputTarget {
  rgba16f,    // "rgba16f": halves, rounded to nearest even, saturated at 65504
  r11g11b10f, // "r11g11b10f": mantissas of 6, 6 and 5 bits, no sign
  rgba8Srgb,  // "rgba8-srgb": 8 bits by the sRGB curve, blended in linear light
  rgba8Gamma2 // "rgba8-gamma2": 8 bits of a square root that the shader takes, blended as they are
};
const std::vector<std::string>& outputTargetNames();

// Whether the target's bits are what the screen shows, taken for sRGB: exposure comes before it and no display
// transform after it. Of a float target it is the other way round.
bool isDisplayed(OutputTarget target);

// Linear Rec.709 light through a target. A channel that is NaN or infinite passes unchanged wherever a device would
// store a number in its place, so that whoever compares the frame sees it. With its target's numbers blending is done
// in fp32, and each result is stored.
class TargetCodec {
public:
  // exposureEv: of the camera; half: the shader computes in fp16.
  TargetCodec(OutputTarget target, float exposureEv, bool half = false);

  // isDisplayed of the target.
  bool isDisplayed() const { return gpu::isDisplayed(m_target); }

  // From scene-referred light, as the shader has it, to what blending works on.
  glm::vec3 write(const glm::vec3& radiance) const;
  // What the target keeps of it: the nearest of its numbers. Of targets that are displayed: of [0,1].
  glm::vec3 store(const glm::vec3& value) const;
  // The light that what is kept stands for, scene-referred again: of a target that is displayed the light of the
  // screen, without the exposure.
  glm::vec3 read(const glm::vec3& stored) const;

private:
  OutputTarget m_target;
  float m_gain;
  bool m_half;
};

// The nearest unsigned float of 5 exponent bits (bias 15, denormals kept) and this many mantissa bits (6: 11-bit, 5:
// 10-bit), ties to even. Vulkan 1.3, "Unsigned 11-Bit Floating-Point Numbers" and "Unsigned 10-Bit ...": negative
// values become 0, finite ones above the largest (65024, 64512) that, NaN stays NaN; "finite values are rounded to the
// closest representable" (rounding towards zero is allowed, too). Infinity stays infinite.
float roundToUnsignedFloat(float value, int mantissaBits);

} // namespace parity::gpu
