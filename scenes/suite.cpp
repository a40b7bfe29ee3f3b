// The suite file: TOML, every key known, every value checked. docs/suite.md describes it.
#include "scenes/suite.h"

#include <array>
#include <cmath>
#include <set>
#include <span>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "scenes/names.h"

namespace parity::scenes {
namespace {

constexpr std::size_t kMaxSuiteBytes = std::size_t{16} << 20;
constexpr std::string_view kBuiltin = "builtin:";

constexpr std::array<std::string_view, 3> kSuiteKeys = {"name", "budgets", "scene"};
constexpr std::array<std::string_view, 24> kSceneKeys = {"name",
                                                         "file",
                                                         "time",
                                                         "animation",
                                                         "scene",
                                                         "variant",
                                                         "subject",
                                                         "environment",
                                                         "environment_rotation",
                                                         "sun_extraction",
                                                         "sun",
                                                         "sky_light_color",
                                                         "indirect_lighting_color_scale",
                                                         "directional_specular_scale",
                                                         "falloff",
                                                         "fog",
                                                         "baked",
                                                         "captures",
                                                         "shadows",
                                                         "interreflection",
                                                         "fully_rough",
                                                         "budgets",
                                                         "exposure",
                                                         "view"};
constexpr std::size_t kMaxCapturePlaces = 8;
constexpr std::array<std::string_view, 6> kFogKeys = {"density", "height_falloff", "height",
                                                      "color",   "start_distance", "max_opacity"};
constexpr std::array<std::string_view, 5> kViewKeys = {"name", "camera", "orbit", "target", "fov"};

// One table of the file: typed access with errors that name file, line and key.
class TableReader {
public:
  TableReader(const std::string& label, const toml::table& table, std::string_view what,
              std::span<const std::string_view> known)
      : m_label(label), m_table(table) {
    for (const auto& [key, node] : table) {
      const std::string_view name = key.str();
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw errorAt(node, cleanName(name),
                      fmt::format("no such key in {}; {}", what, base::describeNearest(name, known)));
    }
  }

  base::Error errorAt(const toml::node& node, const std::string& key, const std::string& reason) const {
    return base::fileError(m_label, fmt::format("line {}: {}", node.source().begin.line, key), reason);
  }
  base::Error errorAt(std::string_view key, const std::string& reason) const {
    const toml::node* node = m_table.get(key);
    return errorAt(node ? *node : static_cast<const toml::node&>(m_table), std::string(key), reason);
  }

  std::optional<std::string> text(std::string_view key) const {
    const toml::node* node = m_table.get(key);
    if (!node) return std::nullopt;
    if (!node->is_string()) throw errorAt(key, "not a string");
    std::string value = node->value_or(std::string{});
    if (value.empty()) throw errorAt(key, "an empty string");
    return value;
  }

  std::optional<double> real(std::string_view key, double least, double most) const {
    const toml::node* node = m_table.get(key);
    if (!node) return std::nullopt;
    return numberOf(*node, key, least, most);
  }
  std::optional<float> number(std::string_view key, double least, double most) const {
    const std::optional<double> value = real(key, least, most);
    return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
  }

  std::optional<int> whole(std::string_view key, int least, int most) const {
    const std::optional<double> value = real(key, least, most);
    if (value && *value != std::floor(*value)) throw errorAt(key, "not a whole number");
    return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
  }

  template <std::size_t kCount> std::optional<std::array<float, kCount>>
  numbers(std::string_view key, double least = -1e30, double most = 1e30) const {
    const toml::node* node = m_table.get(key);
    if (!node) return std::nullopt;
    const toml::array* list = node->as_array();
    if (!list || list->size() != kCount) throw errorAt(key, fmt::format("not a list of {} numbers", kCount));
    std::array<float, kCount> values;
    for (std::size_t i = 0; i < kCount; ++i) values[i] = static_cast<float>(numberOf((*list)[i], key, least, most));
    return values;
  }

  std::optional<glm::vec3> color(std::string_view key, double most) const {
    const auto rgb = numbers<3>(key, 0, most);
    return rgb ? std::optional(glm::vec3((*rgb)[0], (*rgb)[1], (*rgb)[2])) : std::nullopt;
  }

  std::optional<bool> truth(std::string_view key) const {
    const toml::node* node = m_table.get(key);
    if (!node) return std::nullopt;
    if (!node->is_boolean()) throw errorAt(key, "neither true nor false");
    return node->value<bool>();
  }

  std::vector<std::string> texts(std::string_view key) const {
    const toml::node* node = m_table.get(key);
    if (!node) return {};
    const toml::array* list = node->as_array();
    if (!list) throw errorAt(key, "not a list of strings");
    std::vector<std::string> values;
    for (const toml::node& entry : *list) {
      if (!entry.is_string()) throw errorAt(entry, std::string(key), "not a list of strings");
      values.push_back(entry.value_or(std::string{}));
    }
    return values;
  }

