// Time against error of all settings of a scene, as a picture.
#pragma once

#include <string>

#include "sweep/pareto.h"

namespace parity::sweep {

// An SVG for a page: logarithmic axes, time to the right, error upwards; a dot a setting of that stage with all its
// knobs as its tooltip, one colour a path, dominated ones grey, each path's front as a line. Empty where fewer than two
// settings can be shown: an error of 0 cannot.
std::string paretoSvg(const SceneSweep& scene, Stage stage, Against against, const std::string& figure);

// The same as a file of its own: with its colours, on white. Empty where that is.
std::string paretoFile(const SceneSweep& scene, Stage stage, Against against, const std::string& figure);

} // namespace parity::sweep
