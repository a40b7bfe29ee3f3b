#include "scenes/suite/expand.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/text/glob.h"
#include "base/text/nearest.h"
#include "scenes/names.h"

namespace parity::scenes {
namespace {

constexpr std::string_view kTag = "tag:";

base::Error errorAt(const std::string& where, const std::string& reason) {
  return base::Error(base::ExitCode::failed, where, "", reason);
}

std::string wordOf(const base::Knob& knob, const base::GivenKnob& given) {
  if (const std::filesystem::path path(given.value.at(0)); knob.takesFolder && path.has_parent_path())
    return (path.has_filename() ? path : path.parent_path()).filename().string();
  return knob.type == base::KnobType::file ? stemOf(given.value.at(0))
                                           : fmt::format("{}", fmt::join(given.value, ", "));
}

// "environment" for the list `environments`.
std::string placeholderOf(const base::Knob& knob) { return knob.listKey.substr(0, knob.listKey.size() - 1); }

using Placeholders = std::map<std::string, std::string, std::less<>>;

std::string fillIn(const std::string& text, const Placeholders& values, const std::string& where) {
  std::string name;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('{', at), close = text.find('}', open);
    if (open == std::string::npos || close == std::string::npos) return name + text.substr(at);
    name += text.substr(at, open - at);
    const std::string key = text.substr(open + 1, close - open - 1);
    const auto found = values.find(key);
    if (found == values.end()) {
      std::vector<std::string_view> known;
      for (const auto& [each, value] : values) known.push_back(each);
      throw errorAt(where,
                    fmt::format("'{{{}}}' has no value here; {}", cleanName(key), base::describeNearest(key, known)));
    }
    name += found->second;
    at = close + 1;
  }
  return name;
}

// One [[scene]] table.
class TableExpansion {
public:
  TableExpansion(const SceneTable& table, const SceneWords& defaults) : m_table(table), m_lists(table.words.lists) {
    // A list of [defaults] counts where the scene says nothing of that knob.
    for (const KnobList& list : defaults.lists) {
      const auto own = std::ranges::find(m_lists, list.knob.id, [](const KnobList& each) { return each.knob.id; });
      if (own == m_lists.end() && !table.words.given.contains(list.knob.id)) m_lists.push_back(list);
    }
    for (const base::GivenKnobs* given : {&defaults.given, &table.words.given})
      for (const auto& [id, value] : *given) m_single[id] = value;
  }

  void appendTo(std::vector<SuiteEntry>& entries) const {
    std::size_t each = 1;
    for (const KnobList& list : m_lists) each *= list.values.size();
    if (m_table.files.size() * each > kMostScenes - std::min(entries.size(), kMostScenes))
      throw errorAt(m_table.where, fmt::format("the suite has more than {} scenes", kMostScenes));
    for (const std::string& file : m_table.files)
      for (std::size_t i = 0; i < each; ++i) entries.push_back(entryOf(file, i));
  }

private:
  SuiteEntry entryOf(const std::string& file, std::size_t number) const {
    SuiteEntry entry{.name = {},
                     .scene = file,
                     .defaults = {},
                     .given = m_table.words.given,
                     .captures = m_table.captures,
                     .views = m_table.views,
                     .budgets = m_table.budgets,
                     .tags = m_table.tags,
                     .externals = m_table.externals,
                     .where = m_table.where};
    Placeholders words = {{"stem", stemOf(file)},
                          {"file", std::filesystem::path(file).filename().string()},
                          {"folder", std::filesystem::path(file).parent_path().filename().string()}};
    std::string ofLists;
    for (auto list = m_lists.rbegin(); list != m_lists.rend(); ++list) {
      const base::GivenKnob& value = list->values[number % list->values.size()];
      number /= list->values.size();
      entry.given[list->knob.id] = value;
      words[placeholderOf(list->knob)] = wordOf(list->knob, value);
      if (list->values.size() > 1) ofLists = ", " + wordOf(list->knob, value) + ofLists;
    }
    for (const auto& [id, value] : m_single) addSingle(words, id, value);
    entry.name = cleanName(m_table.name ? fillIn(*m_table.name, words, m_table.nameWhere) : words["stem"] + ofLists);
    if (entry.name.empty()) throw errorAt(m_table.where, fmt::format("the name of '{}' is empty", file));
    return entry;
  }

