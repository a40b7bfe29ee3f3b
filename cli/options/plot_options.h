// The options of parity plot.
#pragma once

#include <string>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in.
struct RawPlotOptions {
  PlotCommand plot;
  base::GivenKnobs given;
};

// `raw` must outlive the parsing.
void addPlotOptions(CLI::App& app, RawPlotOptions& raw);

// After parsing: the command that was given.
PlotCommand settlePlot(const RawPlotOptions& raw);

} // namespace parity::cli
