// Limits as idiff has them, on any figure: what --metric, --fail, --failpercent and the like ask for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/verdict/budget.h"

namespace parity::compare {

// The limits given behind one --metric. `metric` is a pooled figure ("flip.mean", "psnr"): fail and warn are its
// limits; or a metric that has a value for each pixel ("flip", "deltae"): they are limits for a pixel, of which
// failPercent and warnPercent of the pixels may be beyond (0 unless given), as idiff has it. hardFail and hardWarn: no
// pixel may be beyond, in either case.
struct Threshold {
  std::string metric; // empty: the pair's own FLIP, pixel by pixel: flip, or hdrflip for HDR pairs
  std::optional<double> fail, warn, failPercent, warnPercent, hardFail, hardWarn;
};

// As checks over all pixels of a region. A pixelwise limit becomes one on "flip.fraction_over(LIMIT)". Throws Error
// (usage) for an unknown name (with the nearest known one), a metric that has no such limits, percents without their
// limit or of a pooled figure, a limit that is not finite, outside its figure's range or that nothing can be beyond, a
// warning that could only come with a failure, and a threshold without any.
std::vector<BudgetCheck> makeChecks(const std::vector<Threshold>& thresholds, bool hdr);

// The same limits for an alpha channel, which is measured as a displayed picture: FLIP in the place of HDR-FLIP.
std::vector<BudgetCheck> checksOfAlpha(std::vector<BudgetCheck> checks);
std::string figureOfAlpha(const std::string& figure); // "flip.mean" of "hdrflip.mean"; else the same

} // namespace parity::compare
