#include "scenes/suite/suite_tables.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/text/nearest.h"
#include "scenes/names.h"
#include "scenes/scene_settings.h"
#include "scenes/suite/scene_files.h"
#include "scenes/suite/table_reader.h"

namespace parity::scenes {
namespace {

constexpr std::size_t kMaxSuiteBytes = std::size_t{16} << 20;
constexpr std::size_t kMaxCapturePlaces = 8;

using Check = std::function<void(const base::Knob&, const base::KnobValue&)>;

// The keys of these knobs, their older names and their lists too, after `others`.
std::vector<std::string> keysOf(const std::vector<base::Knob>& knobs, std::vector<std::string> others, bool lists) {
  for (const base::Knob& knob : knobs) {
    others.push_back(base::keyOf(knob.id));
    for (const std::string& alias : knob.aliases) others.push_back(base::keyOf(alias));
    if (lists && !knob.listKey.empty()) others.push_back(knob.listKey);
  }
  return others;
}

std::vector<base::Knob> viewKnobList() {
  std::vector<base::Knob> knobs;
  for (const auto& row : viewKnobs().rows()) knobs.push_back(row.knob);
  return knobs;
}

class SuiteTablesReader {
public:
  SuiteTablesReader(const std::filesystem::path& file, const SuiteKnobs& knobs)
      : m_label(file.string()), m_folder(file.parent_path()), m_knobs(knobs) {}

  SuiteTables read(const toml::table& root) {
    const TableReader reader(m_label, root, "a suite",
                             {"name", "budgets", "include", "defaults", "view", "scene", "override"});
    SuiteTables suite;
    suite.name = cleanName(reader.text("name").value_or(std::filesystem::path(m_label).stem().string()));
    if (const auto budgets = reader.text("budgets")) suite.budgets = resolve(*budgets);
    for (const std::string& file : reader.texts("include"))
      suite.include.emplace_back(resolve(file), reader.placeOf("include"));
    if (const toml::table* defaults = reader.table("defaults", "[defaults]")) {
      const TableReader table(m_label, *defaults, "[defaults]", keysOf(m_knobs.knobs, {"fog"}, true));
      suite.defaults = readWords(table);
    }
    m_views = readViews(reader, "the suite");
    for (const toml::table* table : reader.tables("scene")) suite.scenes.push_back(readScene(*table));
    for (const toml::table* table : reader.tables("override")) suite.overrides.push_back(readOverride(*table));
    return suite;
  }

private:
  std::string resolve(const std::string& file) const {
    return isBuiltin(file) ? file : (m_folder / file).lexically_normal().string();
  }

  SceneTable readScene(const toml::table& table) const {
    const TableReader reader(
        m_label, table, "a scene",
        keysOf(m_knobs.knobs,
               {"name", "file", "files", "exclude", "captures", "budgets", "tags", "views", "view", "fog", "external"},
               true));
    SceneTable scene{.where = reader.place(),
                     .filesWhere = {},
                     .files = readFiles(reader),
                     .name = {},
                     .nameWhere = {},
                     .words = readWords(reader),
                     .listed = {},
                     .captures = {},
                     .views = {},
                     .budgets = {},
                     .tags = readTags(reader)};
    std::ranges::copy_if(m_knobs.knobs, std::back_inserter(scene.listed),
                         [](const base::Knob& knob) { return !knob.listKey.empty(); });
    scene.externals = readExternals(reader);
    scene.filesWhere = reader.placeOf(reader.has("files") ? "files" : "file");
    if ((scene.name = reader.text("name"))) scene.nameWhere = reader.placeOf("name");
    scene.captures = reader.points("captures", kMaxCapturePlaces);
    if (const auto budgets = reader.text("budgets")) scene.budgets = resolve(*budgets);
    scene.views = chooseViews(reader);
    std::vector<ViewRequest> own = readViews(reader, "a scene");
    std::ranges::move(own, std::back_inserter(scene.views));
    requireDifferentNames(reader, scene.views);
    if (scene.views.empty()) scene.views = m_views;
    if (scene.views.empty()) scene.views.emplace_back();
    return scene;
  }

