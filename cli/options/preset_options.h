// The options of parity preset and parity study-preset.
#pragma once

#include "cli/invocation.h"
#include "cli/options/common_options.h"

namespace CLI {
class App;
}

namespace parity::cli {

struct RawPresetOptions {
  PresetNewCommand made;
  StudyPresetCommand study;
  RawOptions common;
};

// `raw` must outlive the parsing.
void addPresetOptions(CLI::App& app, RawPresetOptions& raw);
void addStudyPresetOptions(CLI::App& app, RawPresetOptions& raw);
// After parsing. settlePreset: one of its commands. Throw CLI::ParseError for what cannot be meant.
Invocation settlePreset(const CLI::App& app, const RawPresetOptions& raw);
StudyPresetCommand settleStudyPreset(const CLI::App& app, const RawPresetOptions& raw);

} // namespace parity::cli
