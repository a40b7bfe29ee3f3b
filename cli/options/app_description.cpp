#include "cli/options/app_description.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <CLI/CLI.hpp>

#include "cli/options/option_parts.h"

namespace parity::cli {

namespace {

// "{a,b}" or "TEXT:{a,b}" as a list.
std::vector<std::string> choicesOf(const std::string& type) {
  const std::size_t begin = type.find('{'), end = type.rfind('}');
  std::vector<std::string> choices;
  if (begin == std::string::npos || end == std::string::npos || end < begin) return choices;
  for (std::size_t at = begin + 1; at <= end;) {
    const std::size_t comma = std::min(type.find(',', at), end);
    choices.push_back(type.substr(at, comma - at));
    at = comma + 1;
  }
  return choices;
}

OptionText describeOption(const CLI::Option& option) {
  OptionText text;
  if (!option.nonpositional()) {
    text.names = {option.get_name(true, false)};
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() > 0) {
    text.value = option.get_type_name();
    text.choices = choicesOf(text.value);
    text.defaultText = option.get_default_str();
  }
  text.help = option.get_description();
  text.isRequired = option.get_required();
  text.isRepeatable = option.get_expected_max() > 1;
  return text;
}

CommandText describeCommand(const CLI::App& app, const std::string& name) {
  CommandText command{.name = name, .help = app.get_description(), .positionals = {}, .groups = {}, .commands = {}};
  for (const CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->get_positional(); }))
    command.positionals.push_back(describeOption(*option));
  for (const std::string& title : groupTitles(app)) {
    OptionGroup group{title, {}};
    for (const CLI::Option* option :
         app.get_options([&](const CLI::Option* o) { return o->nonpositional() && o->get_group() == title; }))
      group.options.push_back(describeOption(*option));
    if (!group.options.empty()) command.groups.push_back(std::move(group));
  }
  for (const CLI::App* below : app.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
    command.commands.push_back(
        describeCommand(*below, name.empty() ? below->get_name() : name + " " + below->get_name()));
  return command;
}

} // namespace

std::vector<std::string> groupTitles(const CLI::App& app) {
  constexpr std::array<std::string_view, 2> kFirst = {kInputGroup, kOutputGroup};
  constexpr std::array<std::string_view, 3> kLast = {kMachineGroup, kCacheGroup, kGeneralGroup};
  const auto placeOf = [&](const std::string& title) {
    if (const auto first = std::ranges::find(kFirst, title); first != kFirst.end()) return first - kFirst.begin();
    const auto last = std::ranges::find(kLast, title);
    return last == kLast.end() ? std::ssize(kFirst) : std::ssize(kFirst) + 1 + (last - kLast.begin());
  };
  std::vector<std::string> titles = app.get_groups();
  std::erase_if(titles, [](const std::string& title) { return title.empty(); });
  std::ranges::stable_sort(titles, {}, placeOf);
  return titles;
}

CommandText describeProgram(const CLI::App& app) { return describeCommand(app, ""); }

} // namespace parity::cli
