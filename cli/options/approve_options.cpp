// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/approve_options.h"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "base/day.h"
#include "base/error.h"
#include "cli/options/option_parts.h"
#include "compare/pooling/figure_list.h"

namespace parity::cli {

void addApproveOptions(CLI::App& app, RawApprove& raw) {
  ApproveCommand& command = raw.command;
  report::ApproveRequest& request = command.request;
  constexpr const char *kRows = "Rows", *kEntries = "Entries";
  app.add_option("report", command.report, "Folder of the report")->type_name(kFolder)->required();
  repeat(app.add_option("--material", request.materials, "Materials to approve (glob, repeatable)"))
      ->type_name("GLOB")
      ->group(kRows);
  app.add_flag("--whole", request.wholes, "Approve whole images, too")->group(kRows);
  repeat(app.add_option("--scene", request.scenes, "Only in these scenes (glob, repeatable)"))
      ->type_name("GLOB")
      ->group(kRows);
  repeat(app.add_option("--view", request.views, "Only in these views (glob, repeatable)"))
      ->type_name("GLOB")
      ->group(kRows);
  repeat(app.add_option("--metric", raw.metrics,
                        "Only these figures, such as flip.mean (repeatable). Default: all that are beyond a limit"))
      ->type_name("NAME")
      ->group(kRows);
  app.add_flag("--warnings", request.warnings, "Approve rows that warn, too. Default: those that fail")->group(kRows);
  app.add_flag("--yes", command.isMany, "Approve more than 20 rows")->group(kRows);
  app.add_option("--reason", request.reason, "Why they are accepted; reports show it")
      ->type_name("TEXT")
      ->required()
      ->group(kEntries);
  app.add_option("--owner", request.owner, "Whom to ask; reports show it")
      ->type_name("WHO")
      ->required()
      ->group(kEntries);
  app.add_option("--until", raw.until, "The last day on which they are accepted, such as 2027-02-01")
      ->type_name("DATE")
      ->required()
      ->check(dayValidator())
      ->group(kEntries);
  app.add_option("--slack", raw.slack, "How much worse a figure may be than it is now: a share of it")
      ->type_name("SHARE")
      ->capture_default_str()
      ->group(kEntries);
  app.add_option("-o,--output", command.output, "Approvals (TOML) to write; entries that it holds stay")
      ->type_name(kFile)
      ->capture_default_str()
      ->group(kOutputGroup);
}

ApproveCommand settleApprove(const RawApprove& raw) {
  ApproveCommand command = raw.command;
  report::ApproveRequest& request = command.request;
  if (request.materials.empty() && !request.wholes) throw CLI::RequiredError("approve: --material or --whole");
  request.until = base::dayFrom(raw.until).value();
  if (request.until < base::today())
    throw CLI::ValidationError("--until", raw.until + " is past, so it would accept nothing");
  request.slack = readOption("--slack", base::readShare, raw.slack);
  try {
    for (const std::string& name : raw.metrics)
      for (const compare::Statistic& figure : compare::parseFigures(name, "--metric"))
        request.metrics.push_back(figure.name);
  } catch (const base::Error& error) {
    throw CLI::ValidationError("--metric", error.place() + ": " + error.reason());
  }
  return command;
}

} // namespace parity::cli
