#include "cli/workers.h"

#include <algorithm>

#include <unistd.h>

#include "base/interrupt.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/process.h"

namespace parity::cli {

job::SuperviseResult runWorkers(const job::Plan& plan, const std::filesystem::path& folder,
                                const std::vector<std::size_t>& units, const WorkersRequest& request,
                                const job::Progress& progress) {
  const int jobs = std::max(request.workers.jobs, 1);
  const int threads = request.threads > 0 ? request.threads : std::max(base::threadCount() / jobs, 1);
  std::vector<std::string> command = {base::ownProgram(),
                                      "work",
                                      std::filesystem::absolute(folder).string(), // no option, whatever its name
                                      "--worker",
                                      std::to_string(::getpid()),
                                      "--threads",
                                      std::to_string(threads)};
  command.insert(command.end(), request.words.begin(), request.words.end());
  if (base::logLevel() == base::LogLevel::verbose) command.push_back("--verbose");
  if (base::logLevel() == base::LogLevel::quiet) command.push_back("--quiet");
  return job::supervise(plan, folder, units,
                        {.jobs = jobs,
                         .timeoutS = request.workers.timeoutS,
                         .memoryBytes = request.workers.memoryBytes,
                         .showErrors = request.showErrors,
                         .stoppedBy = base::StopSignal::received,
                         .command = command},
                        progress);
}

} // namespace parity::cli
