// The options of parity fit.
#pragma once

#include <string>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in.
struct RawFitOptions {
  FitCommand fit;
  base::GivenKnobs given;
};

// `raw` must outlive the parsing.
void addFitOptions(CLI::App& app, RawFitOptions& raw);

// After parsing: the command that was given.
FitCommand settleFit(const RawFitOptions& raw);

} // namespace parity::cli
