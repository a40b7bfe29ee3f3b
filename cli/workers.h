// Worker processes of this program.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/invocation.h"
#include "job/plan/supervisor.h"
#include "job/plan/unit_store.h"

namespace parity::cli {

struct WorkersRequest {
  WorkerOptions workers;
  int threads = 0;                     // of each worker; 0: the cores, shared among them
  bool showErrors = true;              // what they write to stderr is shown
  std::vector<std::string> words = {}; // more of their command line
};

// Does these units of the plan by `parity work --worker`.
job::SuperviseResult runWorkers(const job::Plan& plan, const std::filesystem::path& folder,
                                const std::vector<std::size_t>& units, const WorkersRequest& request,
                                const job::Progress& progress);

} // namespace parity::cli
