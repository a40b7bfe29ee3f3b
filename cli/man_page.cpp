#include "cli/man_page.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/version.h"
#include "cli/options/command_help.h"

namespace parity::cli {

namespace {

// Text as roff prints it as it stands: no escape, no request, and hyphens that can be copied as such.
std::string roff(std::string_view text) {
  std::string out;
  bool startsLine = true;
  for (const char c : text) {
    if (startsLine && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    startsLine = c == '\n';
  }
  return out;
}

// Lines that stay lines, and paragraphs.
std::string paragraphs(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (line.empty())
      out += ".PP\n";
    else if (line.starts_with("  ")) // a table
      out += ".br\n" + roff(line.substr(2)) + "\n.br\n";
    else
      out += roff(line) + "\n";
    at = end + 1;
  }
  return out;
}

// A list of choices may be longer than a line.
std::string breakable(const std::string& value) {
  constexpr std::size_t kLine = 78;
  const bool isLong = value.size() > 2 * kLine; // without blanks groff cannot adjust its lines
  std::string text;
  for (const char c : value) {
    text += c;
    if (c == ',') text += isLong ? " " : "\\:";
  }
  return text;
}

std::string optionEntry(const OptionText& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back(fmt::format("\\fB{}\\fR", roff(name)));
  std::string text = fmt::format(".TP\n{}", fmt::join(names, ", "));
  if (!option.value.empty()) text += fmt::format(" \\fI{}\\fR", breakable(roff(option.value)));
  text += "\n" + paragraphs(option.help + ".");
  std::vector<std::string> more;
  if (option.isRequired) more.emplace_back("Required.");
  if (option.isRepeatable) more.emplace_back("Repeatable.");
  if (!option.defaultText.empty()) more.push_back(fmt::format("Default: {}.", option.defaultText));
  if (!more.empty()) text += fmt::format("{}\n", roff(fmt::format("{}", fmt::join(more, " "))));
  return text;
}

std::string synopsisOf(const CommandText& command) {
  std::string text = fmt::format(".B parity {}\n", roff(command.name));
  if (!command.groups.empty()) text += "[\\fIOPTIONS\\fR]\n";
  for (const OptionText& positional : command.positionals) {
    const std::string dots = positional.isRepeatable ? "..." : "";
    const std::string entry = fmt::format("\\fI{}\\fR{}", roff(positional.names.front()), dots);
    text += positional.isRequired ? entry + "\n" : "[" + entry + "]\n";
  }
  if (!command.commands.empty()) text += "\\fICOMMAND\\fR\n";
  return text;
}

std::string optionSections(const CommandText& command) {
  std::string text;
  if (!command.positionals.empty()) {
    text += ".SS Arguments\n";
    for (const OptionText& positional : command.positionals) text += optionEntry(positional);
  }
  for (const OptionGroup& group : command.groups) {
    text += fmt::format(".SS {}\n", roff(group.title));
    for (const OptionText& option : group.options) text += optionEntry(option);
  }
  return text;
}

std::string tailOf(const CommandHelp& help) {
  std::string text;
  if (!help.notes.empty()) text += ".SH NOTES\n" + paragraphs(help.notes);
  if (!help.examples.empty()) text += ".SH EXAMPLES\n";
  for (const Example& example : help.examples)
    text += fmt::format(".TP\n.B {}\n{}\n", roff(example.line), roff(fmt::format("{}.", example.what)));
  text += ".SH EXIT STATUS\n";
  for (const ExitCodeText& each : help.exitCodes)
    text += fmt::format(".TP\n.B {}\n{}.\n", each.code, roff(each.meaning));
  return text;
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string pageName(const std::string& command) { return command.empty() ? "parity" : "parity-" + command; }

} // namespace

std::string manPage(const CommandText& program, const std::string& command) {
  const auto found = std::ranges::find(program.commands, command, &CommandText::name);
  const CommandText& text = command.empty() ? program : *found;
  const CommandHelp& help = helpOf(command);
  std::string title = pageName(command);
  std::ranges::transform(title, title.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  std::string page = fmt::format(".TH {} 1 \"\" \"parity {}\" \"User Commands\"\n", roff(title), base::kVersion);
  const std::string summary =
      command.empty() ? "compare how a material looks on two shading paths" : firstLine(text.help);
  page += fmt::format(".SH NAME\n{} \\- {}\n", roff(pageName(command)), roff(summary));
  page +=
      ".SH SYNOPSIS\n" + synopsisOf(text) + ".SH DESCRIPTION\n" + paragraphs(text.help + (command.empty() ? "" : "."));
  if (command.empty()) {
    page += ".SH COMMANDS\n";
    for (const CommandText& each : program.commands)
      page += fmt::format(".TP\n.B {}\n{}.\n", roff(each.name), roff(firstLine(each.help)));
  }
  page += ".SH OPTIONS\n" + optionSections(text) + tailOf(help);
  if (!command.empty())
    for (const CommandText& below : text.commands) {
      page +=
          fmt::format(".SH PARITY {}\n", roff(below.name)) + synopsisOf(below) + ".PP\n" + paragraphs(below.help + ".");
      page += optionSections(below);
      for (const Example& example : helpOf(below.name).examples)
        page += fmt::format(".SS Example\n.TP\n.B {}\n{}.\n", roff(example.line), roff(example.what));
    }
  std::vector<std::string> others;
  if (!command.empty()) others.emplace_back(".BR parity (1)");
  if (command.empty())
    for (const CommandText& each : program.commands)
      others.push_back(fmt::format(".BR {} (1)", roff(pageName(each.name))));
  page += fmt::format(".SH SEE ALSO\n{}\n", fmt::join(others, ",\n"));
  return page;
}

std::vector<std::pair<std::string, std::string>> manPages(const CommandText& program) {
  std::vector<std::pair<std::string, std::string>> pages = {{pageName("") + ".1", manPage(program, "")}};
  for (const CommandText& each : program.commands)
    pages.emplace_back(pageName(each.name) + ".1", manPage(program, each.name));
  return pages;
}

} // namespace parity::cli
