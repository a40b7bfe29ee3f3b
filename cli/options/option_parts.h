// What options have in common: values with checks, and how a wrong one is refused. Only for the files that know CLI11.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/knob/knob.h"

namespace parity::cli {

// Headings of --help that several subcommands have; those of knobs are in their tables.
inline constexpr const char *kInputGroup = "Input", *kOutputGroup = "Output", *kMachineGroup = "Machine",
                            *kCacheGroup = "Cache", *kGeneralGroup = "General";

// The names of values that are paths: --help shows them, and shells complete them (cli/completion.cpp).
inline constexpr const char *kFile = "FILE", *kFolder = "FOLDER", *kSceneFile = "SCENE",
                            *kEnvironmentFile = "ENVIRONMENT";

// The option takes one of these. A wrong one is told the nearest.
CLI::Option* choose(CLI::Option* option, const std::vector<std::string>& choices);

// The option is repeatable, and takes one value each time: what stands behind it is never swallowed.
CLI::Option* repeat(CLI::Option* option);

// "--option: 'value' is not WANTED".
CLI::ValidationError invalid(const std::string& option, const std::string& value, const std::string& wanted);

// What a reader of base/knob/knob.h makes of the text. Throws "--option: " and why it is refused.
template <typename Reader, typename... More>
auto readOption(const std::string& option, const Reader& read, const std::string& text, const More&... more) {
  try {
    return read(text, more...);
  } catch (const base::KnobError& error) {
    throw CLI::ValidationError(option, error.reason);
  }
}

// A number of this range, which --help shows.
CLI::Validator within(double least, double most);
CLI::Validator wholeWithin(std::uint64_t least, std::uint64_t most);

// Whether it is a date as YYYY-MM-DD.
bool isDate(const std::string& text);

// A file that can only be written as one of these kinds (extensions with their dots, in lower case).
CLI::Validator fileOfKind(const std::vector<std::string>& extensions);

} // namespace parity::cli
