#include "compare/json_figures.h"

namespace parity::compare {
namespace {

void writeMetrics(JsonWriter& json, const Figures& figures) {
  json.beginObject();
  for (const Figure& figure : figures.values) json.key(figure.name).number(figure.value);
  json.endObject();
}

void writeTruthFigures(JsonWriter& json, const TruthFigures& region) {
  if (region.highend.pixels == 0) return json.null();
  json.beginObject();
  json.key("nonFinite").integer(region.nonFinite);
  json.key("highend");
  writeFigures(json, region.highend);
  json.key("mobile");
  writeFigures(json, region.mobile);
  json.key("error").beginObject();
  json.key("median").number(region.error.median);
  json.key("worst").number(region.error.worst);
  json.key("relmse").number(region.error.relmse);
  json.key("samples").number(region.error.samples);
  json.endObject();
  json.endObject();
}

void writeTermFigures(JsonWriter& json, const Figures& highend, const Figures& mobile) {
  if (highend.pixels == 0) return json.null();
  json.beginObject();
  json.key("highend");
  writeMetrics(json, highend);
  json.key("mobile");
  writeMetrics(json, mobile);
  json.endObject();
}

void writeTerm(JsonWriter& json, const TruthTerm& term) {
  json.beginObject();
  json.key("term").text(term.name);
  json.key("luminance").beginObject();
  json.key("truth").number(term.truth);
  json.key("highend").number(term.highend);
  json.key("mobile").number(term.mobile);
  json.endObject();
  json.key("figures");
  writeTermFigures(json, term.highendFigures, term.mobileFigures);
  json.endObject();
}

} // namespace

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
  json.key("metrics");
  writeMetrics(json, figures);
  json.key("clippedBlack").number(figures.clippedBlack);
  json.key("clippedWhite").number(figures.clippedWhite);
  json.key("referenceLuma").number(figures.referenceLuma);
  json.key("testLuma").number(figures.testLuma);
  json.key("referenceLuminance").number(figures.referenceLuminance);
  json.key("testLuminance").number(figures.testLuminance);
  json.endObject();
}

void writeEncoding(JsonWriter& json, const Encoding& encoding) {
  json.beginObject();
  json.key("target").text(encoding.target);
  json.key("figures");
  writeFigures(json, encoding.figures);
  json.endObject();
}

void writeTextures(JsonWriter& json, const TextureCompression& textures) {
  json.beginObject();
  json.key("block").text(textures.block);
  json.key("figures");
  writeFigures(json, textures.figures);
  json.endObject();
}

void writeTruth(JsonWriter& json, const Truth& truth) {
  json.beginObject();
  json.key("figures");
  writeTruthFigures(json, truth.figures);
  json.key("terms").beginArray();
  for (const TruthTerm& term : truth.terms) writeTerm(json, term);
  json.endArray();
  json.key("notes");
  writeTexts(json, truth.notes);
  json.key("images").beginObject();
  json.key("truth").text(truth.images.truth);
  json.key("highendFlip").text(truth.images.highendFlip);
  json.key("mobileFlip").text(truth.images.mobileFlip);
  json.endObject();
  json.endObject();
}

void writeDroppedLights(JsonWriter& json, const DroppedLights& dropped) {
  json.beginObject();
  json.key("lights").integer(dropped.lights);
  json.key("measured").beginArray();
  for (const DroppedLight& light : dropped.measured) {
    json.beginObject();
    json.key("name").text(light.name);
    json.key("kind").text(light.kind);
    json.key("keptBy").integer(light.keptBy);
    json.key("droppedBy").integer(light.droppedBy);
    json.key("materials").beginArray();
    for (const LightEffect& effect : light.materials) {
      json.beginObject();
      json.key("name").text(effect.material);
      json.key("flip").number(effect.flip);
      json.endObject();
    }
    json.endArray();
    json.endObject();
  }
  json.endArray();
  json.key("notMeasured");
  writeTexts(json, dropped.notMeasured);
  json.endObject();
}

} // namespace parity::compare
