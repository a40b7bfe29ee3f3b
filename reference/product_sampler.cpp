#include "reference/product_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shading/shading.h"

namespace parity::reference {

namespace {

namespace f64 = shading::f64;

// Blocks of this radius and more are divided wherever they are.
constexpr double kLargestRadius = 0.2;
// A block is divided where its half vectors spread over more than this share of the lobe's width there.
constexpr double kSteepness = 0.25;
// ... and where it gives more than this share of all that the point shows.
constexpr double kLeastShare = 1e-3;
// A block is as steep as this many times its radius over its cosine, at least: towards the horizon lobes fall to 0.
constexpr double kHorizonSteepness = 0.2;
// Cells are divided this often.
constexpr int kFinestLevel = -6;
constexpr double kBelowOne = 1 - 0x1p-53;

// Chooses a quarter, rows first, and stretches what the choice leaves of u to the unit square again.
struct Choice {
  int x, y;
};
int choose(double share, double& u) {
  const bool second = u >= share;
  u = std::min((second ? u - share : u) / (second ? 1 - share : share), kBelowOne);
  return second;
}
Choice choose(const LightShares& shares, glm::dvec2& u) {
  const int y = choose(shares.upper, u.y);
  return {choose(y ? shares.leftOfLower : shares.leftOfUpper, u.x), y};
}

} // namespace

ProductSampler::ProductSampler(const LightPyramid& light, const ProductLobe& lobe, double besides)
    : m_light(light), m_besides(besides) {
  m_nodes.reserve(1024);
  m_nodes.push_back(makeNode(light.whole(), lobe));
  double total = m_nodes.front().weight;
  // Level by level, so that the total is known better and better.
  for (std::size_t begin = 0; begin < m_nodes.size();) {
    const std::size_t end = m_nodes.size();
    double divided = 0, parts = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Node node = m_nodes[i];
      const bool matters = node.steepness > kSteepness && node.weight > kLeastShare * (total + besides);
      if (node.block.level == kFinestLevel || !(node.weight > 0) || !(node.isLarge || matters)) continue;
      m_nodes[i].below = static_cast<std::uint32_t>(m_nodes.size());
      divided += node.weight;
      for (int child = 0; child < 4; ++child) {
        m_nodes.push_back(
            makeNode({node.block.level - 1, 2 * node.block.x + child % 2, 2 * node.block.y + child / 2}, lobe));
        parts += m_nodes.back().weight;
      }
    }
    total += parts - divided;
    begin = end;
  }
  sumUp();
}

void ProductSampler::sumUp() {
  for (std::size_t i = m_nodes.size(); i-- > 0;)
    if (m_nodes[i].below) {
      const Node* quarters = m_nodes.data() + m_nodes[i].below;
      m_nodes[i].weight = (quarters[0].weight + quarters[1].weight) + (quarters[2].weight + quarters[3].weight);
      m_nodes[i].shares = sharesOf(quarters[0].weight, quarters[1].weight, quarters[2].weight, quarters[3].weight);
    }
  m_total = m_nodes.front().weight;
}

void ProductSampler::scale(const std::vector<double>& factors) {
  for (std::size_t i = 0; i < m_nodes.size(); ++i) m_nodes[i].weight *= factors[i];
  sumUp();
}

ProductSampler::Node ProductSampler::makeNode(const PanoramaBlock& block, const ProductLobe& lobe) const {
  Node node{.block = block};
  const double power = m_light.power(block);
  if (!(power > 0)) return node;
  const BlockFrame frame = m_light.frame(block);
  const glm::dvec3& L = frame.middle;
  const double radius = frame.radius, height = glm::dot(lobe.normal, L);
  node.isLarge = radius > kLargestRadius;
  if (radius < std::numbers::pi / 2 && height <= -std::sin(radius)) return node;
  // Blocks across the horizon: about the mean cosine of the part above it.
  const double NoL = 0.5 * (height + std::sqrt(height * height + 0.25 * radius * radius));
  node.steepness = kHorizonSteepness * radius / NoL;
  double reflected = lobe.lambert * f64::Fd_Lambert();
  if (lobe.F0 > 0 || lobe.F90 > 0) {
    const glm::dvec3 sum = lobe.view + L;
    const double length2 = glm::dot(sum, sum);
    const double VoH = std::max(0.5 * std::sqrt(length2), 0.05); // of half of the angle between them
    const double NoV = glm::dot(lobe.normal, lobe.view), across = NoV + height;
    const double NoH2 = length2 > 1e-12 ? std::clamp(across * across / length2, 1e-6, 1.0) : 1;
    const double spread = radius / (2 * VoH), tan2 = 1 / NoH2 - 1;
    node.steepness = std::max(node.steepness, spread / std::sqrt(lobe.alpha * lobe.alpha + tan2));
    const double alpha = std::sqrt(std::min(lobe.alpha * lobe.alpha + 0.25 * spread * spread, 1.0));
    const double F = lobe.F0 + (lobe.F90 - lobe.F0) * f64::schlickWeight(std::min(VoH, 1.0));
    reflected += F * f64::D_GGX(alpha, std::sqrt(NoH2)) * f64::V_SmithGGXCorrelated(alpha, NoV, NoL);
  }
  node.weight = power * reflected * NoL;
  return node;
}

ProductSampler::Sample ProductSampler::sample(const glm::dvec2& at) const {
  glm::dvec2 u = at;
  const Node* node = m_nodes.data();
  while (node->below) {
    const Node* first = m_nodes.data() + node->below;
    const Choice choice = choose(node->shares, u);
    node = first + 2 * choice.y + choice.x;
  }
  PanoramaBlock block = node->block;
  while (block.level > 0) {
    const Choice choice = choose(m_light.shares(block), u);
    block = {block.level - 1, 2 * block.x + choice.x, 2 * block.y + choice.y};
  }
  const PanoramaBlock cell = LightPyramid::cellOf(block);
  return {cell.x, cell.y, static_cast<std::uint32_t>(node - m_nodes.data()), m_light.directionIn(block, u)};
}

std::uint32_t ProductSampler::nodeOf(const glm::dvec2& place) const {
  const auto x = static_cast<int>(std::ldexp(place.x, -kFinestLevel));
  const auto y = static_cast<int>(std::ldexp(place.y, -kFinestLevel));
  const Node* node = m_nodes.data();
  while (node->below) {
    const int level = node->block.level - 1 - kFinestLevel;
    node = m_nodes.data() + node->below + 2 * (y >> level & 1) + (x >> level & 1);
  }
  return static_cast<std::uint32_t>(node - m_nodes.data());
}

double ProductSampler::gain(std::uint32_t node) const {
  const double power = m_light.power(m_nodes[node].block);
  return power > 0 ? m_nodes[node].weight / (m_total * power) : 0;
}

} // namespace parity::reference
