// The result of a run as plain data: what report.json, junit.xml, index.html and the table are written from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/json_writer.h"
#include "compare/metrics/attribution.h"
#include "compare/metrics/truth.h"
#include "compare/pooling/condition.h"
#include "compare/pooling/figures.h"
#include "compare/verdict/check.h"
#include "report/dropped_lights.h"
#include "report/explanation.h"
#include "report/material_card.h"
#include "report/pass.h"
#include "report/permutation.h"
#include "report/stage.h"
#include "report/what_if.h"

namespace parity::report {

// What a figure was in the baseline and is now; either may be infinite (psnr).
struct FigureChange {
  std::string metric;
  double before = 0, now = 0;
  double change() const { return before == now ? 0 : now - before; } // also of infinities
};

// The baseline's pictures where they differ from this run's: paths as in ImageSet; empty where there is none.
struct BaselineImages {
  std::string reference, test;
};

// How a material or a whole image compares to the baseline's of the same name.
struct BaselineChange {
  bool isNew = false;                               // the baseline does not show it: all else is empty
  compare::Verdict before = compare::Verdict::pass; // the verdict that it had there
  std::vector<FigureChange> changes;                // of figures that both have, in this report's order; empty without
                                                    // pixels, and where the baseline's were NaN or infinite
  std::string notComparable = {}; // not empty: the conditions of its figures differ, these do; there are no changes
  BaselineImages images = {};
};

// Paths relative to the report folder, '/'-separated; empty where there is none.
struct ImageSet {
  std::string reference, test, flip; // PNG for display; FLIP in magma
};

// Mean scene-referred luminance of one term over the material's pixels, by both paths (only with --terms).
struct TermFigures {
  std::string term;
  double reference = 0, test = 0;
};

// Files of the values behind a view's pictures (report/pixel_chunk.h), relative to the report folder; empty where
// there is none.
struct PixelFiles {
  std::string color; // both paths (and the truth), FLIP, which material is where
  std::string terms; // both paths' terms
};

// A lobe of a material that the test path leaves out.
struct DroppedLobe {
  std::string lobe; // "clear coat", "sheen", "anisotropy", "iridescence", "transmission",
                    // "diffuse transmission"
  double flip = 0;  // mean FLIP of the displayed reference picture without it against that with it, over the material
};

struct MaterialResult {
  std::string name;
  std::string test; // the view's
  compare::Figures
      figures; // the reference against itself with this material's test colours (compare/metrics/measure_swaps.h)
  std::vector<compare::CheckResult> checks;
  compare::Verdict verdict = compare::Verdict::pass;
  std::string reason;                   // all that decided the verdict; empty on a pass
  std::string accepted;                 // what its budget accepts although it is no pass, and why; empty: nothing
  std::vector<std::string> notModelled; // parts of it that no path models ("clearcoat"): only its base layer is judged
  std::vector<std::string> notes;       // permutation ("nonmetal", "fully rough"), sampler excess, tinted F0, ...
  bool isExternal = false;              // a picture of another engine takes part: its terms are not known
  std::vector<TermFigures> terms;
  ImageSet crops; // around the material's pixels; empty where it is not seen
  compare::AppliedRule rule;
  std::optional<BaselineChange> baseline;          // only where there is one
  std::optional<compare::Truth> truth;             // only with --truth
  std::vector<StageResult> stages;                 // in the order of the table's columns
  std::optional<compare::Attribution> attribution; // of a material over budget, or as the run was asked
  std::vector<DroppedLobe> droppedLobes;           // that the test path leaves out, where the run was asked
  std::vector<WhatIf> whatIf;                      // of a material that is seen, as --what-if asks
  std::optional<Explanation> explanation;          // of a material over budget, as --explain asks
  bool seenElsewhere = false; // set by settleVerdicts: not seen here, but in another view, so it does not count
};

struct ViewResult {
  std::string name;
  std::string reference = "highend", test = "mobile"; // the paths whose pictures its figures compare
  int width = 0, height = 0;
  compare::Figures whole; // reference against test, over all pixels of any material
  std::vector<compare::CheckResult> checks;
  compare::AppliedRule rule;                              // of the whole image
  std::optional<BaselineChange> baseline;                 // of the whole image; only where there is one
  std::optional<compare::Truth> truth;                    // of the whole image; only with --truth
  std::vector<StageResult> stages;                        // of the whole image
  compare::Verdict verdict = compare::Verdict::pass;      // of the view: its whole image and its materials
  compare::Verdict wholeVerdict = compare::Verdict::pass; // of the whole image alone
  std::string reason;                                     // all that decided wholeVerdict; empty on a pass
  std::string accepted;                                   // of the whole image, as of a material
  std::vector<MaterialResult> materials;                  // in the scene's order
  ImageSet images;
  PixelFiles pixels;
  double exposureEv = 0;                      // of its pictures: what the values of `pixels` are exposed by
  std::optional<DroppedLights> droppedLights; // where the test drops any, and the run was asked
  std::vector<compare::Condition> conditions; // its camera
};

// What decides a scene's figures besides the settings of the run, as digests of 12 hexadecimal digits: who compares two
// runs learns which of them is another one. Names and places of files do not count, their content does.
struct SceneInputs {
  std::string asset;       // the scene's file, its buffers and its images
  std::string environment; // empty: none
  std::string request;     // what is asked of the scene otherwise than of the run, and its views
  std::string bake;        // its baked light; empty: none
  std::string pictures{};  // of other engines; empty: none
};

struct SceneResult {
  std::string name, source, environment, sun; // as the user wrote them: no absolute paths
  std::string light;                          // its scales and fog in words; empty: the defaults
  std::vector<std::string> warnings;
  std::vector<MaterialCard> materials; // that the report is about, in the scene's order
  std::vector<ViewResult> views;
  std::vector<PassResult> passes;              // in the order of the work, over all views
  std::vector<PermutationResult> permutations; // that made the pictures, by path, in order of first use
  std::string error; // not empty: the scene could not be compared, this line says why; views hold what was done before
  int errorExitCode = 0; // 3 or 4 where there is an error, or that of notRun (settleVerdicts makes 4 of anything else)
  compare::Verdict verdict = compare::Verdict::pass;
  std::vector<compare::Condition> conditions; // its light, what of the file is shown, ...
  std::optional<SceneInputs> inputs;          // none: its files could not be read
};

// A scene that was not done when a signal ended the run: its error says so, its exit code is 128 and the signal's
// number, its verdict is notRun.
void setNotRun(SceneResult& scene, int signal);
int stoppedBy(const SceneResult& scene); // that signal; 0: none
bool isNotRun(const SceneResult& scene);
// What its error is: notRun or error; pass where there is none.
compare::Verdict ownVerdict(const SceneResult& scene);

// What the baseline shows and this run does not: a material, a whole view (material empty) or a whole scene (both).
struct GoneRow {
  std::string scene, view, material;
};

// The earlier report that a run was held against (report/baseline.h).
struct BaselineSummary {
  std::string source, version, device; // the file as given (without its folder, if that is absolute); what made it
  std::size_t common = 0;              // material views that both show
  std::vector<GoneRow> gone;           // not empty: at least a warning
  std::string error;                   // not empty: it could not be used, this line says why
  std::size_t notComparable = 0;       // rows that both show, under other conditions; not 0: at least a warning
  std::string notWhole = {};           // why it does not say what was failing then (whyNotWhole); empty: it does
};

// The approvals that a run was judged by (report/approvals.h).
struct ApprovalSummary {
  std::string source, asOf; // the file as given (without its folder, if that is absolute); the day, ISO 8601
  std::size_t entries = 0;
};

// What decides the figures and verdicts of every scene, by content: hexadecimal digits.
struct RunDigests {
  std::string settings; // of scenes that say nothing else
  std::string budgets;  // the text of the budget files; empty: the built-in ones
};

// Why a run as a whole is no pass, whatever its rows say.
struct RunProblem {
  compare::Verdict verdict = compare::Verdict::error; // or fail
  std::string reason;                                 // one sentence
  std::string file; // of the budget rule that says so, as the user named it; empty: none
  int line = 0;     // in it
};

struct Report {
  std::string tool = "parity", version;
  std::string suite;                                         // its name; empty: the run had none
  std::string device;                                        // Vulkan device name and driver
  std::vector<std::pair<std::string, std::string>> settings; // name, value, in a fixed order: for people
  std::vector<compare::Condition> conditions;                // of every scene; the device is one more
  RunDigests digests;
  std::string displayTable;          // file of the display transform as a table (PixelFiles)
  std::vector<std::string> warnings; // of the whole run: a rule that judges nothing, ...
  std::vector<RunProblem> lost;      // what budgets require and no scene has (findLost)
  std::optional<BaselineSummary> baseline;
  std::optional<ApprovalSummary> approvals = {}; // only where there are entries
  std::vector<std::string> only = {};            // globs of its views (--only); empty: all
  std::vector<SceneResult> scenes;
  compare::Verdict verdict = compare::Verdict::pass;
};

// A command that compares a view once more and prints its rows: a line for a POSIX shell, without its materials.
struct AgainCommand {
  std::string scene, view, command;
};

// How long a scene took, from its file (or the cache) to its figures and pictures; several scenes may run at a time.
struct SceneTime {
  std::string scene;
  double seconds = 0;
  double cpuSeconds = 0;    // of all threads; 0: not known, because several scenes ran at a time in one process
  std::string machine = {}; // its processor; empty: the run's
};

// What made a run: with the report's digests and the inputs of its scenes all that decides figures.
struct RunOrigin {
  std::string build;      // hash of the program
  std::string driver;     // of the device: name and version
  std::string numerics;   // how it rounds (job/numerics.h); empty: not known
  std::string machine;    // name of the processor; empty: not known
  bool isWhole = true;    // all views and materials of its scenes; not with --only or --material
  bool isComplete = true; // all scenes were done, though some may have errors
  double cpuSeconds = 0;  // of this process and of the worker processes, all threads
};

// What differs from run to run, kept out of the report so that it is byte-identical.
struct RunInfo {
  std::string startedAt; // ISO 8601, UTC
  std::string commandLine;
  std::vector<std::pair<std::string, double>> timings; // stage, ms
  std::size_t compiledShaders = 0;                     // of all paths, the same one once
  std::vector<std::string> cachedScenes;               // whose results were taken from the cache, unchanged
  std::vector<AgainCommand> again = {};                // of the views that were asked for
  std::vector<std::string> incidents = {};             // what a worker did not survive and the next one did
  std::vector<SceneTime> sceneTimes = {};              // of the scenes that were done, in their order
  bool warningsFail = false;                           // as --warn-exit asks
  RunOrigin origin = {};
};

// How many rows have each verdict.
struct VerdictCounts {
  std::size_t pass = 0, notSeen = 0, tooSmall = 0, notJudged = 0, warn = 0, fail = 0, error = 0;
  std::size_t total() const { return pass + notSeen + tooSmall + notJudged + warn + fail + error; }
};
VerdictCounts countVerdicts(const Report& report); // material x view; those not seen here but elsewhere are left out
VerdictCounts countWholes(const Report& report);   // whole images
std::size_t countNotRun(const Report& report);     // scenes
std::size_t countBroken(const Report& report);     // scenes with any other error
// How many materials (as countVerdicts has them) and whole images pass only because their budget accepts something.
struct AcceptedCounts {
  std::size_t materials = 0, wholes = 0;
};
AcceptedCounts countAccepted(const Report& report);

// The name of a figure that is no number, which is an error whatever the budget; empty if there is none.
std::string findUnsound(const compare::Figures& figures);

// Whether any view was held against the ground truth.
bool hasTruth(const Report& report);

// Sets one material's verdict and reason from its figures and checks, and `seenElsewhere` as given (it matters only
// where there are fewer pixels than its budget's minPixels): no pixel = notSeen, few = tooSmall, or fail where its
// budget requires it to be seen and no other view shows it; non-finite pixels = fail; no checks, none that could be
// judged, a figure that is NaN or a truth that is not finite = error; else the worst check. (A rule of regressions
// alone, for a material that the baseline does not have: warn, as it is new.) Where no check fails: notJudged above
// kMostClipping, at least warn from kNotableClipping on and for parts that no path models. The reason names all checks
// and conditions that have the verdict. What is not comparable to the baseline is at least a warning. What its budget
// accepts (compare/verdict/accept.h) does not count, and `accepted` says so: no error is ever accepted.
void settleMaterial(MaterialResult& material, bool seenElsewhere);

// Sets every verdict above the checks' from its parts, also the materials' by settleMaterial (another view of the scene
// may show what this one does not: same place in the list, same name). A scene that was not run is `notRun`; one with
// another error, or with no view, is `error`; so are a view with no materials, a report with no scenes, and one whose
// baseline has an error. A problem of the run (problemsOf) is what it says; a warning of the run, and rows that are
// gone since the baseline, are at least a warning. Idempotent.
void settleVerdicts(Report& report);

// Why a report does not say all of its scenes: it is of a part of them (--only, --material), or lacks results; empty:
// it is whole.
std::string whyNotWhole(const Report& report);

// The problems of a settled report as a whole, the gravest first: an error where scenes were compared, but no material
// of theirs (all are not seen, too small or not judged), and what is lost.
std::vector<RunProblem> problemsOf(const Report& report);

class EarlierRuns;

// Which failures count. isNew: those that the baseline or the history does not have (report/standing.h); where nobody
// can tell, the exit code is 4. Errors count all the same.
enum class FailOn { any, isNew };
inline constexpr const char* kFailOnNames[] = {"any", "new"};

// The exit code of a settled report (docs/design.md 8a): 0, 1 (only with warnExit; notSeen and the run's own warnings
// count), 2, the scenes' own 3 or 4 (4 for any other errorExitCode, and for a verdict `error`), or that of scenes that
// were not run; the highest that applies.
// earlier: the runs that say which failures are new (report/earlier_runs.h); null: the baseline does.
int exitCode(const Report& report, bool warnExit, FailOn failOn = FailOn::any, const EarlierRuns* earlier = nullptr);

// The whole report in a sentence: "3 of 40 materials over budget".
std::string headline(const Report& report);

// The version of report/report.schema.json: raised when a reader of the old form could misread the new one.
inline constexpr int kReportSchema = 4;

// JSON by report/report.schema.json, UTF-8, keys in fixed order, no times: byte-identical for equal
// reports. A report of many scenes has a gigabyte of it: writeJson holds a piece of it at a time.
void writeJson(const Report& report, const base::TextSink& sink, base::JsonLayout layout = base::JsonLayout::indented);
std::string toJson(const Report& report, base::JsonLayout layout = base::JsonLayout::indented);
// The same, compact, without what a page loads scene by scene ("scenes", and "again" of a run); and that.
std::string headJson(const Report& report);
std::string headJson(const RunInfo& run);
std::string toJson(const SceneResult& scene);
std::string toJson(const AgainCommand& command);
std::string toJson(const RunInfo& run, base::JsonLayout layout = base::JsonLayout::indented);
// JUnit: a testsuite a scene, with its time where the run has it, a testcase per view x material; failures and errors
// with their figures. writeJunit holds one scene's at a time.
void writeJunit(const Report& report, const RunInfo& run, const base::TextSink& sink);
std::string toJunit(const Report& report, const RunInfo& run);
struct TableOptions {
  bool color = false;      // ANSI
  std::size_t columns = 0; // of the terminal, to which lines are wrapped; 0: each row is one line
  bool all = false;        // also what passes; else it is counted
};
// For a terminal: the rows of materials and whole images that failed, warned or could not be judged, view by view; what
// is wrong with the run; totals by cause; commands that show the worst rows again (where `run` has them); the verdict.
std::string toTable(const Report& report, const RunInfo& run, const TableOptions& options);
// Workflow commands of GitHub Actions: "::error ..." for each row that failed or could not be judged, "::warning ..."
// for each warning, the gravest first (only the first ten of a kind are shown), each with the place of its budget rule.
// Files below `root` (the checkout) are named relative to it. Ends with a line feed, or is empty.
std::string toGithubAnnotations(const Report& report, const std::filesystem::path& root);

} // namespace parity::report
