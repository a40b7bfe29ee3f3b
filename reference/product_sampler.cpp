#include "reference/product_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reference/four_directions.h"
#include "scenes/luminance.h"
#include "shading/shading.h"

namespace parity::reference {

namespace {

namespace f64 = shading::f64;
using lighting::larger, lighting::smaller, lighting::squareRoot;

// Blocks of this radius and more are divided wherever they are.
constexpr float kLargestRadius = 0.2f;
// A block is divided where its half vectors spread over more than this share of the lobe's width there.
constexpr double kSteepness = 0.25;
// ... and where it gives more than this share of all that the point shows.
constexpr double kLeastDividedShare = 1e-3;
// A block is as steep as this many times its radius over its cosine, at least: towards the horizon lobes fall to 0.
constexpr float kHorizonSteepness = 0.2f;
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
  addFour({light.whole(), light.whole(), light.whole(), light.whole()}, lobe);
  m_nodes.resize(1);
  double total = m_nodes.front().weight;
  // Level by level, so that the total is known better and better.
  for (std::size_t begin = 0; begin < m_nodes.size();) {
    const std::size_t end = m_nodes.size();
    double divided = 0, parts = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Node node = m_nodes[i];
      const bool matters = node.steepness > kSteepness && node.weight > kLeastDividedShare * (total + besides);
      if (node.block.level == kFinestLevel || !(node.weight > 0) || !(node.isLarge || matters)) continue;
      m_nodes[i].below = static_cast<std::uint32_t>(m_nodes.size());
      divided += node.weight;
      const int level = node.block.level - 1, x = 2 * node.block.x, y = 2 * node.block.y;
      addFour({{{level, x, y}, {level, x + 1, y}, {level, x, y + 1}, {level, x + 1, y + 1}}}, lobe);
      for (std::size_t child = m_nodes[i].below; child < m_nodes.size(); ++child) parts += m_nodes[child].weight;
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

void ProductSampler::addFour(const std::array<PanoramaBlock, 4>& blocks, const ProductLobe& lobe) {
  std::array<double, 4> power{};
  FourDirections middle;
  Float4 radius{};
  for (int i = 0; i < 4; ++i) {
    power[i] = m_light.power(blocks[i]);
    if (!(power[i] > 0)) continue;
    const BlockFrame frame = m_light.frame(blocks[i]);
    middle.x[i] = static_cast<float>(frame.middle.x);
    middle.y[i] = static_cast<float>(frame.middle.y);
    middle.z[i] = static_cast<float>(frame.middle.z);
    radius[i] = static_cast<float>(frame.radius);
  }
  const glm::vec3 normal(lobe.normal), view(lobe.view);
  const FourCosines at(normal, view, middle);
  // Blocks across the horizon: about the mean cosine of the part above it.
  const Float4 NoL = 0.5f * (at.NoL + squareRoot(at.NoL * at.NoL + 0.25f * radius * radius));
  Float4 steepness = kHorizonSteepness * radius / NoL;
  Float4 reflected = Float4{} + static_cast<float>(lobe.lambert * f64::Fd_Lambert());
  if (lobe.F0 > 0 || lobe.F90 > 0) {
    const float NoV = glm::dot(normal, view), alpha2 = static_cast<float>(lobe.alpha * lobe.alpha);
    const Float4 spread = 0.5f * radius / larger(at.VoH, Float4{} + 0.05f);
    const auto F0 = static_cast<float>(lobe.F0), F90 = static_cast<float>(lobe.F90);
    Float4 F = F0 + (F90 - F0) * schlickWeight(at.VoH);
    if (lobe.luminanceOfFilm)
      for (int i = 0; i < 4; ++i)
        if (power[i] > 0) F[i] = static_cast<float>(lobe.luminanceOfFilm(std::min<double>(at.VoH[i], 1)));
    if (lobe.stretched) {
      const FourStretched stretched(*lobe.stretched, normal, view, middle, at, NoL, spread);
      steepness = larger(steepness, stretched.steepness());
      reflected += F * stretched.value;
    } else {
      steepness = larger(steepness, spread / squareRoot(alpha2 + at.tan2));
      const Float4 widened = smaller(alpha2 + 0.25f * spread * spread, Float4{} + 1.f);
      reflected += F * D_GGX(widened, at.tan2) * V_SmithGGXCorrelated(widened, NoV, NoL);
    }
  }
  if (lobe.sheen) {
    const float NoV = glm::dot(normal, view);
    const Float4 spread = 0.5f * radius / larger(at.VoH, Float4{} + 0.05f);
    steepness = larger(steepness, lobe.sheen->steepness(at.tan2, spread));
    reflected +=
        static_cast<float>(scenes::luminanceOf(lobe.sheen->color())) * lobe.sheen->estimate(NoV, NoL, at.tan2, spread);
  }
  const Float4 weight = reflected * NoL;
  for (int i = 0; i < 4; ++i) {
    Node node;
    node.block = blocks[i];
    node.isLarge = radius[i] > kLargestRadius;
    if (power[i] > 0 && at.NoL[i] > -radius[i]) {
      node.steepness = steepness[i];
      node.weight = power[i] * static_cast<double>(weight[i]);
    }
    m_nodes.push_back(node);
  }
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
