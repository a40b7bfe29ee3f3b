// Learns from a few samples of neighbouring texels how the many that follow are best taken.
#pragma once

#include <array>

#include "bake/light/gather.h"

namespace parity::bake {

class GuideTraining {
public:
  // A sample (gatherSample) that an even guide took, at u of the unit square, by kTrainingShares.
  void add(const glm::dvec2& u, const GatherSample& sample);

  // More samples where light varies within a cell: in proportion to its standard deviation there, by which the
  // variance of the sum is least (Neyman 1934), with some for what the few samples may have missed.
  DirectionGuide guide() const;
  // Samples of emitters and of the sky per sample of a direction: the ratio of their standard deviation to that within
  // the cells, as a power of two, 1 / kMostSkipped to 1.
  GatherShares shares() const;

private:
  struct Moments {
    double count = 0, sum = 0, squares = 0;
    void add(double value) {
      ++count;
      sum += value;
      squares += value * value;
    }
    double mean() const { return count > 0 ? sum / count : 0; }
    double deviation() const;
  };
  std::array<Moments, DirectionGuide::kCells> m_cells{};
  Moments m_emitters, m_sky;
};

// Those of the samples that are learnt from.
inline constexpr GatherShares kTrainingShares{.emitterSkips = 2, .skySkips = 2};

} // namespace parity::bake
