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
#include "cli/invocation.h"
#include "cli/output.h"
#include "job/flip_text.h"

namespace parity::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::array kOutputKinds = {".exr", ".pfm", ".png", ".svg"};

// Of many pairs each output is a folder.
void requireFolders(const job::FlipOutputs& outputs) {
  for (const fs::path& folder : {outputs.map, outputs.exposureMap, outputs.histogram})
    if (std::find(kOutputKinds.begin(), kOutputKinds.end(), extensionOf(folder.string())) != kOutputKinds.end())
      throw base::Error(base::ExitCode::usage, "output", "'" + folder.string() + "'",
                        "is a file's name; many pairs need a folder (--map-kind tells the kind of its maps)");
}

// Of a single pair each output is a file of a kind that can be written, and none of the two that are compared.
void requireWritable(const FlipCommand& command) {
  const auto require = [&](const char* option, const fs::path& file, const std::vector<std::string>& kinds) {
    if (file.empty()) return;
    if (std::find(kinds.begin(), kinds.end(), extensionOf(file.string())) == kinds.end())
      throw base::Error(base::ExitCode::usage, option, "'" + file.string() + "'",
                        fmt::format("is none of the kinds {}", fmt::join(kinds, ", ")));
    std::error_code error;
    for (const std::string& input : {command.reference, command.test})
      if (fs::equivalent(file, input, error))
        throw base::Error(base::ExitCode::usage, option, "'" + file.string() + "'", "is one of the images compared");
  };
  const job::FlipOutputs& outputs = command.request.outputs;
  require("--output", outputs.map, {".exr", ".pfm", ".png"});
  require("--exposure-map", outputs.exposureMap, {".exr", ".pfm", ".png"});
  require("--histogram", outputs.histogram, {".svg"});
}

job::FlipRequest makeRequest(const FlipCommand& command) {
  job::FlipRequest request = command.request;
  if (!command.metrics.empty()) request.metrics = compare::parseMetricNames(command.metrics, "--metrics");
  job::requireSense(request);
  std::error_code error;
  const bool folders = fs::is_directory(command.reference, error) || fs::is_directory(command.test, error);
  if (command.pairList.empty() && !folders)
    requireWritable(command);
  else
    requireFolders(request.outputs);
  if (!command.budgets.empty()) request.budgets = compare::loadBudgets(command.budgets);
  request.files =
      command.pairList.empty() ? job::findPairs(command.reference, command.test) : job::readPairList(command.pairList);
  if (request.files.skippedFiles > 0)
    base::logVerbose(fmt::format("{} files of no kind that images have were passed over", request.files.skippedFiles));
  return request;
}

} // namespace

int runFlipCommand(const FlipCommand& command) {
  const base::ThreadLimit threads(command.threads);
  const job::FlipRequest request = makeRequest(command);
  const job::FlipResult result = job::runFlip(request, makeProgress(command.quiet));
  for (const job::FlipPair& pair : result.pairs)
    if (pair.verdict == compare::Verdict::error) base::logError(pair.reason);

  if (!command.json.empty()) writeJson(command.json, job::toJson(result, command.warnExit));
  if (!command.csv.empty()) writeJson(command.csv, job::toCsv(result, command.warnExit));
  if (!command.junit.empty()) base::writeText(command.junit, job::toJunit(result));
  const bool stdoutTaken = command.json == "-" || command.csv == "-";
  const bool nothingToShow = result.pairs.size() == 1 && !request.files.many && result.pairs[0].rows.empty();
  if (!stdoutTaken && !nothingToShow) fmt::print("{}", job::toTable(result));
  // GitHub reads them from either stream.
  if (command.githubAnnotations) fmt::print(stdoutTaken ? stderr : stdout, "{}", job::toAnnotations(result));
  return job::exitCode(result, command.warnExit);
}

} // namespace parity::cli
