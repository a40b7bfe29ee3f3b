// The result of a run as plain data: what report.json, junit.xml, index.html and the table are written from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/condition.h"
#include "compare/dropped_lights.h"
#include "compare/encoding.h"
#include "compare/figures.h"
#include "compare/json_writer.h"
#include "compare/pass.h"
#include "compare/permutation.h"
#include "compare/truth.h"

namespace parity::compare {

// In order of gravity; the worst of its parts is the verdict of a whole.
enum class Verdict { pass, notSeen, tooSmall, notJudged, warn, fail, error };
// "pass", "not seen", "too small" (fewer pixels than the budget's min_pixels), "not judged" (most pixels are clipped in
// both pictures), "warn", "fail", "error".
const char* nameOf(Verdict verdict);

// One budget check: `metric` names a figure ("flip.mean", "psnr", ...; compare/statistic.h).
struct CheckResult {
  std::string metric;
  bool regress = false; // `value` is not the figure but by how much it is worse than in the baseline (negative: better)
  double value = 0;     // NaN where it is not known
  std::optional<double> warnAbove, failAbove; // of a figure of which more is better, not of a regression: below
  Verdict verdict = Verdict::pass;
  std::string note;     // not empty where the value is not known: why
  std::string unjudged; // not empty: there was nothing to judge by (a regression without a baseline), this says why;
                        // the verdict then is what that is worth where nothing else judges
  bool judged() const { return unjudged.empty(); }
};

// FLIP's filters are 21 pixels wide: of fewer pixels than these its mean says little.
inline constexpr std::uint64_t kDefaultMinPixels = 64;

// The budget rule that judged something.
struct AppliedRule {
  std::string origin;        // "built-in", or "budgets.toml, line 12"; empty where no rule matched
  std::string reason, owner; // why these limits, and whose they are; may be empty
  bool requireSeen = false;
  std::uint64_t minPixels = kDefaultMinPixels; // a material of fewer is too small to be judged
  std::string file;        // as the user named it, for annotations: may be absolute, so it is in no report
  int line = 0;            // in it; 0: the rule stands in no file
  std::string preset = {}; // whose limits it took; empty: none, all are its own
};

// What a figure was in the baseline and is now; either may be infinite (psnr).
struct FigureChange {
  std::string metric;
  double before = 0, now = 0;
  double change() const { return before == now ? 0 : now - before; } // also of infinities
};

// How a material or a whole image compares to the baseline's of the same name.
struct BaselineChange {
  bool isNew = false;                // the baseline does not show it: all else is empty
  Verdict before = Verdict::pass;    // the verdict that it had there
  std::vector<FigureChange> changes; // of figures that both have, in this report's order; empty without
                                     // pixels, and where the baseline's were NaN or infinite
  std::string notComparable = {};    // not empty: the conditions of its figures differ, these do; there are no changes
};

// Paths relative to the report folder, '/'-separated; empty where there is none.
struct ImageSet {
  std::string reference, test, flip; // PNG for display: high-end, mobile, FLIP in magma
};

// Mean scene-referred luminance of one term over the material's pixels, by both paths (only with --terms).
struct TermFigures {
  std::string term;
  double reference = 0, test = 0;
};

// What a material's FLIP becomes once one of mobile's terms is the high-end path's: its colour less the one, plus the
// other, displayed and compared again (compare/attribution.h).
struct TermEffect {
  std::string term;
  double flip = 0; // mean
};

// Which term makes a material differ.
struct Attribution {
  double flip = 0;               // mean, as it is
  std::vector<TermEffect> terms; // those that are not the same in both paths there, in the order of shading::Term
};

// Files of the values behind a view's pictures (compare/pixel_chunk.h), relative to the report folder; empty where
// there is none.
struct PixelFiles {
  std::string color; // both paths (and the truth), FLIP, which material is where
  std::string terms; // both paths' terms
};

struct MaterialResult {
  std::string name;
  Figures figures; // high-end against high-end with this material's mobile colours (compare/measure_swaps.h)
  std::vector<CheckResult> checks;
  Verdict verdict = Verdict::pass;
  std::string reason;                   // all that decided the verdict; empty on a pass
  std::vector<std::string> notModelled; // parts of it that no path models ("clearcoat"): only its base layer is judged
  std::vector<std::string> notes;       // permutation ("nonmetal", "fully rough"), sampler excess, tinted F0, ...
  std::vector<TermFigures> terms;
  ImageSet crops; // around the material's pixels; empty where it is not seen
  AppliedRule rule;
  std::optional<BaselineChange> baseline;     // only where there is one
  std::optional<Truth> truth;                 // only with --reference
  std::optional<Encoding> encoding;           // what mobile's render target alone makes; none in older reports
  std::optional<TextureCompression> textures; // what mobile's compressed textures alone make; where they are
  std::optional<Attribution> attribution;     // of a material over budget, or as the run was asked
  bool seenElsewhere = false; // set by settleVerdicts: not seen here, but in another view, so it does not count
};

struct ViewResult {
  std::string name;
  int width = 0, height = 0;
  Figures whole; // high-end against mobile, over all pixels of any material
  std::vector<CheckResult> checks;
  AppliedRule rule;                           // of the whole image
  std::optional<BaselineChange> baseline;     // of the whole image; only where there is one
  std::optional<Truth> truth;                 // of the whole image; only with --reference
  std::optional<Encoding> encoding;           // of the whole image
  std::optional<TextureCompression> textures; // of the whole image
  Verdict verdict = Verdict::pass;            // of the view: its whole image and its materials
  Verdict wholeVerdict = Verdict::pass;       // of the whole image alone
  std::string reason;                         // all that decided wholeVerdict; empty on a pass
  std::vector<MaterialResult> materials;      // in the scene's order
  ImageSet images;
  PixelFiles pixels;
  double exposureEv = 0;                      // of its pictures: what the values of `pixels` are exposed by
  std::optional<DroppedLights> droppedLights; // where mobile drops any, and the run was asked
  std::vector<Condition> conditions;          // its camera
};

struct SceneResult {
  std::string name, source, environment, sun; // as the user wrote them: no absolute paths
  std::string light;                          // its scales and fog in words; empty: the defaults
  std::vector<std::string> warnings;
  std::vector<ViewResult> views;
  std::vector<PassResult> passes;              // in the order of the work, over all views
  std::vector<PermutationResult> permutations; // that made the pictures, by path, in order of first use
  std::string error; // not empty: the scene could not be compared, this line says why; views hold what was done before
  int errorExitCode = 0; // 3 or 4 where there is an error (settleVerdicts makes 4 of anything else)
  Verdict verdict = Verdict::pass;
  std::vector<Condition> conditions; // its light, what of the file is shown, ...
};

// What the baseline shows and this run does not: a material, a whole view (material empty) or a whole scene (both).
struct GoneRow {
  std::string scene, view, material;
};

// The earlier report that a run was held against (compare/baseline.h).
struct BaselineSummary {
  std::string source, version, device; // the file as given (without its folder, if that is absolute); what made it
  std::size_t common = 0;              // material views that both show
  std::vector<GoneRow> gone;           // not empty: at least a warning
  std::string error;                   // not empty: it could not be used, this line says why
  std::size_t notComparable = 0;       // rows that both show, under other conditions; not 0: at least a warning
};

// Why a run as a whole is no pass, whatever its rows say.
struct RunProblem {
  Verdict verdict = Verdict::error; // or fail
  std::string reason;               // one sentence
  std::string file;                 // of the budget rule that says so, as the user named it; empty: none
  int line = 0;                     // in it
};

struct Report {
  std::string tool = "parity", version;
  std::string device;                                        // Vulkan device name and driver
  std::vector<std::pair<std::string, std::string>> settings; // name, value, in a fixed order: for people
  std::vector<Condition> conditions;                         // of every scene; the device is one more
  std::string displayTable;                                  // file of the display transform as a table (PixelFiles)
  std::vector<std::string> warnings;                         // of the whole run: a rule that judges nothing, ...
  std::vector<RunProblem> lost;                              // what budgets require and no scene has (findLost)
  std::optional<BaselineSummary> baseline;
  std::vector<SceneResult> scenes;
  Verdict verdict = Verdict::pass;
};

// What differs from run to run, kept out of the report so that it is byte-identical.
struct RunInfo {
  std::string startedAt; // ISO 8601, UTC
  std::string commandLine;
  std::vector<std::pair<std::string, double>> timings; // stage, ms
  std::size_t compiledShaders = 0;                     // of all paths, the same one once
  std::vector<std::string> cachedScenes;               // whose results were taken from the cache, unchanged
};

// How many rows have each verdict.
struct VerdictCounts {
  std::size_t pass = 0, notSeen = 0, tooSmall = 0, notJudged = 0, warn = 0, fail = 0, error = 0;
  std::size_t total() const { return pass + notSeen + tooSmall + notJudged + warn + fail + error; }
};
VerdictCounts countVerdicts(const Report& report); // material x view; those not seen here but elsewhere are left out
VerdictCounts countWholes(const Report& report);   // whole images

// Whether any view was held against the ground truth.
bool hasTruth(const Report& report);

// From which share of clipped pixels (Figures::clipped) on a row warns, and above which a material is not judged.
inline constexpr double kNotableClipping = 0.05, kMostClipping = 0.5;

// Sets one material's verdict and reason from its figures and checks, and `seenElsewhere` as given (it matters only
// where there are fewer pixels than its budget's minPixels): no pixel = notSeen, few = tooSmall, or fail where its
// budget requires it to be seen and no other view shows it; non-finite pixels = fail; no checks, none that could be
// judged, a figure that is NaN or a truth that is not finite = error; else the worst check. (A rule of regressions
// alone, for a material that the baseline does not have: warn, as it is new.) Where no check fails: notJudged above
// kMostClipping, at least warn from kNotableClipping on and for parts that no path models. The reason names all checks
// and conditions that have the verdict. What is not comparable to the baseline is at least a warning.
void settleMaterial(MaterialResult& material, bool seenElsewhere);

// Sets every verdict above the checks' from its parts, also the materials' by settleMaterial (another view of the scene
// may show what this one does not: same place in the list, same name). A scene with an error, or with no view, is
// `error`; so are a view with no materials, a report with no scenes, and one whose baseline has an error. A problem of
// the run (problemsOf) is what it says; a warning of the run, and rows that are gone since the baseline, are at least a
// warning. Idempotent.
void settleVerdicts(Report& report);

// The problems of a settled report as a whole, the gravest first: an error where scenes were compared, but no material
// of theirs (all are not seen, too small or not judged), and what is lost.
std::vector<RunProblem> problemsOf(const Report& report);

// The exit code of a settled report (DESIGN 8): 0, 1 (only with warnExit; notSeen and the run's own warnings count), 2,
// or the scenes' own 3 or 4 (4 for any other errorExitCode, and for a verdict `error`); the highest that applies.
int exitCode(const Report& report, bool warnExit);

// The whole report in a sentence: "3 of 40 materials over budget".
std::string headline(const Report& report);

// The version of compare/report.schema.json: raised when a reader of the old form could misread the new one.
inline constexpr int kReportSchema = 3;

// JSON by compare/report.schema.json, UTF-8, keys in fixed order, no times: byte-identical for equal
// reports.
std::string toJson(const Report& report, JsonLayout layout = JsonLayout::indented);
std::string toJson(const RunInfo& run, JsonLayout layout = JsonLayout::indented);
// JUnit: a testcase per scene x material; failures and errors with their figures.
std::string toJunit(const Report& report, const RunInfo& run);
// Per-material table for a terminal (parity diff), one row a material and view. color: ANSI.
std::string toTable(const Report& report, bool color);
// Workflow commands of GitHub Actions: "::error ..." for each row that failed or could not be judged, "::warning ..."
// for each warning, the gravest first (only the first ten of a kind are shown), each with the place of its budget rule.
// Files below `root` (the checkout) are named relative to it. Ends with a line feed, or is empty.
std::string toGithubAnnotations(const Report& report, const std::filesystem::path& root);

} // namespace parity::compare
