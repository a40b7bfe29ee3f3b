// The environment BRDFs of two paths, the second held against the first.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "paths/path.h"

namespace parity::plot {

struct Plotted {
  std::string title; // paths::Path::title()
  std::unique_ptr<const paths::EnvBrdf> brdf;
  paths::EnvBrdfWords words;
};
struct PlottedPair {
  Plotted reference, test;
};
// Throws Error (usage) where they are not two, or one of them has no environment BRDF by itself.
PlottedPair pairOf(const std::vector<const paths::Path*>& paths, const paths::Options& options);

// Absolute errors of F0 A + B over the middles of 96 x 96 cells of roughness and NoV from .05 to 1.
struct Deviation {
  double max = 0, rms = 0;
};
Deviation deviationOf(const PlottedPair& pair, double F0);

} // namespace parity::plot
