// What --help and man pages say of each subcommand besides its options: notes, examples, and its own exit codes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace parity::cli {

struct Example {
  std::string_view line, what; // a whole command line, and what it does
};

struct ExitCodeText {
  int code = 0;
  std::string_view meaning;
};

struct CommandHelp {
  std::string_view command; // "budget suggest"; of the program itself: empty
  std::string_view notes;   // paragraphs; may be empty
  std::vector<Example> examples;
  std::vector<ExitCodeText> exitCodes;
};

// Of a command that has its own options. Throws std::out_of_range for one that is not in the table.
const CommandHelp& helpOf(std::string_view command);

// What the program is, over its own --help.
std::string introduction();

// Sets formatter and footers of the program and of all its subcommands, which must be there.
void addHelp(CLI::App& app);

} // namespace parity::cli
