// report.json (compare/report.schema.json) and run.json.
#include "compare/json_writer.h"
#include "compare/report.h"

namespace parity::compare {
namespace {

// Version of compare/report.schema.json: raised when a reader of the old form could misread the new one.
constexpr int kSchemaVersion = 1;

void writeTexts(JsonWriter& json, const std::vector<std::string>& texts) {
  json.beginArray();
  for (const std::string& text : texts) json.text(text);
  json.endArray();
}

void writeFigures(JsonWriter& json, const Figures& figures) {
  if (figures.pixels == 0) return json.null(); // a zero there would read as "alike"
  json.beginObject();
  json.key("pixels").integer(figures.pixels);
  json.key("nonFinite").integer(figures.nonFinite);
  json.key("flip").beginObject();
  json.key("mean").number(figures.flip.mean);
  json.key("p50").number(figures.flip.p50);
  json.key("p95").number(figures.flip.p95);
  json.key("max").number(figures.flip.max);
  json.endObject();
  json.key("rmse").number(figures.rmse);
  json.key("psnr").number(figures.psnr);
  json.key("referenceLuma").number(figures.referenceLuma);
  json.key("testLuma").number(figures.testLuma);
  json.endObject();
}

void writeRegions(JsonWriter& json, const RegionFigures& regions) {
  json.beginObject();
  json.key("interior");
  writeFigures(json, regions.interior);
  json.key("all");
  writeFigures(json, regions.all);
  json.endObject();
}

void writeLimit(JsonWriter& json, const std::optional<double>& limit) {
  if (limit)
    json.number(*limit);
  else
    json.null();
}

void writeChecks(JsonWriter& json, const std::vector<CheckResult>& checks) {
  json.beginArray();
  for (const CheckResult& check : checks) {
    json.beginObject();
    json.key("metric").text(check.metric);
    json.key("region").text(check.region);
    json.key("value").number(check.value);
    json.key("warn");
    writeLimit(json, check.warnAbove);
    json.key("fail");
    writeLimit(json, check.failAbove);
    json.key("verdict").text(nameOf(check.verdict));
    json.key("note").text(check.note);
    json.endObject();
  }
  json.endArray();
}

void writeImages(JsonWriter& json, const ImageSet& images) {
  json.beginObject();
  json.key("reference").text(images.reference);
  json.key("test").text(images.test);
  json.key("flip").text(images.flip);
  json.endObject();
}

void writeMaterial(JsonWriter& json, const MaterialResult& material) {
  json.beginObject();
  json.key("name").text(material.name);
  json.key("verdict").text(nameOf(material.verdict));
  json.key("reason").text(material.reason);
  json.key("seenElsewhere").boolean(material.seenElsewhere);
  json.key("figures");
  writeRegions(json, material.figures);
  json.key("checks");
  writeChecks(json, material.checks);
  json.key("budget").beginObject();
  json.key("rule").text(material.budget);
  json.key("reason").text(material.budgetReason);
  json.key("owner").text(material.owner);
  json.key("requireSeen").boolean(material.requireSeen);
  json.endObject();
  json.key("notes");
  writeTexts(json, material.notes);
  json.key("terms").beginArray();
  for (const TermFigures& term : material.terms) {
    json.beginObject();
    json.key("term").text(term.term);
    json.key("reference").number(term.reference);
    json.key("test").number(term.test);
    json.endObject();
  }
  json.endArray();
  json.key("crops");
  writeImages(json, material.crops);
  json.endObject();
}

void writeView(JsonWriter& json, const ViewResult& view) {
  json.beginObject();
  json.key("name").text(view.name);
  json.key("width").integer(view.width);
  json.key("height").integer(view.height);
  json.key("verdict").text(nameOf(view.verdict));
  json.key("whole").beginObject();
  json.key("verdict").text(nameOf(view.wholeVerdict));
  json.key("reason").text(view.reason);
  json.key("figures");
  writeRegions(json, view.whole);
  json.key("checks");
  writeChecks(json, view.checks);
  json.endObject();
  json.key("materials").beginArray();
  for (const MaterialResult& material : view.materials) writeMaterial(json, material);
  json.endArray();
  json.key("images");
  writeImages(json, view.images);
  json.key("skipped");
  writeTexts(json, view.skipped);
  json.endObject();
}

void writeScene(JsonWriter& json, const SceneResult& scene) {
  json.beginObject();
  json.key("name").text(scene.name);
  json.key("source").text(scene.source);
  json.key("environment").text(scene.environment);
  json.key("sun").text(scene.sun);
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
  json.endObject();
}

} // namespace

std::string toJson(const Report& report) {
  const VerdictCounts counts = countVerdicts(report);
  JsonWriter json;
  json.beginObject();
  json.key("schema").integer(kSchemaVersion);
  json.key("tool").text(report.tool);
  json.key("version").text(report.version);
  json.key("device").text(report.device);
  json.key("verdict").text(nameOf(report.verdict));
  json.key("counts").beginObject();
  json.key("pass").integer(counts.pass);
  json.key("notSeen").integer(counts.notSeen);
  json.key("warn").integer(counts.warn);
  json.key("fail").integer(counts.fail);
  json.key("error").integer(counts.error);
  json.endObject();
  json.key("settings").beginArray();
  for (const auto& [name, value] : report.settings) {
    json.beginObject();
    json.key("name").text(name);
    json.key("value").text(value);
    json.endObject();
  }
  json.endArray();
  json.key("scenes").beginArray();
  for (const SceneResult& scene : report.scenes) writeScene(json, scene);
  json.endArray();
  json.endObject();
  return json.finish();
}

std::string toJson(const RunInfo& run) {
  JsonWriter json;
  json.beginObject();
  json.key("schema").integer(kSchemaVersion);
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
  json.endObject();
  return json.finish();
}

} // namespace parity::compare
