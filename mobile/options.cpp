#include "mobile/options.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"

namespace parity::mobile {

namespace {

const std::vector<Options>& presets() {
  static const std::vector<Options> all = [] {
    std::vector<Options> presets = {{.preset = "karis2014",
                                     .environmentBrdf = EnvironmentBrdf::karis2014,
                                     .directLobe = DirectLobe::dApprox,
                                     .captureScale = CaptureScale::full,
                                     .coat = CoatForm::none,
                                     .transmission = TransmissionForm::none,
                                     .localLights = false,
                                     .roughnessFloor = 0},
                                    {},
                                    {.preset = "refit",
                                     .environmentBrdf = EnvironmentBrdf::refit,
                                     .directLobe = DirectLobe::refit,
                                     .captureScale = CaptureScale::occlusion,
                                     .capture = CaptureEncoding::rgb9e5,
                                     .sky = SkyForm::tinted,
                                     .coat = CoatForm::refit,
                                     .sheen = SheenForm::fit,
                                     .anisotropy = AnisotropyForm::bent,
                                     .iridescence = IridescenceForm::tint,
                                     .transmission = TransmissionForm::mixed,
                                     .diffuseTransmission = DiffuseTransmissionForm::lambert,
                                     .roughnessFloor = 0}};
    return presets;
  }();
  return all;
}

} // namespace

const std::vector<std::string>& presetNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Options& preset : presets()) all.push_back(preset.preset);
    return all;
  }();
  return names;
}

Options presetByName(const std::string& name) {
  const auto found = std::ranges::find(presets(), name, &Options::preset);
  if (found == presets().end())
    throw base::Error(base::ExitCode::usage, "--mobile-preset", name,
                      fmt::format("unknown; the presets are {}", fmt::join(presetNames(), ", ")));
  return *found;
}

Options withRest(Options preset, const Options& rest) {
  preset.precision = rest.precision, preset.target = rest.target, preset.textures = rest.textures;
  preset.lightCap = rest.lightCap, preset.pixelFog = rest.pixelFog, preset.lightmap = rest.lightmap;
  return preset;
}

CaptureScale captureScaleOf(const Options& options, bool hasCaptures) {
  if (options.captureScale != CaptureScale::automatic) return options.captureScale;
  return hasCaptures ? CaptureScale::mixing : CaptureScale::sky;
}

const std::vector<std::string>& environmentBrdfNames() {
  static const std::vector<std::string> names = {"karis2014", "ue4", "refit", "own"};
  return names;
}
const std::vector<std::string>& precisionNames() {
  static const std::vector<std::string> names = {"fp16", "fp32"};
  return names;
}
const std::vector<std::string>& directLobeNames() {
  static const std::vector<std::string> names = {"d-approx", "calc-specular", "refit", "phong-approx", "own"};
  return names;
}
const std::vector<std::string>& captureScaleNames() {
  static const std::vector<std::string> names = {"auto", "sky", "mixing", "full", "occlusion"};
  return names;
}
const std::vector<std::string>& captureEncodingNames() {
  static const std::vector<std::string> names = {"rgbm", "rgb9e5", "fp16"};
  return names;
}
const std::vector<std::string>& skyFormNames() {
  static const std::vector<std::string> names = {"4", "9", "tinted"};
  return names;
}
const std::vector<std::string>& coatFormNames() {
  static const std::vector<std::string> names = {"none", "ue4", "refit"};
  return names;
}
const std::vector<std::string>& sheenFormNames() {
  static const std::vector<std::string> names = {"none", "fit"};
  return names;
}
const std::vector<std::string>& anisotropyFormNames() {
  static const std::vector<std::string> names = {"none", "bent"};
  return names;
}
const std::vector<std::string>& iridescenceFormNames() {
  static const std::vector<std::string> names = {"none", "tint"};
  return names;
}
const std::vector<std::string>& transmissionFormNames() {
  static const std::vector<std::string> names = {"none", "alpha", "refracted", "mixed"};
  return names;
}
const std::vector<std::string>& diffuseTransmissionFormNames() {
  static const std::vector<std::string> names = {"none", "lambert"};
  return names;
}
const std::vector<std::string>& lightmapFormNames() {
  static const std::vector<std::string> names = {"lq", "hq"};
  return names;
}

} // namespace parity::mobile
