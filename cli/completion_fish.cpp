// fish has its own way to say it: a line for each option.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/completion_parts.h"

namespace parity::cli {

namespace {

// In single quotes, as fish reads it.
std::string fishQuoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + "'";
}

std::string sourceOf(const CompletedValues& values) {
  std::vector<std::string> parts = values.names;
  if (!values.extensions.empty())
    parts.push_back(fmt::format("(__parity_files {})", fmt::join(values.extensions, " ")));
  if (values.isFolder) parts.emplace_back("(__fish_complete_directories)");
  return fmt::format("{}", fmt::join(parts, " "));
}

std::string optionLine(const std::string& condition, const OptionText& option, const CompletionInput& input) {
  std::string line = fmt::format("complete -c parity -n {}", condition);
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.value.empty()) {
    const CompletedValues values = valuesOf(option, input);
    line += values.isFile ? " -r -F" : " -x";
    if (const std::string source = sourceOf(values); !source.empty()) line += " -a " + fishQuoted(source);
  }
  return line + fmt::format(" -d {}\n", fishQuoted(summaryOf(option.help)));
}

} // namespace

std::string fishScript(const CompletionInput& input) {
  std::vector<std::string> names;
  for (const CommandText* command : flatten(input.program))
    if (!command->name.empty()) names.push_back(fishQuoted(command->name));
  std::string text = fmt::format(R"fish(# fish completion of parity, made by `parity completion fish`.
function __parity_at # COMMAND: whether it is the one that was given
    set -l given
    set -l words (commandline -opc)
    for word in $words[2..-1]
        contains -- (string join -- ' ' $given $word) {}; and set -a given $word
    end
    test "$given" = "$argv"
end
function __parity_files # KINDS
    set -l word (commandline -ct)
    set -l files $word*/
    for kind in $argv
        set -a files $word*.$kind
    end
    printf '%s\n' $files
end
complete -c parity -f
)fish",
                                 fmt::join(names, " "));
  for (const CommandText* command : flatten(input.program)) {
    const std::string condition = fishQuoted("__parity_at " + command->name);
    for (const CommandText& each : command->commands)
      text += fmt::format("complete -c parity -n {} -a {} -d {}\n", condition, lastWord(each.name),
                          fishQuoted(summaryOf(each.help)));
    for (const OptionText& option : optionsOf(*command)) text += optionLine(condition, option, input);
    const CompletedValues values = valuesOfPositionals(*command, input);
    if (values.isFile) text += fmt::format("complete -c parity -n {} -F\n", condition);
    if (const std::string source = sourceOf(values); !source.empty())
      text += fmt::format("complete -c parity -n {} -a {}\n", condition, fishQuoted(source));
  }
  return text;
}

} // namespace parity::cli
