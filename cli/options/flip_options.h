// The options of parity flip.
#pragma once

#include <string>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in; turned into a FlipCommand when all is known.
struct RawFlipOptions {
  std::string background, region, mask, alpha = "composite", maskKind = "auto", nonFinite = "error", annotate,
                                        tonemapper;
  std::string maxImage, maxMemory;
  std::string map, exposureMap, histogram, mapKind = "png";
  std::vector<std::string> metric; // one for each --metric; those below likewise
  std::vector<double> fail, warn, failPercent, warnPercent, hardFail, hardWarn;
  bool hdr = false, ldr = false, quiet = false;
  float ppd = 0, distance = 0, resolutionX = 0, screenWidth = 0; // 0: not given
};

// Both must outlive the parsing.
void addFlipOptions(CLI::App& app, FlipCommand& flip, RawFlipOptions& raw);

// After parsing. Throws CLI::ParseError for what cannot be meant.
void settleFlip(const CLI::App& app, FlipCommand& flip, const RawFlipOptions& raw);

} // namespace parity::cli
