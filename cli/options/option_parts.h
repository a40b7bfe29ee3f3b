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

// As CLI::Range, but NaN lies in no range.
CLI::Validator within(double least, double most);

// A file that can only be written as one of these kinds (extensions with their dots, in lower case).
CLI::Validator fileOfKind(const std::vector<std::string>& extensions);

} // namespace parity::cli
