#include "cli/path_options.h"

#include <fmt/format.h>

#include "cli/option_parts.h"

namespace parity::cli {

namespace {

// An option that takes one of an enumeration's names; `text` begins as the default's.
template <typename Enum> void addNamed(CLI::App& app, const std::string& option, std::string& text,
                                       const std::vector<std::string>& names, Enum chosen,
                                       const std::string& description) {
  text = names[static_cast<std::size_t>(chosen)];
  app.add_option(option, text, description)->check(CLI::IsMember(names))->group("Paths")->capture_default_str();
}

void addModelOptions(CLI::App& app, const highend::Options& defaults, RawPathOptions& raw) {
  addNamed(app, "--geometry-term", raw.geometryTerm, highend::geometryTermNames(), defaults.geometryTerm,
           "Geometry term of the high-end path and the reference");
  addNamed(app, "--fresnel", raw.fresnel, highend::fresnelNames(), defaults.fresnel,
           "Fresnel's curve, in the high-end path and the reference");
  addNamed(app, "--diffuse", raw.diffuse, highend::diffuseNames(), defaults.diffuse,
           "Diffuse lobe of both: what the specular lobe leaves of the light, or all of it");
  addNamed(app, "--compensation", raw.compensation, highend::compensationNames(), defaults.compensation,
           "High-end path: what returns the light that single scattering loses");
  addNamed(app, "--off-specular", raw.offSpecular, highend::offSpecularNames(), defaults.offSpecular,
           "High-end path: how the prefiltered environment is read away from N = V = R");
}

void addMobileOptions(CLI::App& app, const job::Settings& defaults, RawPathOptions& raw) {
  app.add_option("--mobile-preset", raw.mobilePreset, "Formulas of the mobile path")
      ->check(CLI::IsMember(mobile::presetNames()))
      ->group("Paths")
      ->capture_default_str();
  app.add_option("--precision", raw.precision, "Of the mobile path; fp16 falls back to fp32 where the device lacks it")
      ->check(CLI::IsMember(mobile::precisionNames()))
      ->group("Paths")
      ->capture_default_str();
  app.add_option("--sky-sh", raw.skyCoefficients,
                 "Mobile path: SH coefficients of the sky light, 4 or 9 (the preset's)")
      ->check(CLI::IsMember({4, 9}))
      ->group("Paths");
  app.add_option("--capture", raw.capture, "Mobile path: the environment in 8-bit rgbm or in fp16 (the preset's)")
      ->check(CLI::IsMember(mobile::captureEncodingNames()))
      ->group("Paths");
  app.add_option("--capture-scale", raw.captureScale,
                 "Mobile path: how the environment follows the indirect light (the preset's)")
      ->check(CLI::IsMember(mobile::captureScaleNames()))
      ->group("Paths");
  app.add_flag("--mobile-spot-shadow", raw.mobileSpotShadow,
               "Mobile path: the brightest spot light casts a shadow, by a map of its own")
      ->group("Paths");
  addNamed(app, "--mobile-target", raw.mobileTarget, gpu::outputTargetNames(), defaults.mobileTarget,
           "Render target of the mobile path: what its colour is stored in");
  addNamed(app, "--mobile-textures", raw.mobileTextures, base::astcBlockNames(), defaults.mobileTextures,
           "Mobile path: blocks that material textures are compressed in, as a phone has them");
}

void settleMobile(mobile::Options& options, const RawPathOptions& raw) {
  options = mobile::presetByName(raw.mobilePreset);
  options.precision = enumOf<mobile::Precision>(raw.precision, mobile::precisionNames());
  options.spotShadow = raw.mobileSpotShadow;
  if (raw.skyCoefficients) options.skyCoefficients = *raw.skyCoefficients;
  if (!raw.capture.empty())
    options.capture = enumOf<mobile::CaptureEncoding>(raw.capture, mobile::captureEncodingNames());
  if (!raw.captureScale.empty())
    options.captureScale = enumOf<mobile::CaptureScale>(raw.captureScale, mobile::captureScaleNames());
}

void settleModel(job::Settings& s, const RawPathOptions& raw) {
  s.highend.geometryTerm = enumOf<highend::GeometryTerm>(raw.geometryTerm, highend::geometryTermNames());
  s.highend.fresnel = enumOf<highend::FresnelCurve>(raw.fresnel, highend::fresnelNames());
  s.highend.diffuse = enumOf<highend::DiffuseLobe>(raw.diffuse, highend::diffuseNames());
  s.highend.compensation = enumOf<highend::Compensation>(raw.compensation, highend::compensationNames());
  s.highend.offSpecular = enumOf<highend::OffSpecular>(raw.offSpecular, highend::offSpecularNames());
  reference::Model& model = s.reference.model;
  model.geometryTerm = s.highend.geometryTerm;
  model.fresnel = s.highend.fresnel;
  model.diffuse = s.highend.diffuse;
}

void addShadowOptions(CLI::App& app, RawPathOptions& raw) {
  app.add_flag("--shadows", raw.shadows,
               "Lights cast shadows: high-end by shadow maps, the reference by rays, of the environment too")
      ->group("Paths");
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t size = gpu::kMinShadowMapSize; size <= gpu::kMaxShadowMapSize; size *= 2) sizes.push_back(size);
  app.add_option("--shadow-map-size", raw.shadowMapSize,
                 "Texels a side of directional lights' maps; local lights' have half, faces of a cube a fourth")
      ->check(CLI::IsMember(sizes))
      ->group("Paths")
      ->capture_default_str();
  app.add_option("--shadow-filter", raw.shadowFilter, "Width of the shadow maps' filter, texels; 0: one texel, hard")
      ->check(CLI::IsMember({0, 1, 3, 5, 7}))
      ->group("Paths")
      ->capture_default_str();
}

} // namespace

void addPathOptions(CLI::App& app, const job::Settings& defaults, RawPathOptions& raw) {
  addShadowOptions(app, raw);
  addMobileOptions(app, defaults, raw);
  addModelOptions(app, defaults.highend, raw);
  app.add_option("--specular-aa", raw.specularAa, "Roughness from minified normal maps, in every path: toksvig or off")
      ->check(CLI::IsMember({"off", "toksvig"}))
      ->group("Paths")
      ->capture_default_str();
}

void settlePaths(job::Settings& s, const RawPathOptions& raw) {
  s.shadows = raw.shadows;
  s.shadowMaps.mapSize = raw.shadowMapSize;
  s.shadowMaps.filter = raw.shadowFilter;
  settleMobile(s.mobile, raw);
  s.mobileTarget = enumOf<gpu::OutputTarget>(raw.mobileTarget, gpu::outputTargetNames());
  if (gpu::isDisplayed(s.mobileTarget) && s.display != "sRGB")
    throw CLI::ValidationError("--mobile-target", fmt::format("'{}' is what the screen shows, as sRGB: the display "
                                                              "transform '{}' needs a float target",
                                                              raw.mobileTarget, s.display));
  s.mobileTextures = enumOf<base::AstcBlock>(raw.mobileTextures, base::astcBlockNames());
  settleModel(s, raw);
  s.specularAa = raw.specularAa == "toksvig" ? gpu::SpecularAa::toksvig : gpu::SpecularAa::off;
}

} // namespace parity::cli
