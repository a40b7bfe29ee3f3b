// report.json (compare/report.schema.json) and run.json.
#include <set>

#include "compare/json_figures.h"
#include "compare/json_material.h"
#include "compare/json_writer.h"
#include "compare/report.h"
#include "compare/statistic.h"

namespace parity::compare {
namespace {

void writeConditions(JsonWriter& json, const std::vector<Condition>& conditions) {
  json.beginArray();
  for (const Condition& condition : conditions) {
    json.beginObject();
    json.key("name").text(condition.name);
    json.key("value").text(condition.value);
    json.key("actsOn").text(nameOf(condition.actsOn));
    if (!condition.words.empty()) json.key("words").text(condition.words);
    json.endObject();
  }
  json.endArray();
}

void writeView(JsonWriter& json, const ViewResult& view) {
  json.beginObject();
  json.key("name").text(view.name);
  json.key("width").integer(view.width);
  json.key("height").integer(view.height);
  json.key("conditions");
  writeConditions(json, view.conditions);
  json.key("verdict").text(nameOf(view.verdict));
  json.key("whole").beginObject();
  json.key("verdict").text(nameOf(view.wholeVerdict));
  json.key("reason").text(view.reason);
  json.key("bias").text(describeBiasOf(view.whole));
  json.key("figures");
  writeFigures(json, view.whole);
  json.key("checks");
  writeChecks(json, view.checks);
  json.key("budget");
  writeRule(json, view.rule);
  json.key("baseline");
  writeBaseline(json, view.baseline);
  if (view.truth) {
    json.key("truth");
    writeTruth(json, *view.truth);
  }
  if (view.encoding) {
    json.key("encoding");
    writeEncoding(json, *view.encoding);
  }
  if (view.textures) {
    json.key("textures");
    writeTextures(json, *view.textures);
  }
  json.endObject();
  json.key("materials").beginArray();
  for (const MaterialResult& material : view.materials) writeMaterial(json, material);
  json.endArray();
  json.key("images");
  writeImages(json, view.images);
  json.key("exposureEv").number(view.exposureEv);
  json.key("pixels").beginObject();
  json.key("color").text(view.pixels.color);
  json.key("terms").text(view.pixels.terms);
  json.endObject();
  if (view.droppedLights) {
    json.key("droppedLights");
    writeDroppedLights(json, *view.droppedLights);
  }
  json.endObject();
}

void writePermutation(JsonWriter& json, const PermutationResult& permutation) {
  json.beginObject();
  json.key("path").text(permutation.path);
  json.key("textures").text(permutation.textures);
  json.key("features").text(permutation.features);
  json.key("pixels").integer(permutation.pixels);
  json.key("samplers").integer(permutation.samplers);
  if (permutation.cost) {
    json.key("cost").beginObject();
    json.key("fp32").integer(permutation.cost->fp32);
    json.key("fp16").integer(permutation.cost->fp16);
    json.key("integer").integer(permutation.cost->integer);
    json.key("fetches").integer(permutation.cost->fetches);
    json.key("openLoops").integer(permutation.cost->openLoops);
    json.endObject();
  }
  json.endObject();
}

void writePass(JsonWriter& json, const PassResult& pass) {
  json.beginObject();
  json.key("name").text(pass.name);
  json.key("count").integer(pass.count);
  json.key("unit").text(pass.unit);
  json.key("skipped");
  if (pass.skipped.empty())
    json.null();
  else
    json.text(pass.skipped);
  json.endObject();
}

void writeScene(JsonWriter& json, const SceneResult& scene) {
  json.beginObject();
  json.key("name").text(scene.name);
  json.key("source").text(scene.source);
  json.key("environment").text(scene.environment);
  json.key("sun").text(scene.sun);
  if (!scene.light.empty()) json.key("light").text(scene.light);
  json.key("conditions");
  writeConditions(json, scene.conditions);
  json.key("verdict").text(nameOf(scene.verdict));
  json.key("error");
  if (scene.error.empty()) {
    json.null();
  } else {
    json.beginObject();
    json.key("message").text(scene.error);
    json.key("exitCode").integer(scene.errorExitCode);
    json.endObject();
  }
  json.key("warnings");
  writeTexts(json, scene.warnings);
  json.key("views").beginArray();
  for (const ViewResult& view : scene.views) writeView(json, view);
  json.endArray();
  json.key("passes").beginArray();
  for (const PassResult& pass : scene.passes) writePass(json, pass);
  json.endArray();
  json.key("permutations").beginArray();
  for (const PermutationResult& permutation : scene.permutations) writePermutation(json, permutation);
  json.endArray();
  json.endObject();
}

void writeCounts(JsonWriter& json, const VerdictCounts& counts) {
  json.beginObject();
  json.key("pass").integer(counts.pass);
  json.key("notSeen").integer(counts.notSeen);
  json.key("tooSmall").integer(counts.tooSmall);
  json.key("notJudged").integer(counts.notJudged);
  json.key("warn").integer(counts.warn);
  json.key("fail").integer(counts.fail);
  json.key("error").integer(counts.error);
  json.endObject();
}

void writeSummary(JsonWriter& json, const std::optional<BaselineSummary>& baseline) {
  if (!baseline) return json.null();
  json.beginObject();
  json.key("source").text(baseline->source);
  json.key("version").text(baseline->version);
  json.key("device").text(baseline->device);
  json.key("common").integer(baseline->common);
  json.key("notComparable").integer(baseline->notComparable);
  json.key("gone").beginArray();
  for (const GoneRow& row : baseline->gone) {
    json.beginObject();
    json.key("scene").text(row.scene);
    json.key("view").text(row.view);
    json.key("material").text(row.material);
    json.endObject();
  }
  json.endArray();
  json.key("error").text(baseline->error);
  json.endObject();
}

// Every figure that the report has or judges, by name.
std::set<std::string> figureNames(const Report& report) {
  std::set<std::string> names;
  const auto add = [&](const Figures& figures, const std::vector<CheckResult>& checks) {
    for (const Figure& figure : figures.values) names.insert(figure.name);
    for (const CheckResult& check : checks) names.insert(check.metric);
  };
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) {
      add(view.whole, view.checks);
      for (const MaterialResult& material : view.materials) add(material.figures, material.checks);
    }
  return names;
}

// How to read and to write each of them.
void writeStatistics(JsonWriter& json, const std::set<std::string>& names) {
  json.beginObject();
  for (const std::string& name : names)
    if (const std::optional<Statistic> statistic = statisticByName(name)) {
      json.key(name).beginObject();
      json.key("label").text(statistic->label);
      json.key("unit").text(isShare(name) ? "%" : statistic->unit);
      json.key("digits").integer(isShare(name) ? 1 : statistic->digits);
      json.key("better").text(statistic->better == Better::lower    ? "lower"
                              : statistic->better == Better::higher ? "higher"
                                                                    : "near zero");
      json.endObject();
    }
  json.endObject();
}

} // namespace

