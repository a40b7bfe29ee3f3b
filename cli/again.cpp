#include "cli/again.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include <CLI/CLI.hpp>

#include "base/text/shell_word.h"
#include "report/view_choice.h"

namespace parity::cli {

namespace {

// "env": a scene has its own of several. The last ones change no figure.
constexpr std::array<std::string_view, 19> kNotKept = {
    "suite",   "only",           "env",          "json",    "annotate", "all",      "csv",
    "quiet",   "timings",        "verbose",      "threads", "cache",    "no-cache", "cache-size",
    "summary", "summary-format", "pictures-url", "fail-on", "history"};

// What begins with '-' would be an option of its own.
void add(std::vector<std::string>& words, const std::string& option, const std::string& value) {
  if (value.starts_with('-')) return words.push_back(option + "=" + value);
  words.push_back(option);
  words.push_back(value);
}

using FilesByName = std::unordered_multimap<std::string, std::string>;

// "bottle (2)": alone it is called "bottle".
bool isCopy(const job::SceneRequest& scene, const FilesByName& files) {
  for (std::size_t at = scene.name.find(" ("); at != std::string::npos; at = scene.name.find(" (", at + 1)) {
    const auto [begin, end] = files.equal_range(scene.name.substr(0, at));
    if (std::any_of(begin, end, [&](const auto& other) { return other.second != scene.scene; })) return true;
  }
  return false;
}

// Without what knows scenes by their names.
std::vector<std::string> withoutNames(const std::vector<std::string>& kept) {
  std::vector<std::string> rest;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    constexpr std::array<std::string_view, 3> kOfNames = {"--baseline", "--budgets", "--approvals"};
    const std::string_view option = std::string_view(kept[i]).substr(0, kept[i].find('='));
    if (std::ranges::count(kOfNames, option) == 0)
      rest.push_back(kept[i]);
    else if (option == kept[i])
      ++i; // its value
  }
  return rest;
}

} // namespace

std::vector<std::string> keptWords(const CLI::App& parsed, const CLI::App& other) {
  std::vector<std::string> words;
  for (const CLI::Option* option : parsed.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string& name = option->get_lnames().front();
    if (std::ranges::count(kNotKept, name) > 0 || !other.get_option_no_throw("--" + name)) continue;
    if (option->get_items_expected_max() == 0) {
      words.push_back("--" + name);
      continue;
    }
    for (const std::string& value : option->results()) add(words, "--" + name, value);
  }
  return words;
}

std::vector<report::AgainCommand> againCommands(const std::vector<job::SceneRequest>& scenes, const SceneSource& source,
                                                const std::vector<std::string>& kept) {
  std::vector<report::AgainCommand> commands;
  FilesByName files;
  for (const job::SceneRequest& scene : scenes) files.emplace(scene.name, scene.scene);
  for (const job::SceneRequest& scene : scenes) {
    const std::vector<std::string> rest = isCopy(scene, files) ? withoutNames(kept) : kept;
    for (const scenes::ViewRequest& view : scene.views) {
      std::vector<std::string> words = {"parity", "diff"};
      const std::string& environment = scene.settings.scene.environment;
      const bool isOfMany = !source.suite.empty() || source.environments.size() > 1;
      if (!source.suite.empty())
        add(words, "--suite", source.suite);
      else
        words.push_back(scene.scene.starts_with('-') ? "./" + scene.scene : scene.scene);
      // All of several, whose names are the scenes': baseline, budgets and approvals know them by these.
      for (const std::string& each : source.environments.size() > 1                 ? source.environments
                                     : source.suite.empty() && !environment.empty() ? std::vector{environment}
                                                                                    : std::vector<std::string>())
        add(words, "--env", each);
      words.insert(words.end(), rest.begin(), rest.end());
      if (isOfMany) add(words, "--only", report::globOf(scene.name) + "/" + report::globOf(view.name));
      std::string line;
      for (const std::string& word : words) line += (line.empty() ? "" : " ") + base::shellWord(word);
      commands.push_back({scene.name, view.name, line});
    }
  }
  return commands;
}

} // namespace parity::cli
