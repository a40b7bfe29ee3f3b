#include "cli/options/mistyped.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/nearest.h"

namespace parity::cli {

namespace {

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* each) { return !each->get_name().empty(); });
}

std::string sayUnknownCommand(const CLI::App& app, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* each : commandsOf(app)) names.push_back(each->get_name());
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string asked = base::askNearest(name, known);
  return fmt::format("{}: unknown subcommand; {}", name,
                     asked.empty() ? fmt::format("'{} --help' lists them", fullName(app)) : asked);
}

// "--name" of all options, those that are shown first: of two that are equally near the first is said.
std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const bool isShown : {true, false})
    for (const CLI::Option* option :
         app.get_options([&](const CLI::Option* o) { return o->get_group().empty() != isShown; }))
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// The commands besides `app` that have this very option: at most a few.
std::vector<std::string> ownersOf(const CLI::App& app, const CLI::App& root, const std::string& name) {
  std::vector<std::string> owners;
  for (const CLI::App* each : commandsOf(root)) {
    for (std::string& below : ownersOf(app, *each, name)) owners.push_back(std::move(below));
    if (each != &app && each->get_option_no_throw(name)) owners.push_back(fmt::format("'{}'", fullName(*each)));
  }
  constexpr std::size_t kMost = 3;
  if (owners.size() > kMost) owners.resize(kMost);
  return owners;
}

std::string sayUnknownOption(const CLI::App& app, const std::string& given) {
  const std::string name = given.substr(0, given.find('='));
  const std::size_t dashes = std::min(name.find_first_not_of('-'), name.size());
  const std::vector<std::string> names = optionNames(app);
  const std::vector<std::string_view> known(names.begin(), names.end());
  const CLI::App* root = &app;
  while (root->get_parent()) root = root->get_parent();
  std::string hint;
  if (const auto owners = ownersOf(app, *root, name); dashes == 2 && !owners.empty())
    hint = fmt::format("{} {} it", fmt::join(owners, ", "), owners.size() == 1 ? "has" : "have");
  else if (name.size() > 2) // one letter is near to everything
    hint = base::askNearest("--" + name.substr(dashes), known);
  if (hint.empty()) hint = fmt::format("'{} --help' lists them", fullName(app));
  return fmt::format("{}: '{}' has no such option; {}", name, fullName(app), hint);
}

} // namespace

const CLI::App& chosenOf(const CLI::App& app) {
  const CLI::App* chosen = &app;
  for (auto given = app.get_subcommands(); !given.empty(); given = chosen->get_subcommands()) chosen = given.front();
  return *chosen;
}

std::string fullName(const CLI::App& app) {
  return app.get_parent() ? fullName(*app.get_parent()) + " " + app.get_name() : app.get_name();
}

std::string describeMistyped(const CLI::App& app) {
  const CLI::App& chosen = chosenOf(app);
  const std::vector<std::string> remaining = chosen.remaining();
  for (const std::string& each : remaining)
    if (each.size() > 1 && each.front() == '-' && each != "--") return sayUnknownOption(chosen, each);
  if (!remaining.empty() && !commandsOf(chosen).empty()) return sayUnknownCommand(chosen, remaining.front());
  return {};
}

} // namespace parity::cli
