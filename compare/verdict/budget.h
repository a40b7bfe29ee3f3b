// Budgets: how far apart two paths may look, per material and for the whole image, and who is judged by which rule.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/pooling/figures.h"
#include "compare/pooling/statistic.h"
#include "compare/verdict/check.h"

namespace parity::compare {

// One limit on one figure. Beyond `warn` it warns, beyond `fail` it fails; at least one is set. Beyond is above for
// figures of which less is better, below where more is (psnr, ssim), and above in absolute value for signed ones
// (bias). As a regression: worse than in the baseline by more than the limit, in the figure's own unit.
struct BudgetCheck {
  Statistic statistic;
  std::optional<double> warn, fail;
};

// The limits for all materials (or whole images) whose names match. All of them have to hold.
struct BudgetRule {
  std::string material = "*", scene = "*"; // globs (base/text/glob.h); `material` is not used for whole images
  std::vector<BudgetCheck> checks;         // on the figures themselves
  std::vector<BudgetCheck> regress; // against a baseline; in a loaded file the two are both empty only with noLimit
  bool requireSeen = false;         // a material that no view shows, or only too small, fails
  std::uint64_t minPixels = kDefaultMinPixels; // a material of fewer pixels in a view is too small to be judged there
  std::string reason, owner;                   // why these limits, and whom to ask; shown in the report
  std::string origin;                          // "built-in", or "budgets.toml, line 12"
  std::string file;                            // as it was given to loadBudgets; empty: built-in
  int line = 0;
  std::string preset = {};                        // whose limits it took; empty: none
  std::vector<Accept> accept = {};                // what is accepted for `reason`, which then is not empty
  std::optional<std::uint64_t> maxNonFinite = {}; // set where nonFinite is accepted
};

// The rule as a report tells it.
AppliedRule appliedOf(const BudgetRule& rule);

// The first rule that matches judges; a name that none matches cannot be judged, which is an error and never a pass.
struct Budgets {
  std::vector<BudgetRule> materials, wholes;
};

// Limits for a mobile path (ue4-2020) against the full high-end one. For an even grey, FLIP = 0.0575 dL*^0.7
// (docs/flip-metric.md 4; dL* of CIELAB), so at 20 % grey a mean of 0.03 is one step of 8 bit, 0.10 is 10 % more or
// less light, 0.20 is 29 % more or 24 % less, 0.30 is 54 % more, 0.50 is 2.3 times as much or a third. Materials:
// flip.mean warns at 0.10 (seen side by side; approximated environment BRDFs stay below), fails at 0.20 (seen without a
// side by side: a light or a lobe is missing). flip.p95 warns at 0.30, fails at 0.50: a twentieth of the surface may
// hold displaced highlights, which a cheaper lobe always has, but not lost ones. Whole images: the same for p95;
// flip.mean 0.08 and 0.16, as errors of materials should average out. Both: bias.ev warns from 0.25 EV (19 % more
// light), fails from 0.5 (41 %): light before it is clipped, so that white on white does not hide it.
const Budgets& defaultBudgets();

// A named list of checks that rules refer to by `preset`.
struct BudgetPreset {
  std::string name, summary;
  std::vector<BudgetCheck> materials, wholes; // for either kind of rule
};
// "default": the limits of defaultBudgets(); "strict": half of them; "identical": no pixel may differ.
const std::vector<BudgetPreset>& builtInPresets();

// Reads a budget file (format: budgets.example.toml). The built-in rules are appended, for what no rule of the file
// matches. Throws Error (exit 4) "file: line N: reason" for: a syntax error; an unknown key, metric, region or preset
// (with the nearest known name); a wrong type; no rules; a rule without checks; a check without limit; the same check
// twice; a limit that is NaN, infinite, outside its figure's range or so at its end that no value is beyond it; warn
// beyond fail; a rule that an earlier one hides wholly; something accepted without a reason, or that contradicts the
// rule.
Budgets loadBudgets(const std::filesystem::path& file);
// The text of such a file, within the limit of its size. Throws Error (exit 4).
std::string readBudgetText(const std::filesystem::path& file);
// The same of the text of that file, which is not read.
Budgets readBudgets(std::string_view text, const std::filesystem::path& file);

// The rules in words, one a line in the order in which they are tried, their limits below them: parity budget check.
std::string describeBudgets(const Budgets& budgets);

// The figures that the rules' checks and regressions name, each once: what a run has to measure to be judged.
std::vector<std::string> requiredStatistics(const Budgets& budgets);

// The first rule that matches, or null.
const BudgetRule* findMaterialRule(const Budgets& budgets, std::string_view scene, std::string_view material);
const BudgetRule* findWholeRule(const Budgets& budgets, std::string_view scene);

// Mean luminance, 1 being white at the picture's exposure, below which a difference of exposure is not judged: sRGB
// shows it as 7 of 255, and of so little light a quarter of a stop is about one step of 8 bits.
inline constexpr double kLeastLuminance = 0.002;

// Why a check of this figure says nothing where both pictures are so dark; empty where it does.
std::string describeTooDark(std::string_view metric, const Figures& figures);

// Holds figures against each limit of the rule, in its order, then the regressions, which stay not judged until
// compareWithBaseline (report/baseline.h) judges them. Empty where there is no pixel. A figure that is NaN or
// was not measured gives Verdict::error; an identical image (psnr = +infinity) passes any psnr limit. bias.ev stays not
// judged where both mean luminances are below kLeastLuminance.
std::vector<CheckResult> runChecks(const BudgetRule& rule, const Figures& figures);

// The verdict on a value by a check's limits: error for NaN.
Verdict judgeLevel(Better better, double value, const std::optional<double>& warn, const std::optional<double>& fail);

// A scene of a run, as far as its rules matter.
struct JudgedScene {
  std::string name;
  bool isError = false; // it could not be compared: its rules are taken as used
  std::vector<AppliedRule> materials, wholes;
};

// One line for the rules of a file that judged nothing, empty where there are none: a misspelt glob is a limit that
// nobody checks. Rules for scenes that could not be compared are left out.
std::string describeUnusedRules(const Budgets& budgets, const std::vector<JudgedScene>& scenes);

} // namespace parity::compare
