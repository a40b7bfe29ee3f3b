// Time against error of many settings as a picture: the only one of its kind, for pages and for documents.
#pragma once

#include <string>
#include <vector>

#include "study/sweep/pareto.h"

namespace parity::sweep {

struct ParetoDot {
  std::string path, name, details; // details: further lines of its tooltip
  double time = 0, error = 0;      // above 0
  bool dominated = false;
};

struct ParetoPlot {
  std::string timeTitle, timeUnit, errorTitle;
  std::vector<ParetoDot> dots;
  bool namesDominated = false; // else only those of the fronts have their names beside them
};

// Those settings of that stage that can be shown: an error of 0 cannot.
ParetoPlot plotOf(const SceneSweep& scene, Stage stage, Against against, const std::string& figure);

// An SVG: logarithmic axes, time to the right, error upwards; a dot a setting, the larger one named "default"; one
// colour a path, dominated ones grey, each path's front as a line. Its looks are attributes, on white: a page's style
// sheet goes before them. Empty for fewer than two dots.
std::string toSvg(ParetoPlot plot);

// The pictures that go with the scenes of bench.json, in its order:
// [[{"stage": "shading", "against": "truth", "svg": "<svg"...}, ...], ...].
std::string paretoJson(const SweepReport& report, Against against, const std::string& figure);

} // namespace parity::sweep
