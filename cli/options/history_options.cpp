// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/history_options.h"

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "cli/options/option_parts.h"

namespace parity::cli {

namespace {

constexpr const char* kSubject = "SCENE/VIEW/MATERIAL";

void addFolder(CLI::App& app, std::string& folder) {
  app.add_option("--history", folder, "Folder of the history")
      ->type_name(kFolder)
      ->group(kInputGroup)
      ->capture_default_str();
}

void addWhere(CLI::App& app, RawHistoryOptions& raw) {
  app.add_option("--suite", raw.suite, "Runs of this suite. Default: that of the newest run")
      ->type_name("NAME")
      ->group(kInputGroup);
  app.add_option("--branch", raw.branch, "Runs of this branch. Default: that of the newest run of the suite")
      ->type_name("NAME")
      ->group(kInputGroup);
}

void addJson(CLI::App& app, std::string& json) {
  app.add_option("--json", json, "Write the result as JSON to this file; - for stdout, instead of the text")
      ->type_name(kFile)
      ->group(kOutputGroup);
}

// The options of what git bisect runs, of the pictures and of the baseline.
void addStepOptions(CLI::App& step, RawHistoryOptions& raw) {
  step.add_option("report", raw.step.report, "report.json or its folder")->type_name(kFile)->required();
  step.add_option("command", raw.step.command,
                  "Behind --: a command that makes this report first, with its arguments; no shell reads it")
      ->type_name("COMMAND");
  repeat(step.add_option(
             "--at-most", raw.limits,
             "Limit of a figure, such as flip.mean=.062; repeatable. If more is better (psnr), it is the least"))
      ->type_name("FIGURE=NUMBER")
      ->group("Verdict")
      ->required();
  repeat(step.add_option("--only", raw.step.choice.views,
                         "Judge these views only: SCENE/VIEW or SCENE, globs; repeatable"))
      ->type_name("GLOB")
      ->group(kInputGroup);
  CLI::Option* material = repeat(
      step.add_option("--material", raw.step.choice.materials, "Judge these materials only; a glob, repeatable"));
  material->type_name("GLOB")->group(kInputGroup);
  step.add_flag("--whole", raw.step.choice.wholes, "Judge whole images instead of materials")
      ->group(kInputGroup)
      ->excludes(material);
}

void addGcOptions(CLI::App& gc, HistoryGcCommand& command) {
  addFolder(gc, command.folder);
  gc.add_option("--days", command.days, "Keep all pictures of runs that are at most so many days old")
      ->group(kInputGroup)
      ->check(wholeWithin(0, 36'500))
      ->capture_default_str();
  gc.add_option("--as-of", command.asOf, "The day that counts, such as 2026-11-25. Default: today, in UTC")
      ->type_name("DATE")
      ->check(dayValidator())
      ->group(kInputGroup);
  gc.add_option("--approvals", command.approvals, "Approvals (TOML): keep the pictures of the states that they approve")
      ->type_name(kFile)
      ->group(kInputGroup);
  gc.add_flag("--dry-run", command.isTrial, "Remove nothing, only say what would be removed")->group(kOutputGroup);
}

void addPageOptions(CLI::App& page, RawHistoryOptions& raw) {
  addFolder(page, raw.page.folder);
  addWhere(page, raw);
  page.add_option("--last", raw.page.last, "Number of runs to show, the newest; 0: all")
      ->group(kOutputGroup)
      ->check(wholeWithin(0, 1'000'000))
      ->capture_default_str();
  page.add_option("-o,--output", raw.page.output, "Folder of the page: index.html")
      ->type_name(kFolder)
      ->group(kOutputGroup)
      ->required();
}

void addBaselineOptions(CLI::App& baseline, RawHistoryOptions& raw) {
  HistoryBaselineCommand& command = raw.baseline;
  addFolder(baseline, command.folder);
  baseline.add_option("--into", command.question.into, "Branch that the commit will go into")
      ->type_name("COMMIT")
      ->group(kInputGroup)
      ->capture_default_str();
  baseline.add_option("--commit", command.question.commit, "Newest commit of the branch")
      ->type_name("COMMIT")
      ->group(kInputGroup)
      ->capture_default_str();
  baseline.add_option("--suite", raw.suite, "Only runs of this suite. Default: of any")
      ->type_name("NAME")
      ->group(kInputGroup);
  baseline.add_option("--repository", command.repository, "Folder of the work tree that git is asked in")
      ->type_name(kFolder)
      ->group(kInputGroup)
      ->capture_default_str();
  choose(baseline.add_option("--print", command.print,
                             "What to print of the run: its id, the folder of its report, or both"),
         {"both", "run", "report"})
      ->group(kOutputGroup)
      ->capture_default_str();
}

} // namespace

void addHistoryOptions(CLI::App& app, RawHistoryOptions& raw) {
  app.require_subcommand(1);

  CLI::App& add =
      *app.add_subcommand("add", "Add the run of a report's folder, and print what changed since the run before");
  add.add_option("report", raw.add.report, "Folder of a report")->type_name(kFolder)->required();
  addFolder(add, raw.add.folder);
  add.add_option("--suite", raw.add.suite,
                 "Name under which its runs follow one another. Default: that of the suite file")
      ->type_name("NAME")
      ->group(kInputGroup);
  const std::string otherwise = ". Default: from the environment of CI, else from git";
  add.add_option("--branch", raw.add.commit.branch, "Branch of the run" + otherwise)
      ->type_name("NAME")
      ->group(kInputGroup);
  add.add_option("--commit", raw.add.commit.commit, "Commit of the run" + otherwise)
      ->type_name("COMMIT")
      ->group(kInputGroup);
  add.add_option("--commit-time", raw.add.commit.commitTime, "Time of the commit (2026-11-25T03:00:12Z)" + otherwise)
      ->type_name("TIME")
      ->group(kInputGroup);
  add.add_option("--repository", raw.add.repository, "Folder of the work tree that git is asked in")
      ->type_name(kFolder)
      ->group(kInputGroup)
      ->capture_default_str();

  choose(add.add_option("--pictures", raw.pictures, "Rows whose pictures the history keeps, each content once"),
         {"all", "not-passed", "none"})
      ->group(kOutputGroup)
      ->capture_default_str();

  CLI::App& rebuild = *app.add_subcommand("rebuild", "Make the index anew from the files of the runs");
  addFolder(rebuild, raw.rebuild.folder);

  CLI::App& show =
      *app.add_subcommand("show", "List the runs with what each of them brought, or all values of one row");
  show.add_option("subject", raw.show.subject, "Scene, SCENE/VIEW, or SCENE/VIEW/MATERIAL. Default: list the runs")
      ->type_name(kSubject);
  addFolder(show, raw.show.folder);
  addWhere(show, raw);
  show.add_option("--last", raw.show.last, "Number of runs to list, the newest; 0: all")
      ->group(kOutputGroup)
      ->check(wholeWithin(0, 1'000'000))
      ->capture_default_str();
  show.add_flag(
          "--timings", raw.show.timings,
          "Show where the CPU time of a scene went up or down in the newest 100 runs,\nfor each kind of processor")
      ->group(kOutputGroup)
      ->excludes("subject");
  addJson(show, raw.show.json);

  CLI::App& blame =
      *app.add_subcommand("blame", "Show when a row changed last: runs, commits, and the inputs that changed");
  blame.add_option("subject", raw.blame.subject, "Scene, SCENE/VIEW, or SCENE/VIEW/MATERIAL")
      ->type_name(kSubject)
      ->required();
  addFolder(blame, raw.blame.folder);
  addWhere(blame, raw);
  blame
      .add_option("--metric", raw.blame.metric,
                  "Only changes of this figure, such as flip.mean. Default: of any figure or verdict")
      ->type_name("NAME")
      ->group(kInputGroup);
  addJson(blame, raw.blame.json);

  addStepOptions(
      *app.add_subcommand("step", "Judge a report for 'git bisect run': exit with 0 (good), 1 (bad) or 125 (skip)"),
      raw);
  addGcOptions(*app.add_subcommand("gc", "Remove pictures that the history no longer needs"), raw.gc);
  addPageOptions(*app.add_subcommand("page", "Make a page of the runs: counts, worst rows, changes, times, machines"),
                 raw);
  addBaselineOptions(*app.add_subcommand("baseline", "Print the run that a branch is to be held against"), raw);
}

HistoryCommand settleHistory(const CLI::App& app, const RawHistoryOptions& raw) {
  const auto isGiven = [&](const char* name) { return app.get_subcommand(name)->parsed(); };
  const auto optional = [](const std::string& text) { return text.empty() ? std::nullopt : std::optional(text); };
  const history::Where where{optional(raw.suite), optional(raw.branch)};
  if (isGiven("add")) {
    HistoryAddCommand add = raw.add;
    add.pictures = raw.pictures == "all"    ? history::KeptPictures::all
                   : raw.pictures == "none" ? history::KeptPictures::none
                                            : history::KeptPictures::notPassed;
    return add;
  }
  if (isGiven("rebuild")) return raw.rebuild;
  if (isGiven("show")) {
    HistoryShowCommand show = raw.show;
    show.where = where;
    return show;
  }
  if (isGiven("page")) {
    HistoryPageCommand page = raw.page;
    page.where = where;
    return page;
  }
  if (isGiven("gc")) return raw.gc;
  if (isGiven("baseline")) {
    HistoryBaselineCommand baseline = raw.baseline;
    baseline.question.suite = where.suite;
    return baseline;
  }
  if (isGiven("step")) {
    HistoryStepCommand step = raw.step;
    try {
      for (const std::string& text : raw.limits) step.limits.push_back(history::readLimit(text));
    } catch (const base::Error& error) {
      throw CLI::ValidationError(error.what());
    }
    return step;
  }
  HistoryBlameCommand blame = raw.blame;
  blame.where = where;
  return blame;
}

} // namespace parity::cli
