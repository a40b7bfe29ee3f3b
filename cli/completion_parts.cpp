#include "cli/completion_parts.h"

#include <cctype>

#include "cli/options/option_parts.h"

namespace parity::cli {

CompletedValues valuesOf(const OptionText& option, const CompletionInput& input) {
  if (!option.choices.empty()) return {.names = option.choices, .extensions = {}};
  const std::string kind = option.value.substr(0, option.value.find(':'));
  if (kind == kFile) return {.names = {}, .extensions = {}, .isFile = true};
  if (kind == kFolder) return {.names = {}, .extensions = {}, .isFolder = true};
  if (kind == kSceneFile) return {.names = input.scenes.names, .extensions = input.scenes.extensions};
  if (kind == kEnvironmentFile) return {.names = input.environments.names, .extensions = input.environments.extensions};
  return {};
}

std::vector<const CommandText*> flatten(const CommandText& command) {
  std::vector<const CommandText*> all = {&command};
  for (const CommandText& below : command.commands)
    for (const CommandText* each : flatten(below)) all.push_back(each);
  return all;
}

std::vector<OptionText> optionsOf(const CommandText& command) {
  std::vector<OptionText> options;
  for (const OptionGroup& group : command.groups)
    options.insert(options.end(), group.options.begin(), group.options.end());
  return options;
}

std::string summaryOf(const std::string& help) {
  std::string line = help.substr(0, help.find('\n'));
  for (std::size_t dot = line.find(". "); dot != std::string::npos; dot = line.find(". ", dot + 1))
    if (dot + 2 < line.size() && std::isupper(static_cast<unsigned char>(line[dot + 2]))) line.resize(dot);
  return line;
}

CompletedValues valuesOfPositionals(const CommandText& command, const CompletionInput& input) {
  CompletedValues all;
  for (const OptionText& positional : command.positionals) {
    const CompletedValues values = valuesOf(positional, input);
    all.names.insert(all.names.end(), values.names.begin(), values.names.end());
    all.extensions.insert(all.extensions.end(), values.extensions.begin(), values.extensions.end());
    all.isFile |= values.isFile;
    all.isFolder |= values.isFolder;
  }
  return all;
}

std::string lastWord(const std::string& name) { return name.substr(name.rfind(' ') + 1); }

std::string completionScript(const std::string& shell, const CompletionInput& input) {
  return shell == "bash" ? bashScript(input) : shell == "zsh" ? zshScript(input) : fishScript(input);
}

} // namespace parity::cli