std::string toJson(const Report& report, JsonLayout layout) {
  JsonWriter json(layout);
  json.beginObject();
  json.key("schema").integer(kReportSchema);
  json.key("tool").text(report.tool);
  json.key("version").text(report.version);
  json.key("device").text(report.device);
  json.key("verdict").text(nameOf(report.verdict));
  json.key("headline").text(headline(report));
  json.key("counts");
  writeCounts(json, countVerdicts(report));
  json.key("wholeCounts");
  writeCounts(json, countWholes(report));
  json.key("displayTable").text(report.displayTable);
  json.key("problems").beginArray();
  for (const RunProblem& problem : problemsOf(report)) {
    json.beginObject();
    json.key("verdict").text(nameOf(problem.verdict));
    json.key("reason").text(problem.reason);
    json.endObject();
  }
  json.endArray();
  json.key("warnings");
  writeTexts(json, report.warnings);
  json.key("baseline");
  writeSummary(json, report.baseline);
  json.key("settings").beginArray();
  for (const auto& [name, value] : report.settings) {
    json.beginObject();
    json.key("name").text(name);
    json.key("value").text(value);
    json.endObject();
  }
  json.endArray();
  json.key("conditions");
  writeConditions(json, report.conditions);
  json.key("statistics");
  writeStatistics(json, figureNames(report));
  json.key("scenes").beginArray();
  for (const SceneResult& scene : report.scenes) writeScene(json, scene);
  json.endArray();
  json.endObject();
  return json.finish();
}

std::string toJson(const RunInfo& run, JsonLayout layout) {
  JsonWriter json(layout);
  json.beginObject();
  json.key("schema").integer(kReportSchema);
  json.key("startedAt").text(run.startedAt);
  json.key("commandLine").text(run.commandLine);
  json.key("timings").beginArray();
  for (const auto& [stage, timeMs] : run.timings) {
    json.beginObject();
    json.key("stage").text(stage);
    json.key("timeMs").number(timeMs);
    json.endObject();
  }
  json.endArray();
  json.key("compiledShaders").integer(run.compiledShaders);
  json.key("cachedScenes");
  writeTexts(json, run.cachedScenes);
  json.endObject();
  return json.finish();
}

} // namespace parity::compare
