#include "study/sweep/sweep_json.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text/shown_text.h"
#include "study/sweep/statistics.h"
#include "study/sweep/summary.h"

namespace parity::sweep {

namespace {

using base::JsonWriter;

void writeNumbers(JsonWriter& json, const char* key, const std::vector<double>& values) {
  json.key(key).beginArray();
  for (const double value : values) json.number(value);
  json.endArray();
}

void writeTexts(JsonWriter& json, const char* key, const std::vector<std::string>& values) {
  json.key(key).beginArray();
  for (const std::string& value : values) json.text(value);
  json.endArray();
}

// The rounds, and what they come to.
void writeSamples(JsonWriter& json, const char* key, const std::vector<double>& values) {
  const Spread spread = spreadOf(values);
  json.key(key).beginObject();
  json.key("median").number(spread.median);
  json.key("low").number(spread.low);
  json.key("high").number(spread.high);
  writeNumbers(json, "rounds", values);
  json.endObject();
}

void writeErrors(JsonWriter& json, const char* key, const Errors& errors) {
  json.key(key).beginObject();
  for (const std::string& name : errorNames()) json.key(name).number(errorOf(errors, name));
  json.key("nonFinite").integer(errors.nonFinite);
  json.endObject();
}

void writeRegion(JsonWriter& json, const RegionErrors& region, const std::string& firstPath) {
  json.beginObject();
  if (!region.name.empty()) json.key("name").text(region.name);
  json.key("pixels").integer(region.pixels);
  if (region.truth) writeErrors(json, "truth", *region.truth);
  writeErrors(json, firstPath.c_str(), region.first);
  json.endObject();
}

void writeVariant(JsonWriter& json, const VariantResult& v, bool dominated, const std::string& firstPath) {
  json.beginObject();
  json.key("path").text(v.path);
  json.key("name").text(v.name);
  json.key("knob").text(v.knob);
  json.key("stage").text(stageKinds()[static_cast<std::size_t>(v.stage)]);
  json.key("knobs").beginObject();
  for (const auto& [knob, value] : v.knobs) json.key(knob).text(value);
  json.endObject();
  if (v.stage == Stage::shading) {
    json.key("timeMs").beginObject();
    writeSamples(json, "device", v.times.deviceMs);
    writeSamples(json, "wall", v.times.wallMs);
    writeSamples(json, "cpu", v.times.cpuMs);
    json.key("compile").number(v.times.compileMs);
    json.endObject();
  } else if (v.stage == Stage::preparation) {
    writeSamples(json, "prepareMs", v.prepareMs);
  }
  json.key("cost").beginObject();
  json.key("operations").number(v.cost.operations);
  json.key("fetches").number(v.cost.fetches);
  json.key("samplers").integer(v.cost.samplers);
  json.endObject();
  json.key("dominated").boolean(dominated);
  json.key("error");
  writeRegion(json, v.whole, firstPath);
  json.key("materials").beginArray();
  for (const RegionErrors& region : v.materials) writeRegion(json, region, firstPath);
  json.endArray();
  json.endObject();
}

void writeScene(JsonWriter& json, const SceneSweep& scene, const Conclusions& conclusions) {
  json.beginObject();
  json.key("scene").text(scene.scene);
  if (!scene.failure.empty()) {
    json.key("failure").text(scene.failure);
    json.endObject();
    return;
  }
  json.key("environment").text(scene.environment);
  json.key("sun").text(scene.sun);
  json.key("width").integer(scene.width);
  json.key("height").integer(scene.height);
  json.key("pixels").integer(scene.pixels);
  json.key("truthError").number(scene.truthError);
  writeTexts(json, "skipped", scene.skipped);
  const std::vector<bool> dominated = findDominated(scene, conclusions.against, conclusions.figure);
  json.key("variants").beginArray();
  for (std::size_t i = 0; i < scene.variants.size(); ++i)
    writeVariant(json, scene.variants[i], dominated[i], conclusions.firstPath);
  json.endArray();
  json.endObject();
}

void writeRatios(JsonWriter& json, const SweepRatios& ratios) {
  json.key("compared").beginObject();
  json.key("confidence").number(ratios.confidence);
  writeTexts(json, "notes", ratios.notes);
  json.key("variants").beginArray();
  for (const VariantRatio& v : ratios.variants) {
    json.beginObject();
    json.key("scene").text(v.scene);
    json.key("id").text(v.id);
    json.key("ratio").number(v.time.ratio);
    json.key("low").number(v.time.low);
    json.key("high").number(v.time.high);
    json.key("verdict").text(v.time.isSlower() ? "slower" : v.time.isFaster() ? "faster" : "the same");
    json.key("flipBefore").number(v.flipBefore);
    json.key("flipNow").number(v.flipNow);
    json.endObject();
  }
  json.endArray();
  json.endObject();
}

void writeConclusions(JsonWriter& json, const Conclusions& c) {
  json.key("conclusions").beginObject();
  json.key("against").text(c.against == Against::truth ? "truth" : c.firstPath);
  json.key("figure").text(c.figure);
  writeTexts(json, "notes", c.notes);
  writeTexts(json, "dominatedEverywhere", c.dominated);
  if (c.budget) {
    json.key("budget").beginObject();
    json.key(c.budget->figure).number(c.budget->limit);
    json.endObject();
    json.key("cheapest").beginArray();
    for (const Conclusions::Cheapest& each : c.cheapest) {
      json.beginObject();
      json.key("scene").text(each.scene.empty() ? "all" : each.scene);
      json.key("path").text(each.path);
      json.key("setting");
      each.setting ? json.text(*each.setting) : json.null();
      json.endObject();
    }
    json.endArray();
  }
  json.key("purchases").beginArray();
  for (const Purchase& p : c.purchases) {
    json.beginObject();
    json.key("path").text(p.path);
    json.key("knob").text(p.knob);
    json.key("from").text(p.from);
    json.key("to").text(p.to);
    json.key("msPerMillionSamples").number(p.timeMs);
    json.key("error").number(p.error);
    json.key("errorPerMs").number(p.perMs);
    json.key("timeIsCertainIn").number(p.certain);
    json.endObject();
  }
  json.endArray();
  if (c.ratios) writeRatios(json, *c.ratios);
  json.endObject();
}

} // namespace

Conclusions conclude(const SweepReport& report, const std::optional<ErrorBudget>& budget) {
  Conclusions c;
  c.against = bestKnown(report);
  c.firstPath = firstPathOf(report);
  c.figure = budget ? budget->figure : report.figure;
  c.budget = budget;
  c.notes = notesOf(report);
  c.dominated = dominatedEverywhere(report, c.against, c.figure);
  c.purchases = rankPurchases(report, c.against, c.figure);
  if (!budget) return c;
  std::vector<std::string> paths; // in the order of the settings
  for (const SceneSweep& scene : report.scenes)
    for (const VariantResult& v : scene.variants)
      if (std::ranges::count(paths, v.path) == 0) paths.push_back(v.path);
  for (const std::string& path : paths) {
    for (const SceneSweep& scene : report.scenes)
      if (scene.failure.empty())
        c.cheapest.push_back({scene.scene, path, cheapestWithin(scene, path, c.against, *budget)});
    c.cheapest.push_back({"", path, cheapestWithinEverywhere(report, path, c.against, *budget)});
  }
  return c;
}

void writeMachine(base::JsonWriter& json, const Machine& machine) {
  json.key("machine").beginObject();
  json.key("processor").text(machine.processor);
  json.key("threads").integer(machine.threads);
  json.key("device").text(machine.device);
  json.key("driver").text(machine.driver);
  json.key("deviceKind").text(machine.deviceKind);
  json.key("simd").text(machine.simd);
  json.endObject();
}

std::string toJson(const SweepReport& report, const Conclusions& conclusions, base::JsonLayout layout) {
  JsonWriter json(layout);
  json.beginObject();
  json.key("tool").text("parity bench");
  json.key("schema").integer(kSweepSchema);
  json.key("version").text(report.version);
  json.key("commandLine").text(report.commandLine);
  json.key("startedAt").text(report.startedAt);
  writeMachine(json, report.machine);
  json.key("rounds").integer(report.rounds);
  json.key("scenes").beginArray();
  for (const SceneSweep& scene : report.scenes) writeScene(json, scene, conclusions);
  json.endArray();
  writeConclusions(json, conclusions);
  json.endObject();
  return json.finish();
}

std::string toCsv(const SweepReport& report) {
  std::string csv =
      fmt::format("scene,environment,sun,path,setting,stage,device_ms,device_ms_low,device_ms_high,wall_ms,cpu_ms,"
                  "compile_ms,prepare_ms,operations,fetches,samplers,region,pixels,truth_flip_mean,"
                  "truth_flip_p95,truth_relmse,{0}_flip_mean,{0}_flip_p95,{0}_relmse,"
                  "non_finite\r\n",
                  firstPathOf(report));
  for (const SceneSweep& scene : report.scenes)
    for (const VariantResult& v : scene.variants) {
      const bool shading = v.stage == Stage::shading;
      const Spread device = spreadOf(v.times.deviceMs);
      const auto number = [](bool known, double value) { return known ? fmt::format("{:.6g}", value) : std::string(); };
      const std::string head = fmt::format(
          "{},{},{},{},{},{},{},{},{},{},{},{},{},{:.6g},{:.6g},{}", base::csvCell(scene.scene),
          base::csvCell(scene.environment), base::csvCell(scene.sun), v.path, base::csvCell(v.name),
          stageKinds()[static_cast<std::size_t>(v.stage)], number(shading, device.median), number(shading, device.low),
          number(shading, device.high), number(shading, spreadOf(v.times.wallMs).median),
          number(shading, spreadOf(v.times.cpuMs).median), number(shading, v.times.compileMs),
          number(v.stage == Stage::preparation, spreadOf(v.prepareMs).median), v.cost.operations, v.cost.fetches,
          v.cost.samplers);
      const auto line = [&](const RegionErrors& r) {
        csv += fmt::format("{},{},{}", head, base::csvCell(r.name), r.pixels);
        for (const std::string& name : errorNames())
          csv += "," + (r.truth ? fmt::format("{:.6g}", errorOf(*r.truth, name)) : std::string());
        for (const std::string& name : errorNames()) csv += fmt::format(",{:.6g}", errorOf(r.first, name));
        csv += fmt::format(",{}\r\n", r.first.nonFinite);
      };
      line(v.whole);
      for (const RegionErrors& region : v.materials) line(region);
    }
  return csv;
}

} // namespace parity::sweep
