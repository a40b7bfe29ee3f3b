// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/budget_options.h"

#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "cli/options/option_parts.h"

namespace parity::cli {

void addVerdictOptions(CLI::App& app, VerdictOptions& verdict) {
  app.add_flag("--warn-exit", verdict.warnExit, "Exit with 1 if there are only warnings")->group("Verdict");
  app.add_option("--baseline", verdict.baseline,
                 "Earlier report.json or its folder: show what changed, and judge regressions")
      ->group("Verdict");
  app.add_option("--annotate", verdict.annotate,
                 "github: also print failures and warnings as annotations of GitHub Actions")
      ->check(CLI::IsMember({"github"}))
      ->group("Verdict");
}

void addBudgetOptions(CLI::App& app, RawBudgetOptions& raw) {
  app.require_subcommand(1);
  CLI::App& suggest = *app.add_subcommand("suggest", "Propose a budget file from reports of earlier runs");
  suggest.add_option("reports", raw.suggest.reports, "report.json files or their folders, one for each run")
      ->required();
  suggest.add_option("-o,--output", raw.suggest.output, "Budget file to write (TOML). Default: stdout");
  suggest
      .add_option("--margin", raw.suggest.options.margin,
                  "Share of the error to add to the observed 95th percentile; limits that fail add twice as much")
      ->check(within(0, 10))
      ->capture_default_str();
  raw.metrics = fmt::format("{}", fmt::join(raw.suggest.options.figures, ","));
  suggest.add_option("--metrics", raw.metrics, "Figures to limit, named as in budgets: flip.mean,ssim.mean,...")
      ->capture_default_str();
  suggest.add_flag("--per-scene", raw.suggest.options.perScene,
                   "Write a rule for each material of each scene. Default: one rule for each material, which holds in "
                   "all scenes");
  suggest.add_flag("--regress", raw.suggest.options.regress,
                   "Limit how much worse than in the baseline a figure may be, instead of the figure itself. Runs with "
                   "these budgets need --baseline");
  CLI::App& check = *app.add_subcommand("check", "Read a budget file and print its rules");
  check.add_option("file", raw.check.file, "Budget file (TOML)")->required();
}

Invocation settleBudget(const CLI::App& app, const RawBudgetOptions& raw) {
  if (app.get_subcommand("check")->parsed()) return raw.check;
  BudgetSuggestCommand suggest = raw.suggest;
  suggest.options.figures.clear();
  std::istringstream names(raw.metrics);
  for (std::string name; std::getline(names, name, ',');) try {
      suggest.options.figures.push_back(compare::requireStatistic(name, "--metrics").name);
    } catch (const base::Error& error) {
      throw CLI::ValidationError("--metrics", error.place() + ": " + error.reason());
    }
  if (suggest.options.figures.empty()) throw CLI::ValidationError("--metrics", "names no figure");
  return suggest;
}

} // namespace parity::cli
