// A study of presets for a terminal, and as JSON.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/json_writer.h"
#include "base/text/text.h"
#include "study/preset/preset_study.h"

namespace parity::presets {

namespace {

std::string precisionOf(bool half) { return half ? "fp16" : "fp32"; }

std::string textOf(const PresetStudy& study) {
  std::string text = base::plainLine(study.preset) + "\n";
  if (!study.functions.empty()) text += fmt::format("  defines {}\n", fmt::join(study.functions, ", "));
  if (!study.failure.empty()) return text + "  failed: " + base::plainLine(study.failure) + "\n";
  text += "  environment BRDF against the table, absolute     max    rms\n";
  for (const EnvBrdfError& error : study.envBrdf)
    text += fmt::format("    F0 = {:<4} {}                               {:.4f}  {:.4f}\n", error.F0,
                        precisionOf(error.half), error.max, error.rms);
  text += "  direct lobe against GGX, F0 = 1             energy    rms\n";
  for (const LobeError& error : study.lobe)
    text += fmt::format("    roughness {:<4.3g}                              {:6.2f}  {:.3f}\n", error.roughness,
                        error.energy, error.rms);
  const std::uint64_t findings = findingsOf(study);
  text += findings == 0 ? "  stress: no NaN and no infinity\n" : "  stress: NaN or infinity\n";
  for (const FunctionStress& stress : study.stress)
    if (stress.nan + stress.infinite + stress.negative > 0)
      text += fmt::format("    {}, {}: {} NaN, {} infinite, {} negative of {} points{}\n", stress.function,
                          precisionOf(stress.half), stress.nan, stress.infinite, stress.negative, stress.points,
                          stress.firstBad.empty() ? "" : "; first at " + stress.firstBad);
  for (const SceneFigures& scene : study.scenes) {
    const auto worst = std::ranges::max_element(scene.flip, {}, [](const auto& each) { return each.second; });
    text +=
        fmt::format("  {}: mean FLIP {:.4f}; worst {:.4f} ({}); a pixel costs {} operations ({} in fp16), {} fetches, "
                    "{} samplers\n",
                    scene.environment, scene.meanFlip, worst == scene.flip.end() ? 0 : worst->second,
                    worst == scene.flip.end() ? "none" : base::plainLine(worst->first), scene.operations, scene.fp16,
                    scene.fetches, scene.samplers);
  }
  return text;
}

} // namespace

std::string plotFile(std::size_t study) { return fmt::format("env-brdf-{}.png", study + 1); }

std::string toText(const std::vector<PresetStudy>& studies) {
  std::string text;
  for (const PresetStudy& study : studies) text += textOf(study);
  return text;
}

std::string toJson(const std::vector<PresetStudy>& studies, const StudyRequest& request) {
  base::JsonWriter json;
  json.beginObject();
  json.key("format").integer(1);
  json.key("scene").text(request.scene);
  json.key("size").integer(request.size);
  json.key("presets");
  json.beginArray();
  for (const PresetStudy& study : studies) {
    json.beginObject();
    json.key("preset").text(study.preset);
    if (!study.base.empty()) json.key("base").text(study.base);
    if (!study.failure.empty()) json.key("failure").text(study.failure);
    json.key("functions");
    json.beginArray();
    for (const std::string& function : study.functions) json.text(function);
    json.endArray();
    json.key("envBrdf");
    json.beginArray();
    for (const EnvBrdfError& error : study.envBrdf) {
      json.beginObject();
      json.key("F0").number(error.F0);
      json.key("precision").text(precisionOf(error.half));
      json.key("max").number(error.max);
      json.key("rms").number(error.rms);
      json.endObject();
    }
    json.endArray();
    json.key("directLobe");
    json.beginArray();
    for (const LobeError& error : study.lobe) {
      json.beginObject();
      json.key("roughness").number(error.roughness);
      json.key("energy").number(error.energy);
      json.key("rms").number(error.rms);
      json.endObject();
    }
    json.endArray();
    json.key("stress");
    json.beginArray();
    for (const FunctionStress& stress : study.stress) {
      json.beginObject();
      json.key("function").text(stress.function);
      json.key("precision").text(precisionOf(stress.half));
      json.key("points").integer(stress.points);
      json.key("nan").integer(stress.nan);
      json.key("infinite").integer(stress.infinite);
      json.key("negative").integer(stress.negative);
      json.key("least").number(stress.least);
      json.key("greatest").number(stress.greatest);
      if (!stress.firstBad.empty()) json.key("first").text(stress.firstBad);
      json.endObject();
    }
    json.endArray();
    json.key("scenes");
    json.beginArray();
    for (const SceneFigures& scene : study.scenes) {
      json.beginObject();
      json.key("environment").text(scene.environment);
      json.key("meanFlip").number(scene.meanFlip);
      json.key("operations").integer(scene.operations);
      json.key("fp16").integer(scene.fp16);
      json.key("fetches").integer(scene.fetches);
      json.key("samplers").integer(scene.samplers);
      json.key("materials");
      json.beginArray();
      for (const auto& [name, flip] : scene.flip) {
        json.beginObject();
        json.key("name").text(name);
        json.key("flip").number(flip);
        json.endObject();
      }
      json.endArray();
      json.endObject();
    }
    json.endArray();
    json.endObject();
  }
  json.endArray();
  json.endObject();
  return json.finish();
}

} // namespace parity::presets
