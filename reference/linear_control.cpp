#include "reference/linear_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parity::reference {

namespace {

// Beyond this a block is so much wider than the lobe that a line through it says nothing.
constexpr double kMostSteepness = 0.6;
// Blocks that give less than this share of what the point shows are not worth the fit.
constexpr double kLeastFittedShare = 1e-4;

// Gauss's two nodes on the arc through a block's middle.
struct Nodes {
  double sine; // of their angle to the middle
  glm::vec3 ahead, behind;

  Nodes(const glm::dvec3& middle, const glm::dvec3& tangent, double half) {
    const double angle = half * std::numbers::inv_sqrt3, angle2 = angle * angle;
    // Series: blocks are less than 0.2 wide.
    sine = angle * (1 - angle2 / 6 * (1 - angle2 / 20));
    const double cosine = 1 - angle2 / 2 * (1 - angle2 / 12);
    ahead = glm::vec3(middle * cosine + tangent * sine);
    behind = glm::vec3(middle * cosine - tangent * sine);
  }
};

} // namespace

LinearControl::LinearControl(const EnvironmentSampler& environment, const ProductSampler& product,
                             const glm::dvec3& normal, const Lobe& lobe)
    : m_fits(1), m_fitOf(product.nodes().size(), 0), m_remainders(product.nodes().size(), 1) {
  const double least = kLeastFittedShare * product.shown();
  for (std::size_t i = 0; i < m_fitOf.size(); ++i) {
    const ProductSampler::Node& node = product.nodes()[i];
    if (node.below || node.steepness > kMostSteepness || !(node.weight > least)) continue;
    const BlockFrame frame = environment.light().frame(node.block);
    if (glm::dot(frame.middle, normal) <= frame.radius) continue;
    const Nodes along(frame.middle, frame.along, frame.halfWidth), down(frame.middle, frame.down, frame.halfHeight);
    const FourDirections nodes = {{along.ahead.x, along.behind.x, down.ahead.x, down.behind.x},
                                  {along.ahead.y, along.behind.y, down.ahead.y, down.behind.y},
                                  {along.ahead.z, along.behind.z, down.ahead.z, down.behind.z}};
    const std::array<Float4, 3> values = lobe(nodes);
    Fit fit;
    glm::dvec3 alongRow, alongColumn;
    for (int c = 0; c < 3; ++c) {
      const Float4& v = values[static_cast<std::size_t>(c)];
      fit.constant[c] = 0.25 * (v[0] + v[1] + v[2] + v[3]);
      alongRow[c] = (v[0] - v[1]) / (2 * along.sine);
      alongColumn[c] = (v[2] - v[3]) / (2 * down.sine);
    }
    fit.slope = glm::outerProduct(alongRow, frame.along) + glm::outerProduct(alongColumn, frame.down);
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
