// parity contract: what another engine needs to render a run's views; and parity calibrate: what its picture of the
// calibration scene says.
#include <filesystem>

#include "base/parallel.h"
#include "cli/file_conflicts.h"
#include "cli/input_list.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "external/calibration.h"
#include "external/picture.h"
#include "job/contract.h"

namespace parity::cli {

int runContractCommand(const ContractCommand& command) {
  const base::ThreadLimit threads(command.common.threads);
  const RunRequest run = runRequest(command.common, withListed(command.scenes, "scene"), command.suite);
  std::vector<NamedFile> outputs;
  for (const std::string& file : job::contractFiles(run.scenes.size()))
    outputs.push_back({"-o", std::filesystem::path(command.output) / file});
  requireSeparate(outputs, inputFiles(command.common, run.scenes));
  job::Context context(run.settings);
  job::writeContract(context, run.scenes, command.output, makeProgress(command.common.quiet));
  print("{}\n", (std::filesystem::path(command.output) / job::kContractFile).string());
  return 0;
}

int runCalibrateCommand(const CalibrateCommand& command) {
  std::filesystem::path file = command.picture;
  std::error_code none;
  if (std::filesystem::is_directory(file, none)) file /= "calibration.png";
  for (const std::string& line : external::describe(external::calibrate(external::readValues(file), file)))
    print("{}\n", line);
  return 0;
}

} // namespace parity::cli