  std::vector<std::string> readFiles(const TableReader& reader) const {
    const auto file = reader.text("file");
    const std::vector<std::string> files = reader.texts("files"), exclude = reader.texts("exclude");
    if (file && !files.empty()) throw reader.errorAt("files", "cannot be combined with 'file'");
    if (!file && files.empty())
      throw reader.errorAt("file", "is missing; a scene needs a file or \"builtin:NAME\", or 'files' with globs");
    if (files.empty() && !exclude.empty()) throw reader.errorAt("exclude", "needs 'files'");
    if (file) return {resolve(*file)};
    try {
      return findSceneFiles({m_folder, files, exclude});
    } catch (const std::runtime_error& error) {
      throw reader.errorAt("files", error.what());
    }
  }

  // Of the suite's views those that `views` names.
  std::vector<ViewRequest> chooseViews(const TableReader& reader) const {
    std::vector<ViewRequest> chosen;
    std::vector<std::string_view> known;
    for (const ViewRequest& view : m_views) known.push_back(view.name);
    for (const std::string& name : reader.texts("views")) {
      const auto found = std::ranges::find(m_views, cleanName(name), &ViewRequest::name);
      if (found == m_views.end())
        throw reader.errorAt("views", fmt::format("no [[view]] of the suite has the name '{}'{}", name,
                                                  known.empty() ? "" : "; " + base::describeNearest(name, known)));
      chosen.push_back(*found);
    }
    return chosen;
  }

  std::vector<ExternalPictures> readExternals(const TableReader& reader) const {
    std::vector<ExternalPictures> externals;
    for (const toml::table* table : reader.tables("external")) {
      const TableReader row(m_label, *table, "an external",
                            {"name", "test", "reference", "transfer", "replaces", "calibration"});
      ExternalPictures& external = externals.emplace_back();
      const auto fileOf = [&](const char* key) {
        const auto text = row.text(key);
        return text ? resolve(*text) : std::string();
      };
      external.name = cleanName(row.text("name").value_or(""));
      if (external.name.empty()) throw row.errorAt("name", "is missing; it stands for the pictures in reports");
      external.test = fileOf("test");
      if (external.test.empty())
        throw row.errorAt("test", "is missing; it is a picture, such as \"shots/{scene}-{view}.png\", or a folder");
      external.reference = fileOf("reference"), external.calibration = fileOf("calibration");
      external.transfer = row.text("transfer").value_or(external.transfer);
      external.replaces = row.text("replaces").value_or("");
      external.where = row.place();
      if (!external.reference.empty() && !external.replaces.empty())
        throw row.errorAt("replaces", "cannot be combined with 'reference': the pictures are held against each other");
      if (std::ranges::count(externals, external.name, &ExternalPictures::name) > 1)
        throw row.errorAt("name", fmt::format("two externals of a scene have the name '{}'", external.name));
    }
    return externals;
  }

  void requireDifferentNames(const TableReader& reader, const std::vector<ViewRequest>& views) const {
    std::set<std::string> names;
    for (const ViewRequest& view : views)
      if (!names.insert(view.name).second)
        throw reader.errorAt("view", fmt::format("two views have the name '{}'", view.name));
  }

  std::vector<std::string> readTags(const TableReader& reader) const {
    std::vector<std::string> tags = reader.texts("tags");
    for (const std::string& tag : tags)
      if (tag != cleanName(tag) || tag.find_first_of("*?[]/ ") != std::string::npos)
        throw reader.errorAt(
            "tags",
            fmt::format("'{}' holds a character that a tag may not have (* ? [ ] / or a blank)", cleanName(tag)));
    std::ranges::sort(tags);
    tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
    return tags;
  }

