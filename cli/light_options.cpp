#include "cli/light_options.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/option_parts.h"

namespace parity::cli {

namespace {

using namespace scenes;

glm::vec3 parseColor(const std::string& option, const std::string& text, float most) {
  const std::string wanted = fmt::format("three numbers R,G,B from 0 to {:.0f}", most);
  const auto n = parseNumbers(option, text, 3, wanted);
  for (const float channel : n)
    if (channel < 0 || channel > most) throw invalid(option, text, wanted);
  return {n[0], n[1], n[2]};
}

} // namespace

void addLightOptions(CLI::App& app, RawLightOptions& raw) {
  const auto add = [&](const char* name, auto& value, const char* description) {
    return app.add_option(name, value, description)->group("Scene");
  };
  add("--sky-light-color", raw.skyLightColor, "R,G,B that scales the environment's light. Default 1,1,1");
  add("--indirect-color-scale", raw.indirectColorScale,
      "R,G,B that scales the light of lightmaps (--baked). Default 1,1,1");
  add("--sun-specular-scale", raw.scales.directionalSpecularScale, "Scales the specular light of directional lights")
      ->check(within(0, kMaxLightScale))
      ->capture_default_str();
  add("--falloff", raw.falloff, "How point and spot lights fade, in every path: as KHR_lights_punctual or as UE4")
      ->check(oneOf(falloffNames()))
      ->capture_default_str();
  add("--fog", raw.fog, "Height fog: DENSITY,FALLOFF,HEIGHT (1/m at HEIGHT; halves every 1/FALLOFF m upwards; m)");
  add("--fog-color", raw.fogColor, "Radiance of thick fog, linear R,G,B. Default 0.447,0.638,1")->needs("--fog");
  add("--fog-start", raw.fogBesides.startDistance, "No fog nearer than this, metres")
      ->check(within(0, kMaxFogLength))
      ->needs("--fog");
  add("--fog-opacity", raw.fogBesides.maxOpacity, "The most that fog hides, 0 to 1. Default 1")
      ->check(within(0, 1))
      ->needs("--fog");
}

const std::vector<std::string>& lightOptionNames() {
  static const std::vector<std::string> names = {
      "--sky-light-color", "--indirect-color-scale", "--sun-specular-scale", "--falloff", "--fog", "--fog-color",
      "--fog-start",       "--fog-opacity"};
  return names;
}

void settleLight(CommonOptions& common, const RawLightOptions& raw) {
  LightScales& scales = common.lightScales;
  scales = raw.scales;
  if (!raw.skyLightColor.empty())
    scales.skyLightColor = parseColor("--sky-light-color", raw.skyLightColor, kMaxLightScale);
  if (!raw.indirectColorScale.empty())
    scales.indirectColorScale = parseColor("--indirect-color-scale", raw.indirectColorScale, kMaxLightScale);
  common.falloff = enumOf<Falloff>(raw.falloff, falloffNames());
  if (raw.fog.empty()) return;
  const auto n = parseNumbers("--fog", raw.fog, 3, "DENSITY,FALLOFF,HEIGHT");
  if (n[0] < 0 || n[0] > kMaxFogDensity || n[1] < 0 || n[1] > kMaxFogFalloff || std::abs(n[2]) > kMaxFogLength)
    throw invalid("--fog", raw.fog,
                  fmt::format("a fog: DENSITY is from 0 to {:.0f}, FALLOFF from 0 to {:.0f}, HEIGHT within {:.0f} m",
                              kMaxFogDensity, kMaxFogFalloff, kMaxFogLength));
  common.fog = raw.fogBesides;
  common.fog->density = n[0];
  common.fog->heightFalloff = n[1];
  common.fog->height = n[2];
  if (!raw.fogColor.empty()) common.fog->color = parseColor("--fog-color", raw.fogColor, kMaxFogRadiance);
}

} // namespace parity::cli
