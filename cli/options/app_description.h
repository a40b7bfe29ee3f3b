// A subcommand and its options as plain data, read from the very CLI11 app that parses the command line: --help, shell
// completion and man pages are made of it, so that no list is kept twice.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace parity::cli {

struct OptionText {
  std::vector<std::string> names;   // "-o", "--output"; of a positional its one name
  std::string value;                // what its value is called: "FILE", "NUMBER:0 to 1"; empty: a flag
  std::vector<std::string> choices; // of its value; empty: it is none of a few
  std::string defaultText, help;
  bool isRequired = false, isRepeatable = false;
};

struct OptionGroup {
  std::string title;
  std::vector<OptionText> options;
};

struct CommandText {
  std::string name; // "budget suggest"; of the program itself: empty
  std::string help; // the description
  std::vector<OptionText> positionals;
  std::vector<OptionGroup> groups;   // what is hidden is left out
  std::vector<CommandText> commands; // below it
};

// Of the program: the root app.
CommandText describeProgram(const CLI::App& app);

// The titles of the groups in the order that they are shown in: what is written first, the machine and the rest last.
std::vector<std::string> groupTitles(const CLI::App& app);

} // namespace parity::cli
