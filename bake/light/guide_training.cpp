#include "bake/light/guide_training.h"

#include <algorithm>
#include <cmath>

namespace parity::bake {

namespace {

constexpr int kMostSkips = 3;
// Deviation that a cell has for each part of its mean: neighbours see what is in it elsewhere.
constexpr double kOfMean = 0.2;
// Weight of a cell's eight neighbours to its own, as features move from texel to texel.
constexpr double kOfNeighbours = 0.3;
// Share of the mean over all cells that each has: the few samples did not see everything.
constexpr double kFloor = 0.5;

using Cells = std::array<double, DirectionGuide::kCells>;

Cells blur(const Cells& cells) {
  constexpr int kRows = DirectionGuide::kRows, kColumns = DirectionGuide::kColumns;
  Cells result{};
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      double sum = 0, weights = 0;
      for (int row = std::max(y - 1, 0); row <= std::min(y + 1, kRows - 1); ++row)
        for (const int dx : {kColumns - 1, 0, 1}) {
          const double weight = row == y && dx == 0 ? 1 : kOfNeighbours;
          sum += weight * cells[static_cast<std::size_t>(row * kColumns + (x + dx) % kColumns)];
          weights += weight;
        }
      result[static_cast<std::size_t>(y * kColumns + x)] = sum / weights;
    }
  return result;
}

double meanOf(const Cells& cells) {
  double sum = 0;
  for (const double cell : cells) sum += cell;
  return sum / static_cast<double>(cells.size());
}

} // namespace

double GuideTraining::Moments::deviation() const {
  return count > 0 ? std::sqrt(std::max(squares / count - mean() * mean(), 0.0)) : 0;
}

void GuideTraining::add(const glm::dvec2& u, const GatherSample& sample) {
  const double all = lightmapLuminance(sample.sum.irradiance + sample.sum.back);
  m_cells[DirectionGuide::cellOf(u)].add(all - sample.emitters.value_or(0) - sample.sky.value_or(0));
  if (sample.emitters) m_emitters.add(*sample.emitters);
  if (sample.sky) m_sky.add(*sample.sky);
}

DirectionGuide GuideTraining::guide() const {
  Cells wanted{};
  for (std::size_t i = 0; i < wanted.size(); ++i)
    wanted[i] = std::hypot(m_cells[i].deviation(), kOfMean * m_cells[i].mean());
  wanted = blur(wanted);
  const double mean = meanOf(wanted);
  if (!(mean > 0) || !std::isfinite(mean)) return {};
  for (double& cell : wanted) cell += kFloor * mean;
  return DirectionGuide(wanted);
}

GatherShares GuideTraining::shares() const {
  Cells deviations{};
  for (std::size_t i = 0; i < deviations.size(); ++i) deviations[i] = m_cells[i].deviation();
  const double within = meanOf(deviations);
  const auto skipsFor = [&](const Moments& moments) {
    int skips = 0;
    while (skips < kMostSkips && std::ldexp(moments.deviation(), skips) < within) ++skips;
    return skips;
  };
  return {.emitterSkips = skipsFor(m_emitters), .skySkips = skipsFor(m_sky)};
}

} // namespace parity::bake
