// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/budget_options.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "cli/options/option_parts.h"
#include "compare/pooling/figure_list.h"

namespace parity::cli {

void addVerdictOptions(CLI::App& app, VerdictOptions& verdict, const std::string& tableHelp) {
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
