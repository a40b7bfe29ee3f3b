// The options of parity bench.
#pragma once

#include <string>

#include "cli/invocation.h"
#include "cli/options/common_options.h"

namespace parity::cli {

// What CLI11 fills in; its picture and its truth are smaller and coarser than a report's.
struct RawBenchOptions {
  BenchCommand bench;
  RawOptions common;
  std::string budget;
  bool noTruth = false, noReference = false; // the latter is its older name
};

// `raw` must outlive the parsing.
void addBenchOptions(CLI::App& app, RawBenchOptions& raw);
// After parsing: the command that was given. Throws CLI::ValidationError.
BenchCommand settleBench(const CLI::App& app, const RawBenchOptions& raw);

} // namespace parity::cli
