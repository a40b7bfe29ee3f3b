// What options have in common: values with checks, and how a wrong one is refused. Only for the files that know CLI11.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace parity::cli {

// "--option: 'value' is not WANTED".
CLI::ValidationError invalid(const std::string& option, const std::string& value, const std::string& wanted);

// "a,b,c" as exactly `count` finite numbers. Throws invalid().
std::vector<float> parseNumbers(const std::string& option, const std::string& text, std::size_t count,
                                const std::string& wanted);

// "0.5%" or "0.005": a share of 1e-6 to 1. Throws invalid().
double parseShare(const std::string& option, const std::string& text);

// "500M", "4G", "1048576": bytes; K, M, G and T are powers of 1024. At least 1. Throws invalid().
std::uintmax_t parseBytes(const std::string& option, const std::string& text);

// As CLI::Range, but NaN lies in no range.
CLI::Validator within(double least, double most);

// One of these names; an unknown one is told with the nearest of them.
CLI::Validator oneOf(const std::vector<std::string>& names);

// A file that can only be written as one of these kinds (extensions with their dots, in lower case).
CLI::Validator fileOfKind(const std::vector<std::string>& extensions);

// The enumerator of a name that CLI11 has checked.
template <typename Enum> Enum enumOf(const std::string& text, const std::vector<std::string>& names) {
  return static_cast<Enum>(std::find(names.begin(), names.end(), text) - names.begin());
}

// An option of an enumerator's name, `chosen` unless it is given.
template <typename Enum> void addSetting(CLI::App& app, const char* option, std::string& text, Enum chosen,
                                         const std::vector<std::string>& names, const char* description) {
  text = names[static_cast<std::size_t>(chosen)];
  app.add_option(option, text, description)->check(CLI::IsMember(names))->capture_default_str();
}

} // namespace parity::cli
