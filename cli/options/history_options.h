// The options of parity history.
#pragma once

#include <string>
#include <vector>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in.
struct RawHistoryOptions {
  HistoryAddCommand add;
  HistoryRebuildCommand rebuild;
  HistoryShowCommand show;
  HistoryBlameCommand blame;
  HistoryStepCommand step;
  HistoryGcCommand gc;
  HistoryPageCommand page;
  HistoryBaselineCommand baseline;
  std::vector<std::string> limits;
  std::string pictures = "not-passed";
  std::string suite, branch; // of what is asked about; empty: those of the newest run
};

// All of parity history. `raw` must outlive the parsing.
void addHistoryOptions(CLI::App& app, RawHistoryOptions& raw);
// After parsing: the subcommand that was given. Throws CLI::ValidationError.
HistoryCommand settleHistory(const CLI::App& app, const RawHistoryOptions& raw);

} // namespace parity::cli
