#include "study/plot/env_brdf.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace parity::plot {

namespace {

Plotted plottedOf(const paths::Path& path, const paths::Options& options) {
  Plotted plotted{path.title(), path.environmentBrdf(options), {}};
  if (!plotted.brdf)
    throw base::Error(base::ExitCode::usage, "--paths", path.name(),
                      "has no environment BRDF that plot can draw: it has none, or has one only in its shader");
  plotted.words = plotted.brdf->words();
  return plotted;
}

} // namespace

PlottedPair pairOf(const std::vector<const paths::Path*>& paths, const paths::Options& options) {
  if (paths.size() != 2) throw base::Error(base::ExitCode::usage, "--paths", "", "plot needs two paths");
  return {plottedOf(*paths[0], options), plottedOf(*paths[1], options)};
}

Deviation deviationOf(const PlottedPair& pair, double F0) {
  constexpr int kCells = 96;
  Deviation deviation;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      const double roughness = 0.05 + 0.95 * (j + 0.5) / kCells, NoV = 0.05 + 0.95 * (i + 0.5) / kCells;
      const glm::dvec3 color(F0);
      const double error =
          pair.test.brdf->once(roughness, NoV, color).x - pair.reference.brdf->once(roughness, NoV, color).x;
      deviation.max = std::max(deviation.max, std::abs(error));
      deviation.rms += error * error;
    }
  deviation.rms = std::sqrt(deviation.rms / (kCells * kCells));
  return deviation;
}

} // namespace parity::plot
