// Options of `parity contract` and `parity calibrate`.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/invocation.h"
#include "cli/options/common_options.h"

namespace parity::cli {

void addContractOptions(CLI::App& app, ContractCommand& contract, RawOptions& raw);
void addCalibrateOptions(CLI::App& app, CalibrateCommand& calibrate);

} // namespace parity::cli