  void addSingle(Placeholders& words, const std::string& id, const base::GivenKnob& value) const {
    for (const base::Knob& knob : m_table.listed)
      if (knob.id == id) words.try_emplace(placeholderOf(knob), wordOf(knob, value));
  }

  const SceneTable& m_table;
  KnobLists m_lists;
  base::GivenKnobs m_single;
};

bool isMeant(const std::string& glob, const SuiteEntry& entry) {
  if (glob.starts_with(kTag)) return std::ranges::binary_search(entry.tags, glob.substr(kTag.size()));
  return base::matchesGlob(glob, entry.name);
}

std::string whyNone(const std::string& glob, const std::vector<SuiteEntry>& entries) {
  if (glob.starts_with(kTag)) return fmt::format("no scene has the tag '{}'", glob.substr(kTag.size()));
  std::vector<std::string_view> known;
  for (const SuiteEntry& entry : entries) known.push_back(entry.name);
  return fmt::format("no scene matches '{}'; {}", glob, base::describeNearestToGlob(glob, known));
}

void apply(OverrideTable& over, SuiteEntry& entry) {
  entry.given = base::merged(entry.given, over.given);
  if (over.budgets) entry.budgets = over.budgets;
  entry.tags.insert(entry.tags.end(), over.tags.begin(), over.tags.end());
  std::ranges::sort(entry.tags);
  entry.tags.erase(std::unique(entry.tags.begin(), entry.tags.end()), entry.tags.end());
  for (ViewOverride& view : over.views)
    for (ViewRequest& each : entry.views) {
      if (!base::matchesGlob(view.name, each.name)) continue;
      view.isUsed = true;
      view.apply(each);
    }
}

} // namespace

std::vector<SuiteEntry> expandScenes(const SuiteTables& tables) {
  std::vector<SuiteEntry> entries;
  for (const SceneTable& table : tables.scenes) TableExpansion(table, tables.defaults).appendTo(entries);
  return entries;
}

void applyOverrides(std::vector<OverrideTable>& overrides, std::vector<SuiteEntry>& entries) {
  for (OverrideTable& over : overrides) {
    std::vector<bool> isUsed(over.scenes.size(), false);
    for (SuiteEntry& entry : entries) {
      bool is = false;
      for (std::size_t i = 0; i < over.scenes.size(); ++i)
        if (isMeant(over.scenes[i], entry)) is = isUsed[i] = true;
      if (is) apply(over, entry);
    }
    for (std::size_t i = 0; i < isUsed.size(); ++i)
      if (!isUsed[i]) throw errorAt(over.scenesWhere, whyNone(over.scenes[i], entries));
    for (const ViewOverride& view : over.views)
      if (!view.isUsed) throw errorAt(view.where, fmt::format("no view of these scenes matches '{}'", view.name));
  }
}

void requireDifferentNames(const std::vector<SuiteEntry>& entries) {
  std::map<std::string_view, const SuiteEntry*> names;
  for (const SuiteEntry& entry : entries) {
    const auto [place, isNew] = names.try_emplace(entry.name, &entry);
    if (isNew) continue;
    const SuiteEntry& first = *place->second;
    const bool isOneTable = first.where == entry.where;
    throw errorAt(entry.where, fmt::format("two scenes have the name '{}': {} and {}{}; {}", entry.name, first.scene,
                                           entry.scene, isOneTable ? "" : fmt::format(" ({})", first.where),
                                           isOneTable ? "make 'name' tell them apart, as name = \"{folder}, {stem}\""
                                                      : "give each its own name"));
  }
}

} // namespace parity::scenes