  OverrideTable readOverride(const toml::table& table) const {
    const TableReader reader(m_label, table, "an override",
                             keysOf(m_knobs.knobs, {"scenes", "budgets", "tags", "view", "fog"}, false));
    OverrideTable over;
    over.where = reader.place();
    over.scenes = reader.texts("scenes");
    if (over.scenes.empty())
      throw reader.errorAt("scenes", "is missing; an override needs globs of scene names, or \"tag:NAME\"");
    over.scenesWhere = reader.placeOf("scenes");
    over.given = readSceneKnobs(reader);
    if (const auto budgets = reader.text("budgets")) over.budgets = resolve(*budgets);
    over.tags = readTags(reader);
    for (const toml::table* view : reader.tables("view")) over.views.push_back(readViewOverride(*view));
    return over;
  }

  ViewOverride readViewOverride(const toml::table& table) const {
    const std::vector<base::Knob> knobs = viewKnobList();
    const TableReader reader(m_label, table, "a view of an override", keysOf(knobs, {"name"}, false));
    ViewOverride over;
    over.name = reader.text("name").value_or("*");
    over.where = reader.has("name") ? reader.placeOf("name") : reader.place();
    ViewRequest scratch;
    const base::GivenKnobs given = readKnobs(reader, knobs, [&](const base::Knob& knob, const base::KnobValue& value) {
      viewKnobs().find(knob.id)->set(scratch, value);
    });
    requireOneCamera(reader, scratch);
    over.apply = [given](ViewRequest& view) {
      if (given.contains("camera")) view.orbit.reset(), view.target.reset();
      if (given.contains("orbit") || given.contains("target")) view.camera.clear();
      viewKnobs().apply(view, given);
    };
    return over;
  }

  static void requireOneCamera(const TableReader& reader, const ViewRequest& view) {
    if (!view.camera.empty() && (view.orbit || view.target))
      throw reader.errorAt("camera", "cannot be combined with an orbit or a target");
  }

  std::vector<ViewRequest> readViews(const TableReader& reader, std::string_view of) const {
    std::vector<ViewRequest> views;
    const std::vector<base::Knob> knobs = viewKnobList();
    for (const toml::table* table : reader.tables("view")) {
      const TableReader row(m_label, *table, "a view", keysOf(knobs, {"name"}, false));
      ViewRequest view;
      readKnobs(row, knobs, [&](const base::Knob& knob, const base::KnobValue& value) {
        viewKnobs().find(knob.id)->set(view, value);
      });
      requireOneCamera(row, view);
      view.name = cleanName(row.text("name").value_or(!view.camera.empty() ? view.camera
                                                      : view.orbit         ? fmt::format("view {}", views.size() + 1)
                                                                           : std::string("auto")));
      if (std::ranges::find(views, view.name, &ViewRequest::name) != views.end())
        throw reader.errorAt(*table, "view", fmt::format("two views of {} have the name '{}'", of, view.name));
      views.push_back(std::move(view));
    }
    return views;
  }

  // What a table says of these knobs.
  base::GivenKnobs readKnobs(const TableReader& reader, const std::vector<base::Knob>& knobs,
                             const Check& check) const {
    base::GivenKnobs given;
    for (const base::Knob& knob : knobs) {
      std::vector<std::string> names = {knob.id};
      names.insert(names.end(), knob.aliases.begin(), knob.aliases.end());
      for (const std::string& name : names) {
        const std::string key = base::keyOf(name);
        const std::optional<base::KnobValue> value = reader.value(key, knob);
        if (!value) continue;
        if (given.contains(knob.id))
          throw reader.errorAt(
              key, fmt::format("has the same meaning as '{}'; give only one of them", base::keyOf(knob.id)));
        given[knob.id] = checked(reader, key, knob, *value, check);
      }
    }
    return given;
  }

