#include "mobile/sampler_rule.h"

#include <fmt/format.h>

#include "gpu/shaders/interface.h"
#include "gpu/surface/textures.h"

namespace parity::mobile {

namespace {

// Those that are not the material's textures.
std::size_t countShared(const SamplerInputs& inputs, bool isLit, bool isFullyRough) {
  if (!isLit) return 0;
  return (inputs.environment && !isFullyRough) + inputs.shadowMap + inputs.lightmap + inputs.sunShadow;
}

// Texture slots that the path reads.
std::uint32_t readSlots(const SamplerInputs& inputs, bool isFullyRough) {
  std::uint32_t slots = ~0u;
  if (!inputs.coat || isFullyRough) slots &= ~gpu::kCoatTextures;
  if (!inputs.coatNormal) slots &= ~(1u << gpu::kSlotCoatNormal);
  if (!inputs.sheen || isFullyRough) slots &= ~gpu::kSheenTextures;
  if (!inputs.anisotropy || isFullyRough) slots &= ~gpu::kAnisotropyTextures;
  if (!inputs.iridescence || isFullyRough) slots &= ~gpu::kIridescenceTextures;
  if (!inputs.transmission || isFullyRough) slots &= ~gpu::kTransmissionTextures;
  if (!inputs.diffuseTransmission || isFullyRough) slots &= ~gpu::kDiffuseTransmissionTextures;
  if (!inputs.thickness || isFullyRough) slots &= ~gpu::kThicknessTextures;
  return slots;
}

} // namespace

std::size_t countSamplers(const scenes::Material& material, const SamplerInputs& inputs) {
  return gpu::countSamplers(material, inputs.normalVariance, readSlots(inputs, material.fullyRough)) +
         countShared(inputs, !material.unlit, material.fullyRough) +
         (inputs.backdrop && material.hasTransmission() && !material.fullyRough);
}

std::size_t countSamplers(const gpu::Permutation& permutation, const SamplerInputs& inputs) {
  const bool isFullyRough = (permutation.mustFeatures & gpu::kFeatureFullyRough) != 0;
  return gpu::countTextures(permutation.textures & readSlots(inputs, isFullyRough)) +
         countShared(inputs, (permutation.mustFeatures & gpu::kFeatureUnlit) == 0, isFullyRough) +
         (inputs.backdrop && (permutation.mayFeatures & gpu::kFeatureTransmission) != 0 && !isFullyRough);
}

std::string describeExcess(const scenes::Material& material, const SamplerInputs& inputs, std::size_t limit) {
  const std::size_t count = countSamplers(material, inputs);
  return count > limit ? fmt::format("needs {} samplers on mobile, expected at most {}", count, limit) : "";
}

} // namespace parity::mobile
