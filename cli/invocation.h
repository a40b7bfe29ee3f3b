// The command line as plain data: what each subcommand is asked to do.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compare/images/flip_run.h"
#include "history/baseline.h"
#include "history/pictures.h"
#include "history/run.h"
#include "history/step.h"
#include "history/subject.h"
#include "job/bake_run.h"
#include "job/knobs.h"
#include "job/report_run.h"
#include "report/approvals.h"
#include "report/budget_suggest.h"
#include "report/summary/summary.h"
#include "scenes/suite/suite.h"
#include "study/explain/worst.h"
#include "study/fit/truth.h"
#include "study/preset/preset_study.h"
#include "study/stress/stress_run.h"
#include "study/sweep/pareto.h"
#include "study/sweep/trial_options.h"

namespace parity::cli {

struct CommonOptions {
  job::Settings settings; // with what is given
  job::Settings plain;    // without: what a suite's scenes begin with
  base::GivenKnobs given;
  scenes::ViewRequest view;
  std::vector<std::string> only; // globs of views (report/view_choice.h); none: all
  int threads = 0;
  std::vector<std::string> environments; // each --env; at most one is in the settings
  std::string json;                      // file, "-" for stdout, "" for none
  bool timings = false, quiet = false;
};

// What a verdict is held against, and how it is told.
// Where a summary goes; a copy of GitHub's goes to the file that $GITHUB_STEP_SUMMARY names.
struct SummaryTarget {
  std::string file; // empty: there is none
  report::SummaryFormat format = report::SummaryFormat::github;
  std::string picturesUrl; // of the report's folder; empty: no pictures
};

struct VerdictOptions {
  bool warnExit = false;
  std::string baseline;        // earlier report.json or its folder; empty: none
  std::string annotate;        // "github", or empty
  std::string approvals, asOf; // a file of approvals, and the day that counts (ISO 8601); empty: none, today
  std::string history;         // folder of the runs that say what is new; empty: the baseline does
  report::FailOn failOn = report::FailOn::any;
  bool explains = false; // materials over budget
  SummaryTarget summary;
  bool allRows = false; // of the table, also those that pass
};

// Worker processes of a run.
struct WorkerOptions {
  int jobs = 0;                // at a time; 0: none, the run is done in this process
  double timeoutS = 300;       // that a scene may take
  std::size_t memoryBytes = 0; // that a worker may hold; 0: any
};

inline constexpr const char* kDefaultReportFolder = "parity-report";

struct ReportCommand {
  CommonOptions common;
  VerdictOptions verdict;
  std::vector<std::string> scenes;
  std::string suite, folder;
  std::string csv; // file, "-" for stdout, "" for none
  bool singleFile = false, pixelData = true;
  job::Pictures pictures = job::Pictures::all;
  std::string bench; // bench.json of `parity bench` or its folder; empty: none
  WorkerOptions workers;
  bool sentinel = false;         // compare some scenes anew although the cache has them: others each day
  std::vector<std::string> kept; // words of the command line that `parity diff` takes for the same result
};

struct PlanCommand {
  ReportCommand report; // its folder is the plan's
  std::size_t shards = 1;
};

struct WorkCommand {
  std::string folder;
  std::string shard;              // a number from 0, "auto", or empty for all
  std::vector<std::size_t> units; // to be done in this process; empty: those of the shard, by workers
  bool missing = false;           // only print the shards with units that are missing
  int supervisor = 0;             // process id of a worker's, which tells what to do by standard input; 0: no worker
  WorkerOptions workers{.jobs = 1};
  std::optional<std::string> cacheFolder; // in place of the plan's; empty: no cache
  std::optional<std::uintmax_t> cacheBytes;
  int threads = 0;
  bool quiet = false;
};

struct MergeCommand {
  std::string plan, folder;
  bool reportsIncomplete = false;
  VerdictOptions verdict; // the baseline is the plan's
  std::string json, csv, bench;
  bool timings = false, quiet = false;
};

struct DiffCommand {
  CommonOptions common;
  VerdictOptions verdict;
  std::string scene, suite; // either
  std::string csv;          // file, "-" for stdout, "" for none
};

struct RenderCommand {
  CommonOptions common;
  std::string scene, path, output;
  std::string errorMap; // of the reference path; empty: none
  std::string term;     // a term, or an intermediate of the path; empty: the picture
  std::string ids;      // file for the materials of the pixels; empty: none
  bool watches = false; // the preset folders of the path: written again at each change
};

// parity render --list-terms.
struct ListTermsCommand {};

struct ContractCommand {
  CommonOptions common;
  std::vector<std::string> scenes;
  std::string suite, output; // output: a folder
};

struct CalibrateCommand {
  std::string picture; // file, or the folder that it is in
};

struct FlipCommand {
  std::string reference, test, pairList; // the first two, or the last
  compare::FlipRequest request;          // all but its files, metrics and budgets
  std::optional<std::string> metrics;    // as they were written; none: the default ones
  std::string budgets;                   // file; empty: none
  std::string json, csv, junit;          // file, "-" for stdout (not junit), "" for none
  bool githubAnnotations = false, warnExit = false, quiet = false;
  int threads = 0;
};

struct ApproveCommand {
  std::string report, output = "approvals.toml"; // folder; file
  report::ApproveRequest request;
  bool isMany = false; // more rows than a few are meant
};
struct BudgetSuggestCommand {
  std::vector<std::string> reports;
  std::string output; // empty: stdout
  report::SuggestOptions options;
};

struct BudgetCheckCommand {
  std::string file;
};

struct FitCommand {
  fit::Settings settings;
  std::string format = "glsl"; // or "hlsl", "json"
  std::string output;          // empty: stdout
  int threads = 0;
  bool quiet = false;
};

struct PlotCommand {
  std::string what;          // "env-brdf"
  std::string scene, folder; // the scene: empty for none
  job::Settings settings;    // of these: the paths and their options
  int threads = 0;
  bool quiet = false;
};

struct BenchCommand {
  CommonOptions common;
  std::vector<std::string> scenes;
  sweep::TrialOptions trial;
  std::optional<sweep::ErrorBudget> budget;
  std::string suite, folder, csv, compare; // empty: none; csv "-" for stdout
  bool scaling = false, list = false;
};

struct ExplainCommand {
  CommonOptions common;
  std::vector<std::string> scenes, switches; // of --switch; none: chosen for each scene
  std::string suite;                         // empty: none
  bool allMaterials = false;
};

struct WorstCommand {
  CommonOptions common;
  std::string scene;
  explain::WorstOptions options;
};

struct PresetNewCommand {
  std::string folder, from = "ue4-2020";
};

// parity preset functions.
struct PresetFunctionsCommand {};

struct StudyPresetCommand {
  CommonOptions common;
  presets::StudyRequest request; // all but its environments and its size
  std::string folder;            // empty: no page is written
};

struct StressCommand {
  stress::Options options;                                 // all but the presets
  std::map<std::string, std::vector<std::string>> presets; // by the id of their knob; none: all
  std::string at;                                          // one input by hand; empty: none
  std::string folder, json;                                // "-" for stdout, "" for none
  bool list = false, quiet = false;
  int threads = 0;
};

struct BakeCommand {
  CommonOptions common;
  std::vector<std::string> scenes;
  std::string suite, folder; // the folder: of the one scene, or one in it for each
  job::BakeOptions options;
};

struct InfoCommand {
  CommonOptions common; // of it what is loaded, and json: "-" for stdout in place of the text
  std::string scene;
};

struct ExportCommand {
  CommonOptions common; // of it what is loaded
  std::string scene, output;
};

struct DevicesCommand {
  gpu::DeviceOptions device;
  std::string json;
};

// parity knobs.
struct KnobsCommand {};

// parity --version.
struct VersionCommand {};

// parity completion and man: a text to print, or files by name.
struct GuideCommand {
  std::string text;
  std::vector<std::pair<std::string, std::string>> files;
  std::string folder;
};

struct CacheCommand {
  bool clear = false; // else it is described
  std::filesystem::path folder;
  std::string json;
};

struct SuiteListCommand {
  std::string suite, json;
  std::vector<std::string> only;
  std::filesystem::path cacheFolder;
};

struct HistoryAddCommand {
  std::string report, folder = "history";
  std::string suite;          // empty: the report's
  history::CommitInfo commit; // as far as it is given
  std::string repository = ".";
  history::KeptPictures pictures = history::KeptPictures::notPassed;
};

struct HistoryRebuildCommand {
  std::string folder = "history";
};

struct HistoryShowCommand {
  std::string folder = "history", subject; // subject: empty: the runs
  history::Where where;
  std::size_t last = 30; // 0: all
  bool timings = false;  // steps in the times of scenes, not the runs
  std::string json;
};

struct HistoryBlameCommand {
  std::string folder = "history", subject;
  std::string metric; // empty: any
  history::Where where;
  std::string json;
};

struct HistoryStepCommand {
  std::string report;
  std::vector<history::StepLimit> limits;
  history::StepChoice choice;
  std::vector<std::string> command; // that makes the report first; empty: it is there
};

struct HistoryGcCommand {
  std::string folder = "history";
  int days = 30;         // pictures of runs that are not older are kept
  std::string asOf;      // date, YYYY-MM-DD; empty: today
  std::string approvals; // file; empty: none
  bool isTrial = false;
};

struct HistoryBaselineCommand {
  std::string folder = "history", repository = ".";
  history::BaselineQuestion question;
  std::string print = "both"; // or "run", "report"
};

struct HistoryPageCommand {
  std::string folder = "history", output; // output: folder of the page
  history::Where where;
  std::size_t last = 400; // runs; 0: all
};

using HistoryCommand = std::variant<HistoryAddCommand, HistoryRebuildCommand, HistoryShowCommand, HistoryBlameCommand,
                                    HistoryStepCommand, HistoryGcCommand, HistoryBaselineCommand, HistoryPageCommand>;

using Invocation = std::variant<ReportCommand, PlanCommand, WorkCommand, MergeCommand, DiffCommand, RenderCommand,
                                ListTermsCommand, FlipCommand, ApproveCommand, BudgetSuggestCommand, BudgetCheckCommand,
                                FitCommand, BenchCommand, ExplainCommand, WorstCommand, PresetNewCommand,
                                PresetFunctionsCommand, StudyPresetCommand, StressCommand, BakeCommand, DevicesCommand,
                                InfoCommand, ExportCommand, CacheCommand, SuiteListCommand, PlotCommand, KnobsCommand,
                                VersionCommand, GuideCommand, HistoryCommand, ContractCommand, CalibrateCommand>;

// What parsing led to: a command to run, or text that was asked for or is due (help, a usage error) with its
// exit code.
struct Parsed {
  std::optional<Invocation> command;
  std::string text;
  int exitCode = 0;
};

// Never throws for user input: a usage error is text and exit code 64.
Parsed parseCommandLine(int argc, const char* const* argv);

// What `parity render --term` takes: the terms, then the intermediates of the mobile base pass, then what else the
// high-end path has.
std::vector<std::string> termNames();

// The subcommands. Each returns its exit code and throws base::Error for what it could not do.
int runReportCommand(const ReportCommand& command, const std::string& commandLine);
int runPlanCommand(const PlanCommand& command, const std::string& commandLine);
int runWorkCommand(const WorkCommand& command);
int runMergeCommand(const MergeCommand& command);
int runDiffCommand(const DiffCommand& command, const std::string& commandLine);
int runRenderCommand(const RenderCommand& command);
int runListTermsCommand();
int runContractCommand(const ContractCommand& command);
int runCalibrateCommand(const CalibrateCommand& command);
int runFlipCommand(const FlipCommand& command);
int runApproveCommand(const ApproveCommand& command);
int runBudgetSuggestCommand(const BudgetSuggestCommand& command);
int runBudgetCheckCommand(const BudgetCheckCommand& command);
int runFitCommand(const FitCommand& command);
int runPlotCommand(const PlotCommand& command);
int runBenchCommand(const BenchCommand& command, const std::string& commandLine);
int runExplainCommand(const ExplainCommand& command, const std::string& commandLine);
int runWorstCommand(const WorstCommand& command, const std::string& commandLine);
int runPresetNewCommand(const PresetNewCommand& command);
int runPresetFunctionsCommand();
int runStudyPresetCommand(const StudyPresetCommand& command);
int runStressCommand(const StressCommand& command);
int runBakeCommand(const BakeCommand& command);
int runDevicesCommand(const DevicesCommand& command);
int runInfoCommand(const InfoCommand& command);
int runExportCommand(const ExportCommand& command);
int runCacheCommand(const CacheCommand& command);
int runSuiteListCommand(const SuiteListCommand& command);
int runHistoryCommand(const HistoryCommand& command);
int runKnobsCommand();
int runVersionCommand();
int runGuideCommand(const GuideCommand& command);

} // namespace parity::cli
