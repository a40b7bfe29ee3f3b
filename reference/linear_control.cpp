#include "reference/linear_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parity::reference {

namespace {

// Beyond this a block is so much wider than the lobe that a line through it says nothing.
constexpr double kMostSteepness = 0.6;
// Blocks that give less than this share of what the point shows are not worth the fit.
constexpr double kLeastShare = 1e-4;

} // namespace

LinearControl::LinearControl(const EnvironmentSampler& environment, const ProductSampler& product,
                             const glm::dvec3& normal, const Lobe& lobe)
    : m_fits(1), m_fitOf(product.nodes().size(), 0), m_remainders(product.nodes().size(), 1) {
  const double least = kLeastShare * product.shown();
  for (std::size_t i = 0; i < m_fitOf.size(); ++i) {
    const ProductSampler::Node& node = product.nodes()[i];
    if (node.below || node.steepness > kMostSteepness || !(node.weight > least)) continue;
    const BlockFrame frame = environment.light().frame(node.block);
    if (glm::dot(frame.middle, normal) <= std::sin(frame.radius)) continue;
    Fit fit;
    const auto addSlope = [&](const glm::dvec3& tangent, double half) {
      const double angle = half * std::numbers::inv_sqrt3, sine = std::sin(angle), cosine = std::cos(angle);
      const glm::dvec3 ahead = lobe(frame.middle * cosine + tangent * sine);
      const glm::dvec3 behind = lobe(frame.middle * cosine - tangent * sine);
      fit.constant += 0.25 * (ahead + behind);
      fit.slope += glm::outerProduct((ahead - behind) / (2 * sine), tangent);
    };
    addSlope(frame.along, frame.halfWidth);
    addSlope(frame.down, frame.halfHeight);
    const PanoramaBlock cell = node.block.level <= 0 ? LightPyramid::cellOf(node.block) : PanoramaBlock();
    const LightMoments moments = environment.light().moments(node.block, glm::vec3(environment.cell(cell.x, cell.y)));
    m_integral += fit.constant * glm::dvec3(moments.light) + fit.slope[0] * glm::dvec3(moments.x) +
                  fit.slope[1] * glm::dvec3(moments.y) + fit.slope[2] * glm::dvec3(moments.z);
    m_fitOf[i] = static_cast<std::uint32_t>(m_fits.size());
    m_fits.push_back(fit);
    // What a line leaves is of second order.
    m_remainders[i] = std::clamp(4 * node.steepness * node.steepness, 0.1, 1.0);
  }
}

} // namespace parity::reference