  base::GivenKnob checked(const TableReader& reader, const std::string& key, const base::Knob& knob,
                          base::KnobValue value, const Check& check) const {
    const bool isFolder = knob.takesFolder && value.at(0).find('/') != std::string::npos;
    if (knob.type == base::KnobType::file || isFolder) value = {resolve(value.at(0))};
    if (isFolder && value.at(0).find('/') == std::string::npos) value = {"./" + value.at(0)}; // not a name
    try {
      check(knob, value);
    } catch (const base::KnobError& error) {
      throw reader.errorAt(key, error.reason);
    }
    return {std::move(value), reader.placeOf(key)};
  }

  SceneWords readWords(const TableReader& reader) const {
    SceneWords words{.given = readSceneKnobs(reader), .lists = {}};
    for (const base::Knob& knob : m_knobs.knobs) {
      if (knob.listKey.empty() || !reader.has(knob.listKey)) continue;
      if (words.given.contains(knob.id))
        throw reader.errorAt(knob.listKey,
                             fmt::format("cannot be combined with a single value ({})", words.given.at(knob.id).where));
      KnobList list{.knob = knob, .values = {}};
      for (const base::KnobValue& value : reader.values(knob.listKey, knob))
        list.values.push_back(checked(reader, knob.listKey, knob, value, m_knobs.check));
      words.lists.push_back(std::move(list));
    }
    return words;
  }

  base::GivenKnobs readSceneKnobs(const TableReader& reader) const {
    if (!reader.has("fog") || reader.isList("fog")) return readKnobs(reader, m_knobs.knobs, m_knobs.check);
    // The table [fog]: each key is a knob of its own, but the first three, which are one.
    std::vector<base::Knob> others;
    std::copy_if(m_knobs.knobs.begin(), m_knobs.knobs.end(), std::back_inserter(others),
                 [](const base::Knob& knob) { return knob.id != "fog"; });
    base::GivenKnobs given = readKnobs(reader, others, m_knobs.check);
    const TableReader fog(m_label, *reader.table("fog", "[scene.fog]"), "a fog",
                          {"density", "height_falloff", "height", "color", "start_distance", "max_opacity"});
    if (!fog.has("density")) throw fog.errorAt("density", "is missing; it is the extinction in 1/m");
    const base::Knob number{.id = {}, .type = base::KnobType::number};
    std::string numbers;
    for (const char* key : {"density", "height_falloff", "height"})
      numbers += (numbers.empty() ? "" : ",") + fog.value(key, number).value_or(base::KnobValue{"0"}).at(0);
    for (const auto& [id, key] : {std::pair("fog", "density"), std::pair("fog-color", "color"),
                                  std::pair("fog-start", "start_distance"), std::pair("fog-opacity", "max_opacity")}) {
      // A lambda may not take a structured binding by reference in every compiler of C++20.
      const auto knob = std::find_if(m_knobs.knobs.begin(), m_knobs.knobs.end(),
                                     [id = id](const base::Knob& each) { return each.id == id; });
      if (knob == m_knobs.knobs.end() || !fog.has(key)) continue;
      given[knob->id] = checked(fog, key, *knob, knob->id == "fog" ? base::KnobValue{numbers} : *fog.value(key, *knob),
                                m_knobs.check);
    }
    return given;
  }

  const std::string m_label;
  const std::filesystem::path m_folder;
  const SuiteKnobs& m_knobs;
  std::vector<ViewRequest> m_views; // of the suite
};

} // namespace

SuiteTables readSuiteTables(const std::filesystem::path& file, const SuiteKnobs& knobs) {
  const std::string label = file.string();
  std::string text;
  try {
    text = base::readText(file, kMaxSuiteBytes);
  } catch (const base::Error& error) {
    throw base::fileError(label, "", error.reason());
  }
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw base::fileError(label,
                          fmt::format("line {}, column {}", error.source().begin.line, error.source().begin.column),
                          std::string(error.description()));
  }
  return SuiteTablesReader(file, knobs).read(root);
}

} // namespace parity::scenes
