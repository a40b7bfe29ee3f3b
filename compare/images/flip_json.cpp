// The result of parity flip as JSON and as CSV.
#include <algorithm>

#include <fmt/format.h>

#include "base/text/json_writer.h"
#include "base/text/shown_text.h"
#include "base/version.h"
#include "compare/images/flip_text.h"

namespace parity::compare {

namespace {

void addFigures(base::JsonWriter& json, const char* key, const Figures& figures) {
  json.key(key);
  if (figures.pixels == 0) return json.null();
  json.beginObject();
  json.key("pixels").integer(figures.pixels);
  json.key("nonFinite").integer(figures.nonFinite);
  json.key("metrics").beginObject();
  for (const Figure& figure : figures.values) json.key(figure.name).number(figure.value);
  json.endObject();
  json.key("referenceLuma").number(figures.referenceLuma);
  json.key("testLuma").number(figures.testLuma);
  json.endObject();
}

void addLimit(base::JsonWriter& json, const char* key, const std::optional<double>& limit) {
  json.key(key);
  if (limit)
    json.number(*limit);
  else
    json.null();
}

void addRow(base::JsonWriter& json, const FlipResult& result, const FlipRow& row) {
  json.beginObject();
  json.key("name").text(row.name);
  json.key("verdict").text(nameOf(result, row.verdict));
  json.key("reason").text(row.reason);
  addFigures(json, "figures", row.figures);
  json.key("checks").beginArray();
  for (const CheckResult& check : row.checks) {
    json.beginObject();
    json.key("metric").text(check.metric);
    json.key("value").number(check.value);
    addLimit(json, "warn", check.warnAbove);
    addLimit(json, "fail", check.failAbove);
    json.key("verdict").text(nameOf(check.verdict));
    json.key("regress").boolean(check.regress);
    json.key("unjudged").text(check.unjudged);
    json.key("note").text(check.note);
    json.endObject();
  }
  json.endArray();
  json.endObject();
}

void addPooling(base::JsonWriter& json, const std::optional<Pooling>& pooling) {
  json.key("pooling");
  if (!pooling) return json.null();
  json.beginObject();
  json.key("mean").number(pooling->mean);
  json.key("weightedMedian").number(pooling->weightedMedian);
  json.key("weightedQ1").number(pooling->weightedQ1);
  json.key("weightedQ3").number(pooling->weightedQ3);
  json.key("min").number(pooling->min);
  json.key("max").number(pooling->max);
  json.key("histogram").beginArray();
  for (const std::uint64_t count : pooling->histogram) json.integer(count);
  json.endArray();
  json.endObject();
}

void addTexts(base::JsonWriter& json, const char* key, const std::vector<std::string>& texts) {
  json.key(key).beginArray();
  for (const std::string& text : texts) json.text(text);
  json.endArray();
}

void addPair(base::JsonWriter& json, const FlipResult& result, const FlipPair& pair, bool warnExit) {
  json.beginObject();
  json.key("name").text(pair.files.name);
  json.key("reference").text(pair.files.reference.generic_string());
  json.key("test").text(pair.files.test.generic_string());
  if (pair.width > 0) {
    json.key("width").integer(pair.width);
    json.key("height").integer(pair.height);
    json.key("channels").text(pair.channels);
    json.key("range").text(pair.hdr ? "hdr" : "ldr");
    json.key("rangeReason").text(pair.rangeReason);
    json.key("referenceSpace").text(pair.referenceSpace);
    json.key("testSpace").text(pair.testSpace);
    json.key("identical").boolean(pair.identical && !pair.partial);
    json.key("area").text(pair.where);
  }
  addTexts(json, "notes", pair.notes);
  json.key("verdict").text(nameOf(result, pair.verdict));
  json.key("exitCode").integer(exitCode(pair, warnExit));
  json.key("reason").text(pair.reason);
  std::vector<std::string> files;
  for (const auto& file : pair.written) files.push_back(file.generic_string());
  addTexts(json, "files", files);
  addPooling(json, pair.pooling);
  json.key("regions").beginArray();
  for (const FlipRow& row : pair.rows) addRow(json, result, row);
  json.endArray();
  json.endObject();
}

// The figures that any row has, in the order of the first that has them.
std::vector<std::string> figureNames(const FlipResult& result) {
  std::vector<std::string> names;
  for (const FlipPair& pair : result.pairs)
    for (const FlipRow& row : pair.rows)
      for (const Figure& figure : row.figures.values)
        if (std::find(names.begin(), names.end(), figure.name) == names.end()) names.push_back(figure.name);
  return names;
}

} // namespace

std::string nameOf(const FlipResult& result, Verdict verdict) {
  return verdict == Verdict::pass && !result.judged ? "not judged" : nameOf(verdict);
}

std::string toJson(const FlipResult& result, bool warnExit) {
  base::JsonWriter json;
  json.beginObject();
  json.key("tool").text("parity");
  json.key("version").text(base::kVersion);
  json.key("format").integer(1);
  json.key("verdict").text(nameOf(result, worstVerdict(result)));
  json.key("exitCode").integer(exitCode(result, warnExit));
  addTexts(json, "warnings", result.warnings);
  addTexts(json, "skippedFiles", result.skipped);
  json.key("pairs").beginArray();
  for (const FlipPair& pair : result.pairs) addPair(json, result, pair, warnExit);
  json.endArray();
  json.endObject();
  return json.finish();
}

std::string toCsv(const FlipResult& result, bool warnExit) {
  const std::vector<std::string> names = figureNames(result);
  std::string out = "pair,reference,test,region,range,verdict,exit_code,pixels,non_finite";
  for (const std::string& name : names) out += ',' + base::csvCell(name);
  out += ",reason\r\n";
  for (const FlipPair& pair : result.pairs) {
    const std::string head =
        fmt::format("{},{},{}", base::csvCell(pair.files.name), base::csvCell(pair.files.reference.generic_string()),
                    base::csvCell(pair.files.test.generic_string()));
    const int code = exitCode(pair, warnExit);
    if (pair.rows.empty())
      out += fmt::format("{},,,{},{},,{},{}\r\n", head, nameOf(result, pair.verdict), code,
                         std::string(names.size(), ','), base::csvCell(pair.reason));
    for (const FlipRow& row : pair.rows) {
      const Figures& all = row.figures;
      out += fmt::format("{},{},{},{},{},{},{}", head, base::csvCell(row.name), pair.hdr ? "hdr" : "ldr",
                         nameOf(result, row.verdict), code, all.pixels, all.nonFinite);
      for (const std::string& name : names) {
        const auto value = all.find(name);
        out += value ? fmt::format(",{}", *value) : ",";
      }
      out += ',' + base::csvCell(row.reason) + "\r\n";
    }
  }
  return out;
}

} // namespace parity::compare
