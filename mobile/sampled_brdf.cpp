#include "mobile/sampled_brdf.h"

#include <algorithm>

#include "mobile/probe.h"
#include "mobile/renderer.h"
#include "paths/preset/preset_folder.h"

namespace parity::mobile {

namespace {

constexpr int kNodes = 385;
constexpr std::array<float, 2> kF0 = {0.04f, 1.f};

std::vector<glm::dvec3> sample(const gpu::Device& device, const Options& options, std::uint32_t function, float F0) {
  std::vector<ProbeCall> calls;
  for (int j = 0; j < kNodes; ++j)
    for (int i = 0; i < kNodes; ++i)
      calls.push_back({.function = function,
                       .F0 = F0,
                       .roughness = static_cast<float>(j) / (kNodes - 1),
                       .NoV = static_cast<float>(i) / (kNodes - 1),
                       .x = 0,
                       .y = 0,
                       .z = 0,
                       .unused = 0});
  std::vector<glm::dvec3> nodes;
  for (const glm::vec4& result : probe(device, options, calls)) nodes.emplace_back(result);
  return nodes;
}

} // namespace

SampledBrdf::SampledBrdf(const gpu::Device& device, const Options& options)
    : m_options(options), m_half(precisionOn(device.report(), options) == Precision::fp16),
      m_general{sample(device, options, kProbeEnvironmentBrdf, kF0[0]),
                sample(device, options, kProbeEnvironmentBrdf, kF0[1])},
      m_nonmetal(sample(device, options, kProbeNonmetal, kF0[0])) {}

glm::dvec3 SampledBrdf::read(const Nodes& nodes, double roughness, double NoV) {
  const double x = std::clamp(NoV, 0.0, 1.0) * (kNodes - 1), y = std::clamp(roughness, 0.0, 1.0) * (kNodes - 1);
  const int i = std::min(static_cast<int>(x), kNodes - 2), j = std::min(static_cast<int>(y), kNodes - 2);
  const auto at = [&](int column, int row) {
    return nodes[static_cast<std::size_t>(row) * kNodes + static_cast<std::size_t>(column)];
  };
  return glm::mix(glm::mix(at(i, j), at(i + 1, j), x - i), glm::mix(at(i, j + 1), at(i + 1, j + 1), x - i), y - j);
}

paths::EnvBrdfWords SampledBrdf::words() const {
  return {.label = "mobile",
          .kind = "approximation",
          .variant = m_options.preset,
          .formula = m_options.environmentBrdf == EnvironmentBrdf::own
                         ? "presetEnvironmentBrdf of " + m_options.own->folder()
                         : "as the device computes it",
          .numbers = m_half ? "by the device in half" : "by the device in fp32",
          .multiple = "none"};
}

paths::EnvBrdf::AB SampledBrdf::at(double roughness, double NoV) const {
  const glm::dvec3 node = read(m_general[1], roughness, NoV);
  return {node.x, node.y};
}

glm::dvec3 SampledBrdf::once(const paths::EnvBrdfMaterial& material, double NoV) const {
  const glm::dvec3 F0 = m_options.nonmetal ? glm::dvec3(kF0[0]) : material.F0();
  const double roughness = std::max(material.roughness, static_cast<double>(m_options.roughnessFloor));
  if (material.fullyRough || m_options.fullyRough) return 0.45 * F0;
  if (material.nonmetal || m_options.nonmetal) return glm::dvec3(read(m_nonmetal, roughness, NoV).z);
  const glm::dvec3 low = read(m_general[0], roughness, NoV), high = read(m_general[1], roughness, NoV);
  const glm::dvec3 share = glm::clamp((F0 - double(kF0[0])) / double(kF0[1] - kF0[0]), 0.0, 1.0);
  const glm::dvec3 A = glm::mix(glm::dvec3(low.x), glm::dvec3(high.x), share);
  const glm::dvec3 B = glm::mix(glm::dvec3(low.y), glm::dvec3(high.y), share);
  return F0 * A + B;
}

std::string SampledBrdf::form(const paths::EnvBrdfMaterial& material) const {
  if (material.fullyRough || m_options.fullyRough) return "fully rough";
  return material.nonmetal || m_options.nonmetal ? "nonmetal" : "general";
}

} // namespace parity::mobile
