// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/budget_options.h"

#include <algorithm>
#include <iterator>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "cli/options/option_parts.h"
#include "compare/pooling/figure_list.h"

namespace parity::cli {

namespace {

// A URL in a page and in JSON; what would end it there is in none.
std::string whyNoUrl(const std::string& url) {
  const bool isUrl = (url.starts_with("https://") || url.starts_with("http://")) &&
                     std::ranges::all_of(url, [](char c) { return c > ' ' && c < '\x7F' && c != '"' && c != '<'; });
  return isUrl ? "" : "'" + url + "' is not an address that begins with https:// or http://";
}

constexpr const char* kExplainNames[] = {"none", "over-budget"};

template <std::size_t count> std::size_t placeOf(const char* const (&names)[count], const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - std::begin(names));
}

} // namespace

void addApprovalOptions(CLI::App& app, VerdictOptions& verdict) {
  app.add_option("--approvals", verdict.approvals,
                 "Approvals (TOML): figures beyond a limit that somebody accepts until a day (parity approve)")
      ->type_name(kFile)
      ->group("Verdict");
  app.add_option("--as-of", verdict.asOf, "The day that counts, such as 2027-02-01. Default: today, in UTC")
      ->type_name("DATE")
      ->check(dayValidator())
      ->group("Verdict");
}

void addOutcomeOptions(CLI::App& app, VerdictOptions& verdict, RawOutcome& raw) {
  choose(app.add_option("--fail-on", raw.failOn,
                        "Failures that give the exit code 2: any, or only those that are new since the history's last\n"
                        "run, or since the baseline"),
         {std::begin(report::kFailOnNames), std::end(report::kFailOnNames)})
      ->group("Verdict")
      ->capture_default_str();
  app.add_option("--history", verdict.history,
                 "Folder of parity history: its runs say what is new, fixed and flaky, since when a row fails, and\n"
                 "how its figures went. Default: --baseline says what is new")
      ->type_name(kFolder)
      ->group("Verdict");
  choose(
      app.add_option("--explain", raw.explain,
                     "over-budget: also say of each material over a limit which approximation causes most of it, what\n"
                     "would help and what that costs. Takes seconds for each view that has such a material"),
      {kExplainNames[0], kExplainNames[1]})
      ->group("Verdict")
      ->capture_default_str();
  CLI::Option* summary =
      app.add_option("--summary", verdict.summary.file,
                     "Also write a summary to this file: what is new, still failing, fixed, gone, ending.\n"
                     "That of GitHub is also appended to the file that GITHUB_STEP_SUMMARY names");
  summary->type_name(kFile)->group(kOutputGroup);
  choose(app.add_option("--summary-format", raw.summaryFormat,
                        "Markdown of github or gitlab, or a message of slack (JSON)"),
         {std::begin(report::kSummaryFormats), std::end(report::kSummaryFormats)})
      ->group(kOutputGroup)
      ->needs(summary)
      ->capture_default_str();
  app.add_option("--pictures-url", verdict.summary.picturesUrl,
                 "Address of the report's folder: the summary shows pictures from there. Default: no pictures")
      ->type_name("URL")
      ->check(CLI::Validator([](const std::string& url) { return whyNoUrl(url); }, "", ""))
      ->group(kOutputGroup)
      ->needs(summary);
}

void settleOutcome(VerdictOptions& verdict, const RawOutcome& raw) {
  verdict.explains = raw.explain == kExplainNames[1];
  verdict.failOn = static_cast<report::FailOn>(placeOf(report::kFailOnNames, raw.failOn));
  verdict.summary.format = static_cast<report::SummaryFormat>(placeOf(report::kSummaryFormats, raw.summaryFormat));
}

void requireBaseline(const VerdictOptions& verdict) {
  if (verdict.failOn == report::FailOn::isNew && verdict.baseline.empty() && verdict.history.empty())
    throw CLI::ValidationError("--fail-on", "'new' needs --history or --baseline, which says what failed before");
}

void addVerdictOptions(CLI::App& app, VerdictOptions& verdict, RawOutcome& raw, const std::string& tableHelp) {
  app.add_flag("--warn-exit", verdict.warnExit, "Exit with 1 if there are only warnings")->group("Verdict");
  app.add_option("--baseline", verdict.baseline,
                 "Earlier report.json or its folder: show what changed, and judge regressions")
      ->type_name(kFile)
      ->group("Verdict");
  choose(app.add_option("--annotate", verdict.annotate,
                        "github: also print failures and warnings as annotations of GitHub Actions"),
         {"github"})
      ->group("Verdict");
  app.add_flag("--all", verdict.allRows, tableHelp)->group("Verdict");
  addApprovalOptions(app, verdict);
  addOutcomeOptions(app, verdict, raw);
}

void addBudgetOptions(CLI::App& app, RawBudgetOptions& raw) {
  app.require_subcommand(1);
  CLI::App& suggest = *app.add_subcommand("suggest", "Propose a budget file from reports of earlier runs");
  suggest
      .add_option("reports", raw.suggest.reports,
                  "report.json files or their folders, one for each run; -: one a line from standard input")
      ->type_name(kFile)
      ->required();
  suggest.add_option("-o,--output", raw.suggest.output, "Budget file to write (TOML). Default: stdout")
      ->type_name(kFile)
      ->group(kOutputGroup);
  suggest
      .add_option("--margin", raw.suggest.options.margin,
                  "Share of the error to add to the observed 95th percentile; limits that fail add twice as much")
      ->group("Limits")
      ->check(within(0, 10))
      ->capture_default_str();
  raw.metrics = fmt::format("{}", fmt::join(raw.suggest.options.figures, ","));
  suggest
      .add_option(
          "--metrics", raw.metrics,
          "Figures to limit, named as in budgets: flip.mean,ssim.mean,... A metric (flip)\nstands for its first figure")
      ->type_name("NAME,...")
      ->group("Limits")
      ->capture_default_str();
  suggest.add_flag("--per-scene", raw.suggest.options.perScene,
                   "Write a rule for each material of each scene. Default: one for each material, for all scenes");
  suggest.add_flag(
      "--regress", raw.suggest.options.regress,
      "Limit how much worse than in the baseline a figure may be, instead of the figure itself.\nRuns with "
      "these budgets need --baseline");
  CLI::App& check = *app.add_subcommand("check", "Read a budget file and print its rules");
  check.add_option("file", raw.check.file, "Budget file (TOML)")->type_name(kFile)->required();
}

Invocation settleBudget(const CLI::App& app, const RawBudgetOptions& raw) {
  if (app.get_subcommand("check")->parsed()) return raw.check;
  BudgetSuggestCommand suggest = raw.suggest;
  suggest.options.figures.clear();
  try {
    for (const compare::Statistic& figure : compare::parseFigures(raw.metrics, "--metrics"))
      if (std::ranges::count(suggest.options.figures, figure.name) == 0) suggest.options.figures.push_back(figure.name);
  } catch (const base::Error& error) {
    throw CLI::ValidationError("--metrics", error.place() + ": " + error.reason());
  }
  return suggest;
}

} // namespace parity::cli
