// What the scripts of all shells are made from.
#pragma once

#include <string>
#include <vector>

#include "cli/completion.h"

namespace parity::cli {

// What a value may be.
struct CompletedValues {
  std::vector<std::string> names, extensions; // words; files of these kinds
  bool isFile = false, isFolder = false;      // any file; folders alone
  bool isAnything() const { return !names.empty() || !extensions.empty() || isFile || isFolder; }
};

CompletedValues valuesOf(const OptionText& option, const CompletionInput& input);
// Those of all positionals together: which of them is due is not worth counting.
CompletedValues valuesOfPositionals(const CommandText& command, const CompletionInput& input);

// The program and all commands below it.
std::vector<const CommandText*> flatten(const CommandText& program);
std::vector<OptionText> optionsOf(const CommandText& command);
// "suggest" of "budget suggest".
std::string lastWord(const std::string& name);
// The first sentence of a help text, on one line.
std::string summaryOf(const std::string& help);

std::string bashScript(const CompletionInput& input);
std::string zshScript(const CompletionInput& input);
std::string fishScript(const CompletionInput& input);

} // namespace parity::cli
