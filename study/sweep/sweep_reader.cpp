// An earlier sweep's JSON, read back.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "base/text/error_words.h"
#include "study/sweep/sweep_json.h"

namespace parity::sweep {

namespace {

using Json = nlohmann::json;
using nlohmann::literals::operator""_json_pointer;

std::vector<double> readRounds(const Json& json, const char* key) {
  return json.at(key).at("rounds").get<std::vector<double>>();
}

// Null stands for what is not finite.
double readNumber(const Json& json, const std::string& key) {
  const Json& value = json.at(key);
  return value.is_null() ? std::nan("") : value.get<double>();
}

Errors readErrors(const Json& json) {
  return {readNumber(json, "flip.mean"), readNumber(json, "flip.p95"), readNumber(json, "relmse"),
          json.at("nonFinite").get<std::uint64_t>()};
}

RegionErrors readRegion(const Json& json, const std::string& firstPath) {
  RegionErrors region;
  region.name = json.value("name", "");
  region.pixels = json.at("pixels").get<std::uint64_t>();
  if (json.contains("truth")) region.truth = readErrors(json.at("truth"));
  region.first = readErrors(json.at(firstPath));
  return region;
}

VariantResult readVariant(const std::filesystem::path& file, const Json& json, const std::string& firstPath) {
  VariantResult v;
  v.path = json.at("path").get<std::string>();
  v.name = json.at("name").get<std::string>();
  v.knob = json.at("knob").get<std::string>();
  const auto stage = std::ranges::find(stageKinds(), json.at("stage").get<std::string>());
  if (stage == stageKinds().end()) throw base::fileError(file, "stage", "unknown stage");
  v.stage = static_cast<Stage>(stage - stageKinds().begin());
  for (const auto& [knob, value] : json.at("knobs").items()) v.knobs.emplace_back(knob, value.get<std::string>());
  if (v.stage == Stage::shading) {
    const Json& times = json.at("timeMs");
    v.times = {readRounds(times, "device"), readRounds(times, "wall"), readRounds(times, "cpu"),
               readNumber(times, "compile")};
  } else if (v.stage == Stage::preparation) {
    v.prepareMs = readRounds(json, "prepareMs");
  }
  const Json& cost = json.at("cost");
  v.cost = {readNumber(cost, "operations"), readNumber(cost, "fetches"), cost.at("samplers").get<std::uint64_t>()};
  v.whole = readRegion(json.at("error"), firstPath);
  for (const Json& region : json.at("materials")) v.materials.push_back(readRegion(region, firstPath));
  return v;
}

SceneSweep readScene(const std::filesystem::path& file, const Json& json) {
  SceneSweep scene;
  scene.scene = json.at("scene").get<std::string>();
  scene.failure = json.value("failure", "");
  if (!scene.failure.empty()) return scene;
  scene.environment = json.at("environment").get<std::string>();
  scene.sun = json.at("sun").get<std::string>();
  scene.width = json.at("width").get<int>();
  scene.height = json.at("height").get<int>();
  scene.pixels = json.at("pixels").get<std::uint64_t>();
  scene.truthError = readNumber(json, "truthError");
  scene.skipped = json.at("skipped").get<std::vector<std::string>>();
  for (const Json& variants = json.at("variants"); const Json& variant : variants)
    scene.variants.push_back(readVariant(file, variant, variants.front().at("path").get<std::string>()));
  return scene;
}

} // namespace

SweepReport readSweep(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
  try {
    const Json json = Json::parse(base::readText(file, kMaxBytes));
    if (json.at("tool") != "parity bench" || json.at("schema") != kSweepSchema)
      throw base::fileError(file, "schema", "is not a sweep of parity bench that this version can read");
    SweepReport report;
    report.version = json.at("version").get<std::string>();
    report.commandLine = json.at("commandLine").get<std::string>();
    report.startedAt = json.at("startedAt").get<std::string>();
    const Json& machine = json.at("machine");
    report.machine = {machine.at("processor").get<std::string>(), machine.at("device").get<std::string>(),
                      machine.at("driver").get<std::string>(),    machine.at("deviceKind").get<std::string>(),
                      machine.at("simd").get<std::string>(),      machine.at("threads").get<int>()};
    report.rounds = json.at("rounds").get<int>();
    report.figure = json.value("/conclusions/figure"_json_pointer, report.figure);
    if (std::ranges::find(errorNames(), report.figure) == errorNames().end())
      throw base::fileError(file, "figure", "unknown figure");
    for (const Json& scene : json.at("scenes")) report.scenes.push_back(readScene(file, scene));
    return report;
  } catch (const Json::exception& error) {
    throw base::fileError(file, "JSON", base::wordsOf(error));
  }
}

} // namespace parity::sweep