  // A list of [x, y, z]; empty where it is absent.
  std::vector<glm::vec3> points(std::string_view key, std::size_t most) const {
    const toml::node* node = m_table.get(key);
    if (!node) return {};
    const toml::array* list = node->as_array();
    if (!list || list->size() > most) throw errorAt(key, fmt::format("not a list of at most {} places", most));
    std::vector<glm::vec3> values;
    for (const toml::node& entry : *list) {
      const toml::array* place = entry.as_array();
      if (!place || place->size() != 3) throw errorAt(entry, std::string(key), "not a list of places [x, y, z]");
      glm::vec3& value = values.emplace_back();
      for (int c = 0; c < 3; ++c)
        value[c] = static_cast<float>(numberOf((*place)[static_cast<std::size_t>(c)], key, -1e6, 1e6));
    }
    return values;
  }

  // [key]; null where it is absent.
  const toml::table* table(std::string_view key) const {
    const toml::node* node = m_table.get(key);
    if (node && !node->is_table()) throw errorAt(key, fmt::format("not a table: write [scene.{}]", key));
    return node ? node->as_table() : nullptr;
  }

  // An array of tables ([[key]]); empty where it is absent.
  std::vector<const toml::table*> tables(std::string_view key) const {
    const toml::node* node = m_table.get(key);
    if (!node) return {};
    const toml::array* list = node->as_array();
    if (!list) throw errorAt(key, fmt::format("not a list of tables: write [[{}]]", key));
    std::vector<const toml::table*> values;
    for (const toml::node& entry : *list) {
      if (!entry.is_table()) throw errorAt(entry, std::string(key), fmt::format("not a table: write [[{}]]", key));
      values.push_back(entry.as_table());
    }
    return values;
  }

private:
  double numberOf(const toml::node& node, std::string_view key, double least, double most) const {
    if (!node.is_number()) throw errorAt(node, std::string(key), "not a number");
    const double value = node.value_or(0.0);
    if (!(value >= least && value <= most)) // NaN too
      throw errorAt(node, std::string(key), fmt::format("{} is not from {} to {}", value, least, most));
    return value;
  }

