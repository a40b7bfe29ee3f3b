// parity flip: any two images, two folders of them, or a list.
#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/file_conflicts.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "compare/images/flip_files.h"
#include "compare/images/flip_text.h"

namespace parity::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::array kOutputKinds = {".exr", ".pfm", ".png", ".svg"};

// Of many pairs each output is a folder.
void requireFolders(const compare::FlipOutputs& outputs) {
  for (const fs::path& folder : {outputs.map, outputs.exposureMap, outputs.histogram})
    if (std::find(kOutputKinds.begin(), kOutputKinds.end(), extensionOf(folder.string())) != kOutputKinds.end())
      throw base::Error(base::ExitCode::usage, "output", "'" + folder.string() + "'",
                        "is a file name; many pairs need a folder (--map-kind sets the format of its maps)");
}

// Of a single pair each output is a file of a kind that can be written.
void requireKinds(const compare::FlipOutputs& outputs) {
  const auto require = [&](const char* option, const fs::path& file, const std::vector<std::string>& kinds) {
    if (!file.empty() && std::find(kinds.begin(), kinds.end(), extensionOf(file.string())) == kinds.end())
      throw base::Error(base::ExitCode::usage, option, "'" + file.string() + "'",
                        fmt::format("is not a file of the kinds {}", fmt::join(kinds, ", ")));
  };
  require("--output", outputs.map, {".exr", ".pfm", ".png"});
  require("--exposure-map", outputs.exposureMap, {".exr", ".pfm", ".png"});
  require("--histogram", outputs.histogram, {".svg"});
}

// Maps among the pictures of a folder would be pictures of the next run.
void requireOutside(const compare::FlipOutputs& outputs, const FlipCommand& command) {
  for (const fs::path& output : {outputs.map, outputs.exposureMap, outputs.histogram})
    for (const std::string& input : {command.reference, command.test})
      if (!output.empty() && liesIn(output, input))
        throw base::Error(base::ExitCode::usage, "output", "'" + output.string() + "'",
                          fmt::format("lies in '{}', which holds compared pictures; give another folder", input));
}

void requireSeparateFiles(const FlipCommand& command, const compare::FlipRequest& request) {
  std::vector<NamedFile> inputs = {
      {"the mask", request.mask.file}, {"the budgets", command.budgets}, {"the list of pairs", command.pairList}};
  for (const compare::FilePair& pair : request.files.pairs) {
    inputs.push_back({"a compared reference image", pair.reference});
    inputs.push_back({"a compared test image", pair.test});
  }
  std::vector<NamedFile> outputs = {{"--json", command.json}, {"--csv", command.csv}, {"--junit", command.junit}};
  for (const compare::OutputFile& file : compare::listFlipFiles(request)) outputs.push_back({file.option, file.file});
  requireSeparate(outputs, inputs);
}

// At most a few names: a folder may hold thousands of other files.
void warnOfSkipped(const std::vector<std::string>& skipped) {
  constexpr std::size_t kMostNamed = 5;
  if (skipped.empty()) return;
  const std::size_t named = std::min(skipped.size(), kMostNamed);
  const std::vector<std::string> names(skipped.begin(), skipped.begin() + static_cast<std::ptrdiff_t>(named));
  base::logWarning(fmt::format("{} file{} skipped, hidden or not a picture: {}{}", skipped.size(),
                               skipped.size() == 1 ? " was" : "s were", fmt::join(names, ", "),
                               named < skipped.size() ? fmt::format(" and {} more", skipped.size() - named) : ""));
}

compare::FlipRequest makeRequest(const FlipCommand& command) {
  compare::FlipRequest request = command.request;
  if (command.metrics) request.metrics = compare::parseMetricNames(*command.metrics, "--metrics");
  compare::requireSense(request);
  std::error_code error;
  const bool folders = fs::is_directory(command.reference, error) || fs::is_directory(command.test, error);
  if (command.pairList.empty() && !folders)
    requireKinds(request.outputs);
  else
    requireFolders(request.outputs);
  if (folders) requireOutside(request.outputs, command);
  if (!command.budgets.empty()) request.budgets = compare::loadBudgets(command.budgets);
  request.files = command.pairList.empty() ? compare::findPairs(command.reference, command.test)
                                           : compare::readPairList(command.pairList);
  requireSeparateFiles(command, request);
  warnOfSkipped(request.files.skipped);
  return request;
}

} // namespace

int runFlipCommand(const FlipCommand& command) {
  const base::ThreadLimit threads(command.threads);
  const compare::FlipRequest request = makeRequest(command);
  const compare::FlipResult result = compare::runFlip(request, makeProgress(command.quiet));
  for (const compare::FlipPair& pair : result.pairs)
    if (pair.verdict == compare::Verdict::error) base::logError(pair.reason);
  base::logRunWarnings(result.warnings);

  // Files first: what cannot be written is told before anything that reads as a result.
  if (!command.junit.empty()) base::writeText(command.junit, compare::toJunit(result));
  if (!command.csv.empty() && command.csv != "-")
    base::writeText(command.csv, compare::toCsv(result, command.warnExit));
  if (!command.json.empty()) writeJson(command.json, compare::toJson(result, command.warnExit));
  if (command.csv == "-") printText(compare::toCsv(result, command.warnExit));
  const bool stdoutTaken = command.json == "-" || command.csv == "-";
  // The one pair's error has been printed, and what was found before it is no result.
  const bool nothingToShow = !request.files.many && result.pairs[0].errorCode != 0;
  if (!stdoutTaken && !nothingToShow && !command.quiet) print("{}", compare::toTable(result));
  if (command.githubAnnotations) printCommands(compare::toAnnotations(result, fs::current_path()), stdoutTaken);
  return compare::exitCode(result, command.warnExit);
}

} // namespace parity::cli
