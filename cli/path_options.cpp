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

// Its names, and `none`, another name of `sky`: both leave the cube as it is but for SkyLightColor.
CLI::Validator captureScaleName() {
  std::vector<std::string> names = mobile::captureScaleNames();
  names.emplace_back("none");
  CLI::Validator known = oneOf(names);
  return {[known](std::string& text) {
            if (text == "by-roughness")
              return std::string("'by-roughness' is replaced by 'mixing', the engine's own weight (--mixing-begin, "
                                 "--mixing-end, --mixing-largest)");
            std::string problem = known(text);
            if (text == "none") text = "sky";
            return problem;
          },
          known.get_description()};
}

void addMixingOptions(CLI::App& app, mobile::Mixing& mixing) {
  app.add_option("--mixing-begin", mixing.begin, "Mobile path: roughness above which captures follow the lightmap")
      ->check(within(0, 1))
      ->group("Paths")
      ->capture_default_str();
  app.add_option("--mixing-end", mixing.end, "Mobile path: roughness from which they follow it whole")
      ->check(within(0, 1))
      ->group("Paths")
      ->capture_default_str();
  app.add_option("--mixing-largest", mixing.largest, "Mobile path: the most that a capture is brightened by it")
      ->check(within(1e-4, mobile::kMaxMixingWeight))
      ->group("Paths")
      ->capture_default_str();
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
  app.add_option("--sky-sh", raw.skyForm,
                 "Mobile path: SH coefficients of the sky light, 4 or 9; tinted: 9, band 2 in one tint\n"
                 "(the preset's)")
      ->check(CLI::IsMember(mobile::skyFormNames()))
      ->group("Paths");
  app.add_option("--capture", raw.capture,
                 "Mobile path: the environment in 8-bit rgbm, in rgb9e5 of as many bits, or in fp16 (the preset's)")
      ->check(CLI::IsMember(mobile::captureEncodingNames()))
      ->group("Paths");
  app.add_option("--capture-scale", raw.captureScale,
                 "Mobile path: what scales reflections (the preset's); auto: mixing of baked captures, else sky")
      ->transform(captureScaleName())
      ->group("Paths");
  addMixingOptions(app, raw.mixing);
  app.add_option("--direct-lobe", raw.directLobe, "Mobile path: the lobe of direct light (the preset's)")
      ->check(CLI::IsMember(mobile::directLobeNames()))
      ->group("Paths");
  addNamed(app, "--mobile-target", raw.mobileTarget, gpu::outputTargetNames(), defaults.mobileTarget,
           "Render target of the mobile path: what its colour is stored in");
  addNamed(app, "--mobile-textures", raw.mobileTextures, base::textureBlockNames(), defaults.mobileTextures,
           "Mobile path: blocks that material textures are compressed in, as a phone has them");
}

void addMobileShadowOptions(CLI::App& app, mobile::Options& options) {
  app.add_flag("--mobile-spot-shadow", options.spotShadow,
               "Mobile path: the brightest spot light casts a shadow, by a map of its own")
      ->group("Paths");
  app.add_option("--mobile-spot-sharpen", options.spotShadowSharpen, "Sharpens that shadow's edge, 1 to 8")
      ->check(within(1, 8))
      ->needs("--mobile-spot-shadow")
      ->group("Paths")
      ->capture_default_str();
  app.add_option("--mobile-spot-fade", options.spotShadowFade, "How much of that shadow is seen, 0 to 1")
      ->check(within(0, 1))
      ->needs("--mobile-spot-shadow")
      ->group("Paths")
      ->capture_default_str();
  app.add_flag("--mobile-sun-shadow", options.sunShadow,
               "Mobile path: the sun casts a shadow by a map, too, beside the baked one, up to a distance")
      ->group("Paths");
  app.add_option("--mobile-sun-distance", options.sunShadowDistance,
                 "Metres along the view from which on that shadow is gone")
      ->check(within(1e-3, 1e6))
      ->needs("--mobile-sun-shadow")
      ->group("Paths")
      ->capture_default_str();
  app.add_option("--mobile-sun-fade", options.sunShadowFade,
                 "The last share of that distance over which it goes, 0 to 1")
      ->check(within(0, 1))
      ->needs("--mobile-sun-shadow")
      ->group("Paths")
      ->capture_default_str();
}

// Refit's lobe and its environment BRDF share their terms: neither is anything without the other.
mobile::DirectLobe lobeOf(const mobile::Options& options, const std::string& name) {
  const auto lobe = enumOf<mobile::DirectLobe>(name, mobile::directLobeNames());
  const bool ofRefit = options.environmentBrdf == mobile::EnvironmentBrdf::refit;
  if ((lobe == mobile::DirectLobe::refit) != ofRefit)
    throw CLI::ValidationError("--direct-lobe", fmt::format("'{}' does not go with the preset {}: refit's lobe and "
                                                            "its environment BRDF are one",
                                                            name, options.preset));
  return lobe;
}

void settleMobile(mobile::Options& options, const RawPathOptions& raw) {
  options = mobile::presetByName(raw.mobilePreset);
  options.precision = enumOf<mobile::Precision>(raw.precision, mobile::precisionNames());
  options.mixing = raw.mixing;
  if (!(options.mixing.begin < options.mixing.end))
    throw CLI::ValidationError("--mixing-begin", fmt::format("{} is not below --mixing-end, which is {}",
                                                             options.mixing.begin, options.mixing.end));
  options.spotShadow = raw.mobileShadows.spotShadow;
  options.spotShadowSharpen = raw.mobileShadows.spotShadowSharpen;
  options.spotShadowFade = raw.mobileShadows.spotShadowFade;
  options.sunShadow = raw.mobileShadows.sunShadow;
  options.sunShadowDistance = raw.mobileShadows.sunShadowDistance;
  options.sunShadowFade = raw.mobileShadows.sunShadowFade;
  if (!raw.directLobe.empty()) options.directLobe = lobeOf(options, raw.directLobe);
  if (!raw.skyForm.empty()) options.sky = enumOf<mobile::SkyForm>(raw.skyForm, mobile::skyFormNames());
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
  addMobileShadowOptions(app, raw.mobileShadows);
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
  s.mobileTextures = enumOf<base::TextureBlock>(raw.mobileTextures, base::textureBlockNames());
  settleModel(s, raw);
  s.specularAa = raw.specularAa == "toksvig" ? gpu::SpecularAa::toksvig : gpu::SpecularAa::off;
}

} // namespace parity::cli
