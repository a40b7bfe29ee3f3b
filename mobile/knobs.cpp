#include "mobile/knobs.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/member_count.h"
#include "mobile/programs.h"

namespace parity::mobile {

namespace {

static_assert(base::memberCount<Options>() == 31 && base::memberCount<Mixing>() == 3, "a new member needs a row");

constexpr const char* kPresets = "set by the preset";

// Its names, and `none`, another name of `sky`: both leave the cube as it is but for SkyLightColor.
void setCaptureScale(Options& options, const std::string& text) {
  if (text == "by-roughness")
    throw base::KnobError{"'by-roughness' is no longer known: use 'mixing', the engine's own weight (--mixing-begin, "
                          "--mixing-end, --mixing-largest)"};
  options.captureScale =
      text == "none" ? CaptureScale::sky : static_cast<CaptureScale>(base::readChoice(text, captureScaleNames()));
}

void addPreset(base::KnobTable<Options>& t) {
  using base::KnobStage, base::KnobType;
  t.special(
       KnobType::choice, "mobile-preset", "", "Formulas of the mobile path",
       [](Options& o, const std::string& text) {
         const bool isBuiltIn = std::ranges::count(presetNames(), text) > 0;
         if (!isBuiltIn && paths::namesPresetFolder(text))
           o = optionsOfFolder(text, o);
         else
           o = withRest(presetByName(presetNames()[base::readChoice(text, presetNames())]), o);
       },
       [](const Options& o) { return o.preset; })
      .costs(KnobStage::shading)
      .listedAs("presets")
      .orFolder()
      .pinnedBy([](const Options& o) { return o.own ? o.own->reference() : o.preset; })
      .knob.choices = presetNames();
}

void addLook(base::KnobTable<Options>& t) {
  using base::KnobStage, base::KnobType;
  t.choice<&Options::environmentBrdf>("environment-brdf", environmentBrdfNames(), "Mobile path: the environment BRDF")
      .titled("mobile environment BRDF")
      .costs(KnobStage::shading)
      .needsScene("environment")
      .noOption();
  t.choice<&Options::directLobe>("direct-lobe", directLobeNames(), "Mobile path: the lobe of direct light")
      .titled("mobile direct lobe")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("directional light");
  t.special(KnobType::choice, "capture-scale", "",
            "Mobile path: scale of reflections; auto: mixing with baked captures,\nsky without them", setCaptureScale,
            [](const Options& o) { return captureScaleNames().at(static_cast<std::size_t>(o.captureScale)); })
      .titled("mobile capture scale")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("environment")
      .knob.choices = captureScaleNames();
  t.number<&Options::mixing, &Mixing::begin>(
      "mixing-begin", 0, 1, "Mobile path: roughness above which the lightmap starts to scale captures");
  t.number<&Options::mixing, &Mixing::end>("mixing-end", 0, 1,
                                           "Mobile path: roughness above which the lightmap scales captures in full");
  t.number<&Options::mixing, &Mixing::largest>("mixing-largest", 1e-4, kMaxMixingWeight,
                                               "Mobile path: largest factor by which the lightmap scales a capture");
  t.choice<&Options::capture>(
       "capture", captureEncodingNames(),
       "Mobile path: format of the environment: rgbm (8 bits a channel), rgb9e5 (as large)\nor fp16")
      .titled("mobile capture")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("environment");
  t.choice<&Options::sky>("sky-sh", skyFormNames(),
                          "Mobile path: SH coefficients of the sky light; tinted: 9, with one colour\nfor band 2")
      .titled("mobile sky")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("environment")
      .inWords([](const Options& o) {
        return o.sky == SkyForm::tinted
                   ? std::string("9 SH coefficients, one tint for the second band")
                   : fmt::format("{} SH coefficients", skyFormNames().at(static_cast<std::size_t>(o.sky)));
      });
  t.choice<&Options::coat>("mobile-coat", coatFormNames(), "Mobile path: the clear coat; ue4: about the base's normal")
      .titled("mobile clear coat")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("clear coat");
  t.choice<&Options::sheen>("mobile-sheen", sheenFormNames(), "Mobile path: the sheen of cloth")
      .titled("mobile sheen")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("sheen");
  t.choice<&Options::anisotropy>("mobile-anisotropy", anisotropyFormNames(),
                                 "Mobile path: brushed metal; bent: reflections about a bent normal")
      .titled("mobile anisotropy")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("anisotropy");
  t.choice<&Options::iridescence>("mobile-iridescence", iridescenceFormNames(),
                                  "Mobile path: thin films; tint: one colour for the view's angle")
      .titled("mobile iridescence")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("iridescence");
  t.choice<&Options::transmission>("mobile-transmission", transmissionFormNames(),
                                   "Mobile path: glass; alpha: as a blended surface;\nrefracted: one read of the "
                                   "environment;\nmixed: both for thin walls")
      .titled("mobile transmission")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("transmission");
  t.choice<&Options::diffuseTransmission>("mobile-diffuse-transmission", diffuseTransmissionFormNames(),
                                          "Mobile path: diffuse light through thin surfaces, such as leaves")
      .titled("mobile diffuse transmission")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("diffuse transmission");
  t.flag<&Options::fullyRough>("mobile-fully-rough",
                               "Mobile path: every material is fully rough, as by --fully-rough '*'")
      .titled("mobile fully rough")
      .costs(KnobStage::shading)
      .noOption();
  t.flag<&Options::nonmetal>("mobile-nonmetal", "Mobile path: shade every material as a nonmetal, to save time")
      .titled("mobile nonmetal")
      .otherwise(kPresets)
      .costs(KnobStage::shading);
  t.flag<&Options::parallax>("mobile-parallax", "Mobile path: correct reflections of baked captures by their boxes")
      .titled("mobile parallax")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("environment capture");
  t.flag<&Options::localLights>("mobile-local-lights", "Mobile path: shade up to four local lights for each object")
      .titled("mobile local lights")
      .otherwise(kPresets)
      .costs(KnobStage::shading)
      .needsScene("local light");
  t.flag<&Options::lightCap>("mobile-light-cap", "Mobile path: limit each object to its four brightest local lights")
      .titled("mobile light cap")
      .costs(KnobStage::shading)
      .needsScene("local light");
  t.flag<&Options::pixelFog>("mobile-pixel-fog", "Mobile path: compute the fog for each pixel, not at vertices")
      .titled("mobile pixel fog")
      .costs(KnobStage::shading)
      .needsScene("fog");
  t.choice<&Options::lightmap>("mobile-lightmap", lightmapFormNames(),
                               "Mobile path: form of the lightmap; lq: Unreal Engine 4's low quality,\n"
                               "hq: as the high-end path reads it")
      .titled("mobile lightmap")
      .costs(KnobStage::shading)
      .needsScene("lightmap");
}

void addShadows(base::KnobTable<Options>& t) {
  t.flag<&Options::spotShadow>("mobile-spot-shadow",
                               "Mobile path: the brightest spot light casts a shadow, from its own shadow map");
  t.number<&Options::spotShadowSharpen>("mobile-spot-sharpen", 1, 8, "Sharpness of the edge of this shadow, 1 to 8")
      .needs("mobile-spot-shadow");
  t.number<&Options::spotShadowFade>("mobile-spot-fade", 0, 1, "Strength of this shadow, 0 to 1")
      .needs("mobile-spot-shadow");
  t.flag<&Options::sunShadow>("mobile-sun-shadow",
                              "Mobile path: the sun casts a shadow from a shadow map, up to a distance,\n"
                              "in addition to its baked shadow");
  t.number<&Options::sunShadowDistance>("mobile-sun-distance", 1e-3, 1e6,
                                        "Distance from the camera at which this shadow ends, metres")
      .needs("mobile-sun-shadow");
  t.number<&Options::sunShadowFade>("mobile-sun-fade", 0, 1,
                                    "Share of this distance over which the shadow fades out, 0 to 1")
      .needs("mobile-sun-shadow");
}

std::string describeTarget(const Options& o) {
  return gpu::outputTargetNames().at(static_cast<std::size_t>(o.target)) +
         (gpu::isDisplayed(o.target) ? ", as displayed: light above white is cut off" : "");
}

std::string describeTextures(const Options& o) {
  return o.textures == base::TextureBlock::none
             ? "as they are"
             : fmt::format("{}, {:.2f} bits a texel",
                           base::textureBlockNames().at(static_cast<std::size_t>(o.textures)),
                           base::bitsPerTexel(o.textures));
}

void addStorage(base::KnobTable<Options>& t) {
  t.choice<&Options::target>("mobile-target", gpu::outputTargetNames(), "Mobile path: format of the render target")
      .costs(base::KnobStage::storage)
      .inWords(describeTarget);
  t.choice<&Options::textures>("mobile-textures", base::textureBlockNames(),
                               "Mobile path: compression of material textures, as on a phone")
      .costs(base::KnobStage::storage)
      .needsScene("texture")
      .inWords(describeTextures);
}

base::KnobTable<Options> makeKnobs() {
  base::KnobTable<Options> t;
  t.section("Paths", {"mobile"});
  addPreset(t);
  addLook(t);
  addShadows(t);
  t.number<&Options::roughnessFloor>("mobile-roughness-floor", 0, 1, "Mobile path: smallest roughness")
      .otherwise(kPresets);
  t.choice<&Options::precision>("precision", precisionNames(),
                                "Mobile path: precision of its arithmetic; fp16 becomes fp32 on a device without it")
      .titled("mobile precision")
      .costs(base::KnobStage::shading);
  addStorage(t);
  return t;
}

} // namespace

const base::KnobTable<Options>& knobs() {
  static const base::KnobTable<Options> table = makeKnobs();
  return table;
}

void requireSense(const Options& options, const std::string& display) {
  const auto refuse = [](const char* option, const std::string& reason) {
    throw base::Error(base::ExitCode::usage, option, "", reason);
  };
  if (!(options.mixing.begin < options.mixing.end))
    refuse("--mixing-begin",
           fmt::format("{} is not below --mixing-end ({})", options.mixing.begin, options.mixing.end));
  if (options.directLobe == DirectLobe::own && !(options.own && options.own->defines("presetDirectLobe")))
    refuse("--direct-lobe", "'own' needs a preset folder that defines presetDirectLobe");
  if (options.own && options.own->defines("presetCaptureMip") && options.environmentBrdf == EnvironmentBrdf::refit)
    refuse("--mobile-preset",
           "presetCaptureMip has no effect with refit's environment BRDF, which has a mip of its own");
  // Refit's lobe and its environment BRDF share their terms: neither is anything without the other.
  if ((options.directLobe == DirectLobe::refit) != (options.environmentBrdf == EnvironmentBrdf::refit))
    refuse(
        "--direct-lobe",
        fmt::format("'{}' cannot be combined with the preset {}: refit's lobe and its environment BRDF need each other",
                    directLobeNames().at(static_cast<std::size_t>(options.directLobe)), options.preset));
  if (gpu::isDisplayed(options.target) && display != "sRGB")
    refuse("--mobile-target",
           fmt::format("'{}' stores sRGB for the screen; the display transform '{}' needs a float target",
                       gpu::outputTargetNames().at(static_cast<std::size_t>(options.target)), display));
}

} // namespace parity::mobile
