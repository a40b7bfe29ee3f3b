// The preset refit as a whole, fitted to a high-end path's settings.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/fit/error_table.h"
#include "study/fit/lobe_fit.h"
#include "study/fit/sheen_fit.h"
#include "study/fit/tap_fit.h"
#include "study/fit/truth.h"

namespace parity::fit {

struct Refit {
  Settings settings;
  LobeConstants lobe;
  double spread; // Truth::spread
  TapConstants tap;
  std::vector<AlbedoError> albedo;
  DirectError direct;
  SheenFit sheen;
  double tapError, mirrorError, dominantError; // TapFit::errorOf: the tap, one read at R, one in the dominant direction
};

// Says what is being done, for a user who waits.
using Say = std::function<void(const std::string&)>;

// Every constant of shading/refit.glsl, those of sheenAlbedoFit, and the figures of all of them. The clear coat is the
// lobe at F0 = .04 without compensation. Deterministic, whatever the number of threads. Some 10 to 20 s on 2 cores.
Refit fitRefit(const Settings& settings, const Say& say);

} // namespace parity::fit
