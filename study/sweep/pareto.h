// Which settings are worth their time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/sweep/sweep_report.h"

namespace parity::sweep {

// What errors are taken against: the truth, or the first path's default.
enum class Against { truth, first };
// The figure "flip.mean"... of a region; none where there is no truth.
std::optional<double> errorOf(const RegionErrors& region, Against against, const std::string& figure);
// The truth where every scene has one.
Against bestKnown(const SweepReport& report);

// Device times in ms, or those of preparation where the knob costs there; none of the stage storage.
const std::vector<double>& timesOf(const VariantResult& v);

// Median of the device time, or of preparation where the knob costs there; 0 of the stage storage.
double timeOf(const VariantResult& v);

// Whether another setting of the same path and stage is as fast and as right, and better in one of the two. It is as
// fast where the quartiles of the two times overlap, so that noise decides nothing. Of a NaN error: true. Of the stage
// storage: false, as its time is not known.
std::vector<bool> findDominated(const SceneSweep& scene, Against against, const std::string& figure);

// Ids of settings that are dominated in every scene that has them.
std::vector<std::string> dominatedEverywhere(const SweepReport& report, Against against, const std::string& figure);

// "flip.mean=0.02".
struct ErrorBudget {
  std::string figure = "flip.mean";
  double limit = 0;
};
// Throws Error (usage) naming what is known.
ErrorBudget parseErrorBudget(const std::string& text);

// The fastest setting of a path whose error is within the budget; none where there is none. Knobs that cost in
// preparation are left out.
std::optional<std::string> cheapestWithin(const SceneSweep& scene, const std::string& path, Against against,
                                          const ErrorBudget& budget);
// The same over all scenes: within in each, by the sum of the times over those of the path's default.
std::optional<std::string> cheapestWithinEverywhere(const SweepReport& report, const std::string& path, Against against,
                                                    const ErrorBudget& budget);

// What a turn of one knob buys: from the faster of the two values to the slower one.
struct Purchase {
  std::string path, knob, from, to;
  double timeMs = 0;  // more, a million surface samples; median over scenes
  double error = 0;   // less; median over scenes
  double perMs = 0;   // error / timeMs
  double certain = 0; // share of scenes in which the quartiles of the two times are apart
};
// Every single knob of the stage shading against its path's default, best first. Where the two times cannot be told
// apart in most scenes, the better value is what is bought, and its time counts as 1 % of the default's: what is nearly
// free is not infinitely good.
std::vector<Purchase> rankPurchases(const SweepReport& report, Against against, const std::string& figure);

} // namespace parity::sweep
