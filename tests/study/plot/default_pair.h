// The two paths that are compared where nothing else is asked for, with a preset of the mobile one.
#pragma once

#include "highend/options.h"
#include "highend/path.h"
#include "mobile/options.h"
#include "mobile/path.h"
#include "study/plot/env_brdf.h"

namespace parity::plot {

inline PlottedPair pairWith(const std::string& preset, const highend::Options& highend = {}) {
  paths::Options options;
  options.of<highend::Options>() = highend;
  options.of<mobile::Options>() = mobile::presetByName(preset);
  return pairOf({&highend::path(), &mobile::path()}, options);
}

} // namespace parity::plot
