// stress.json. Without times: the same run gives the same text.
#include <algorithm>
#include <cmath>

#include "study/stress/stress_run.h"

namespace parity::stress {

namespace {

using base::JsonWriter;

void writeFindings(JsonWriter& json, const std::vector<Finding>& findings) {
  json.key("findings").beginArray();
  for (const Finding& finding : findings) {
    json.beginObject();
    json.key("subject").text(finding.subject);
    json.key("place").text(finding.place);
    json.key("fault").text(finding.fault);
    json.key("expected").boolean(finding.expected);
    json.key("count").integer(finding.count);
    json.key("example").text(finding.example);
    json.key("reproduce").text(finding.reproduce);
    json.key("region").text(finding.region);
    json.key("reason").text(finding.reason);
    json.endObject();
  }
  json.endArray();
}

void writeExample(JsonWriter& json, const char* key, const FunctionCase& function,
                  const std::optional<Example>& example) {
  json.key(key);
  if (!example) return json.null();
  json.beginObject();
  json.key("value").number(example->value); // null: infinite
  json.key("output").integer(example->output);
  json.key("at").text(formatAt(function, example->row));
  if (example->second) json.key("to").text(formatAt(function, *example->second));
  json.endObject();
}

void writeColumn(JsonWriter& json, const FunctionCase& function, const Column& column) {
  json.beginObject();
  json.key("side").text(column.onDevice ? "device" : "cpu");
  json.key("precision").text(nameOf(column.precision));
  json.key("skipped");
  if (!column.skipped.empty()) {
    json.text(column.skipped);
    json.endObject();
    return;
  }
  json.null();
  const Tally& tally = column.tally;
  json.key("rows").integer(tally.inside);
  json.key("outside").integer(tally.outside);
  json.key("outsideNotFinite").integer(tally.outsideNotFinite);
  json.key("pairs").integer(tally.pairs);
  json.key("maxError").number(tally.worstError ? tally.worstError->value : 0);
  json.key("p999Error").number(tally.errors.percentile(0.999));
  json.key("errorsOmitted").integer(tally.errorsOmitted);
  writeExample(json, "worstError", function, tally.worstError);
  if (column.onDevice) {
    json.key("maxUlps").number(tally.greatestUlps);
    writeExample(json, "worstUlps", function, tally.worstUlps);
  }
  json.key("faults").beginObject();
  for (std::size_t f = 0; f < kFaultCount; ++f) {
    const FaultCount& count = tally.faults[f];
    json.key(nameOf(static_cast<Fault>(f))).beginObject();
    json.key("rows").integer(count.rows);
    json.key("unexpected").integer(count.unexpected);
    writeExample(json, "worst", function, count.worst);
    json.endObject();
  }
  json.endObject();
  if (!tally.map.empty()) { // the greatest error; null: no row
    json.key("map").beginArray();
    for (const double error : tally.map) json.number(error < 0 ? NAN : error);
    json.endArray();
  }
  json.endObject();
}

std::string inputAt(const Domain& domain, int at) {
  const auto input = std::ranges::find(domain.inputs, at, &Input::at);
  return input == domain.inputs.end() ? "" : input->name;
}

void writeFunction(JsonWriter& json, const FunctionResult& result) {
  json.beginObject();
  json.key("name").text(result.function.name);
  json.key("points").integer(result.points);
  json.key("devicePoints").integer(result.devicePoints);
  json.key("inputs").beginArray();
  for (const Input& input : result.function.domain.inputs) {
    json.beginObject();
    json.key("name").text(input.name);
    json.key("low").text(formatExactly(input.low)); // text: JSON has no infinity
    json.key("high").text(formatExactly(input.high));
    json.endObject();
  }
  json.endArray();
  if (result.function.map.roughness >= 0) { // whose names its rows and columns have
    json.key("mapAxes").beginObject();
    json.key("roughness").text(inputAt(result.function.domain, result.function.map.roughness));
    json.key("cosine").text(inputAt(result.function.domain, result.function.map.cosine));
    json.endObject();
  }
  json.key("columns").beginArray();
  for (const Column& column : result.columns) writeColumn(json, result.function, column);
  json.endArray();
  json.endObject();
}

} // namespace

std::string formatJson(const Report& report, base::JsonLayout layout) {
  JsonWriter json(layout);
  json.beginObject();
  json.key("version").text(report.version);
  json.key("device").text(report.deviceName);
  json.key("failure");
  if (report.failure.empty())
    json.null();
  else
    json.text(report.failure);
  json.key("fp16Skipped");
  if (report.halfSkipped.empty())
    json.null();
  else
    json.text(report.halfSkipped);
  json.key("seed").integer(report.seed);
  json.key("points").integer(report.points);
  json.key("devicePoints").integer(report.devicePoints);
  json.key("unexpected").integer(report.unexpected());
  json.key("expected").integer(report.findings.size() - report.unexpected());
  writeFindings(json, report.findings);
  json.key("functions").beginArray();
  for (const FunctionResult& result : report.functions) writeFunction(json, result);
  json.endArray();
  json.key("scenes").beginArray();
  for (const SceneResult& scene : report.scenes) {
    json.beginObject();
    json.key("name").text(scene.name);
    json.key("wants").text(scene.wants);
    json.key("paths").beginArray();
    for (const std::string& path : scene.paths) json.text(path);
    json.endArray();
    json.endObject();
  }
  json.endArray();
  json.endObject();
  return json.finish();
}

} // namespace parity::stress
