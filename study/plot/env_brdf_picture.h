// The figure pair of Karis 2014, "EnvBRDF used on high end" and "EnvBRDFApprox used on mobile", with their difference:
// of any two paths.
#pragma once

#include <vector>

#include "study/plot/canvas.h"
#include "study/plot/env_brdf.h"
#include "study/plot/material_deviation.h"

namespace parity::plot {

// Rows: A; B; F0 A + B at F0 = .04 and at 1; what scatters more than once at F0 = 1. Columns: the
// reference, the test, test minus reference. materials: the scene's; the twelve of the greatest mean are marked and
// listed.
base::Image8 drawEnvBrdf(const PlottedPair& pair, const std::vector<MaterialDeviation>& materials,
                         const std::string& scene);

} // namespace parity::plot