  const std::string& m_label;
  const toml::table& m_table;
};

std::string resolve(const std::filesystem::path& folder, const std::string& file) {
  return file.starts_with(kBuiltin) ? file : (folder / file).lexically_normal().string();
}

std::string defaultName(const std::string& file) {
  if (file.starts_with(kBuiltin)) return file.substr(kBuiltin.size());
  return cleanName(std::filesystem::path(file).stem().string());
}

ViewRequest readView(const std::string& label, const toml::table& table, std::size_t number) {
  const TableReader reader(label, table, "a view", kViewKeys);
  ViewRequest view;
  view.camera = reader.text("camera").value_or("");
  if (const auto orbit = reader.numbers<3>("orbit")) {
    if ((*orbit)[1] < 0 || (*orbit)[1] > 180 || (*orbit)[2] < 0)
      throw reader.errorAt("orbit", "[theta, phi, radius]: phi is from 0 to 180, radius at least 0");
    view.orbit = glm::vec3((*orbit)[0], (*orbit)[1], (*orbit)[2]);
  }
  if (const auto target = reader.numbers<3>("target"))
    view.target = glm::vec3((*target)[0], (*target)[1], (*target)[2]);
  const bool isNamed = !view.camera.empty() && view.camera != "auto";
  if (isNamed && (view.orbit || view.target))
    throw reader.errorAt("camera", "given together with an orbit or a target");
  view.fovYDeg = reader.number("fov", 1, 170).value_or(view.fovYDeg);
  view.name = cleanName(reader.text("name").value_or(isNamed      ? view.camera
                                                     : view.orbit ? fmt::format("view {}", number)
                                                                  : std::string("auto")));
  return view;
}

Fog readFog(const std::string& label, const toml::table& table) {
  const TableReader reader(label, table, "a fog", kFogKeys);
  Fog fog;
  const auto density = reader.number("density", 0, kMaxFogDensity);
  if (!density) throw reader.errorAt("density", "is missing: the extinction in 1/m");
  fog.density = *density;
  fog.heightFalloff = reader.number("height_falloff", 0, kMaxFogFalloff).value_or(fog.heightFalloff);
  fog.height = reader.number("height", -kMaxFogLength, kMaxFogLength).value_or(fog.height);
  fog.color = reader.color("color", kMaxFogRadiance).value_or(fog.color);
  fog.startDistance = reader.number("start_distance", 0, kMaxFogLength).value_or(fog.startDistance);
  fog.maxOpacity = reader.number("max_opacity", 0, 1).value_or(fog.maxOpacity);
  return fog;
}

LightScales readLightScales(const TableReader& reader) {
  LightScales scales;
  scales.skyLightColor = reader.color("sky_light_color", kMaxLightScale).value_or(scales.skyLightColor);
  scales.indirectColorScale =
      reader.color("indirect_lighting_color_scale", kMaxLightScale).value_or(scales.indirectColorScale);
  scales.directionalSpecularScale =
      reader.number("directional_specular_scale", 0, kMaxLightScale).value_or(scales.directionalSpecularScale);
  return scales;
}

Falloff readFalloff(const TableReader& reader) {
  const std::string name = reader.text("falloff").value_or(falloffNames().front());
  const auto found = std::find(falloffNames().begin(), falloffNames().end(), name);
  if (found == falloffNames().end()) {
    const std::vector<std::string_view> known(falloffNames().begin(), falloffNames().end());
    throw reader.errorAt("falloff",
                         fmt::format("'{}' is unknown; {}", cleanName(name), base::describeNearest(name, known)));
  }
  return static_cast<Falloff>(found - falloffNames().begin());
}

// What of the file is compared.
void readLoading(const TableReader& reader, SuiteEntry& entry) {
  entry.load.timeSeconds = reader.real("time", -kMaxPoseSeconds, kMaxPoseSeconds).value_or(0.0);
  entry.load.animation = reader.text("animation").value_or("");
  entry.load.scene = reader.text("scene").value_or("");
  entry.load.variant = reader.text("variant").value_or("");
  const std::string subject = reader.text("subject").value_or("scene");
  if (subject != "scene" && subject != "ball")
    throw reader.errorAt("subject", fmt::format("'{}' is neither 'scene' nor 'ball'", cleanName(subject)));
  if (subject == "ball") entry.subject = Subject::ball;
}

SuiteEntry readEntry(const std::string& label, const std::filesystem::path& folder, const toml::table& table) {
  const TableReader reader(label, table, "a scene", kSceneKeys);
  SuiteEntry entry;
  const auto file = reader.text("file");
  if (!file) throw reader.errorAt("file", "is missing: a scene needs a file or \"builtin:NAME\"");
  entry.scene = resolve(folder, *file);
  entry.name = cleanName(reader.text("name").value_or(defaultName(*file)));
  readLoading(reader, entry);
  if (const auto environment = reader.text("environment")) entry.environment = resolve(folder, *environment);
  entry.environmentRotationDeg = reader.number("environment_rotation", -3600, 3600).value_or(0.f);
  entry.extractSun = reader.truth("sun_extraction").value_or(true);
  if (const auto sun = reader.numbers<3>("sun")) {
    if (std::abs((*sun)[1]) > 90 || (*sun)[2] < 0)
      throw reader.errorAt("sun", "[azimuth, elevation, lux]: elevation is from -90 to 90, lux at least 0");
    entry.sun = SunRequest{(*sun)[0], (*sun)[1], (*sun)[2]};
  }
  entry.lightScales = readLightScales(reader);
  entry.falloff = readFalloff(reader);
  if (const toml::table* fog = reader.table("fog")) entry.fog = readFog(label, *fog);
  if (const auto baked = reader.text("baked")) entry.baked = resolve(folder, *baked);
  entry.captures = reader.points("captures", kMaxCapturePlaces);
  entry.shadows = reader.truth("shadows");
  entry.interreflection = reader.whole("interreflection", 0, kMaxInterreflection);
  entry.fullyRough = reader.texts("fully_rough");
  if (const auto budgets = reader.text("budgets")) entry.budgets = resolve(folder, *budgets);
  entry.exposureEv = reader.number("exposure", -32, 32);
  std::set<std::string> names;
  for (const toml::table* view : reader.tables("view")) {
    entry.views.push_back(readView(label, *view, entry.views.size() + 1));
    if (!names.insert(entry.views.back().name).second)
      throw reader.errorAt(*view, "view",
                           fmt::format("a second view named '{}' in scene '{}'", entry.views.back().name, entry.name));
  }
  if (entry.views.empty()) entry.views.emplace_back();
  return entry;
}

} // namespace

Suite loadSuite(const std::filesystem::path& file) {
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
  const TableReader reader(label, root, "a suite", kSuiteKeys);
  Suite suite;
  const std::filesystem::path folder = file.parent_path();
  suite.name = cleanName(reader.text("name").value_or(file.stem().string()));
  if (const auto budgets = reader.text("budgets")) suite.budgets = resolve(folder, *budgets);
  std::set<std::string> names;
  for (const toml::table* table : reader.tables("scene")) {
    suite.entries.push_back(readEntry(label, folder, *table));
    if (!names.insert(suite.entries.back().name).second)
      throw reader.errorAt(
          *table, "scene",
          fmt::format("a second scene named '{}': give it a name of its own", suite.entries.back().name));
  }
  if (suite.entries.empty()) throw base::fileError(label, "", "the suite lists no scene: write [[scene]]");
  return suite;
}

} // namespace parity::scenes
