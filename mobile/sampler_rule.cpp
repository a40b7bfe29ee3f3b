#include "mobile/sampler_rule.h"

#include <fmt/format.h>

#include "gpu/textures.h"

namespace parity::mobile {

std::size_t countSamplers(const scenes::Material& material, const SamplerInputs& inputs) {
  const bool fetches = inputs.environment && !material.unlit && !material.fullyRough;
  return gpu::countSamplers(material, inputs.normalVariance) + (fetches ? 1 : 0) +
         (inputs.shadowMap && !material.unlit ? 1 : 0) + (inputs.lightmap && !material.unlit ? 1 : 0) +
         (inputs.sunShadow && !material.unlit ? 1 : 0);
}

std::string describeExcess(const scenes::Material& material, const SamplerInputs& inputs, std::size_t limit) {
  const std::size_t count = countSamplers(material, inputs);
  return count > limit ? fmt::format("needs {} samplers on mobile, of at most {}", count, limit) : "";
}

std::vector<std::string> samplerWarnings(const scenes::Scene& scene, const SamplerInputs& inputs, std::size_t limit) {
  std::vector<std::string> warnings;
  for (const scenes::Material& material : scene.materials)
    if (const std::string excess = describeExcess(material, inputs, limit); !excess.empty())
      warnings.push_back(fmt::format("material '{}' {}", material.name, excess));
  return warnings;
}

} // namespace parity::mobile
