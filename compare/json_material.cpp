// What report.json says of a material, and of a whole image in the same words.
#include "compare/json_material.h"

#include "compare/json_figures.h"
#include "compare/wording.h"

namespace parity::compare {
namespace {

void writeLimit(JsonWriter& json, const std::optional<double>& limit) {
  if (limit)
    json.number(*limit);
  else
    json.null();
}

void writeChanges(JsonWriter& json, const std::vector<FigureChange>& changes) {
  json.beginObject();
  for (const FigureChange& change : changes) json.key(change.metric).number(change.change());
  json.endObject();
}

void writeAttribution(JsonWriter& json, const Attribution& attribution) {
  json.beginObject();
  json.key("flip").number(attribution.flip);
  json.key("terms").beginArray();
  for (const TermEffect& effect : attribution.terms) {
    json.beginObject();
    json.key("term").text(effect.term);
    json.key("flip").number(effect.flip);
    json.endObject();
  }
  json.endArray();
  json.endObject();
}

} // namespace

void writeChecks(JsonWriter& json, const std::vector<CheckResult>& checks) {
  json.beginArray();
  for (const CheckResult& check : checks) {
    json.beginObject();
    json.key("metric").text(check.metric);
    json.key("regress").boolean(check.regress);
    json.key("value").number(check.value);
    json.key("warn");
    writeLimit(json, check.warnAbove);
    json.key("fail");
    writeLimit(json, check.failAbove);
    json.key("verdict").text(check.judged() ? nameOf(check.verdict) : "not judged");
    json.key("note").text(check.judged() ? check.note : check.unjudged);
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

void writeRule(JsonWriter& json, const AppliedRule& rule) {
  json.beginObject();
  json.key("rule").text(rule.origin);
  json.key("preset").text(rule.preset);
  json.key("reason").text(rule.reason);
  json.key("owner").text(rule.owner);
  json.key("requireSeen").boolean(rule.requireSeen);
  json.key("minPixels").integer(rule.minPixels);
  json.endObject();
}

void writeBaseline(JsonWriter& json, const std::optional<BaselineChange>& baseline) {
  if (!baseline) return json.null();
  json.beginObject();
  json.key("new").boolean(baseline->isNew);
  json.key("verdict");
  if (baseline->isNew)
    json.null();
  else
    json.text(nameOf(baseline->before));
  json.key("notComparable").text(baseline->notComparable);
  json.key("changes");
  writeChanges(json, baseline->changes);
  json.endObject();
}

std::string describeBiasOf(const Figures& figures) {
  return figures.pixels > 0 ? describeBias(figures) : std::string();
}

void writeMaterial(JsonWriter& json, const MaterialResult& material) {
  json.beginObject();
  json.key("name").text(material.name);
  json.key("verdict").text(nameOf(material.verdict));
  json.key("reason").text(material.reason);
  json.key("seenElsewhere").boolean(material.seenElsewhere);
  json.key("bias").text(describeBiasOf(material.figures));
  json.key("figures");
  writeFigures(json, material.figures);
  json.key("checks");
  writeChecks(json, material.checks);
  json.key("budget");
  writeRule(json, material.rule);
  json.key("baseline");
  writeBaseline(json, material.baseline);
  json.key("notModelled");
  writeTexts(json, material.notModelled);
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
  if (material.truth) {
    json.key("truth");
    writeTruth(json, *material.truth);
  }
  if (material.encoding) {
    json.key("encoding");
    writeEncoding(json, *material.encoding);
  }
  if (material.textures) {
    json.key("textures");
    writeTextures(json, *material.textures);
  }
  if (material.attribution) {
    json.key("attribution");
    writeAttribution(json, *material.attribution);
  }
  json.endObject();
}

} // namespace parity::compare
