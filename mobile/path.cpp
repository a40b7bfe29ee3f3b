#include "mobile/path.h"

#include <algorithm>

#include <fmt/format.h>

#include "mobile/approximate_brdf.h"
#include "mobile/environment_upload.h"
#include "mobile/knobs.h"
#include "mobile/light_choice.h"
#include "mobile/programs.h"
#include "mobile/renderer.h"
#include "mobile/sampled_brdf.h"

namespace parity::mobile {

namespace {

const gpu::EnvironmentMaps* environmentOf(const paths::Inputs& inputs, CaptureEncoding encoding) {
  const base::Stopwatch watch(inputs.services.timings, "upload");
  if (inputs.baked && !inputs.baked->captures.empty())
    return inputs.store.get(fmt::format("mobile captures {}", static_cast<int>(encoding)), [&] {
      return uploadCaptures(inputs.device, paths::cubesOf(*inputs.baked), *inputs.baked->captures.front().light,
                            encoding);
    });
  const lighting::EnvironmentLight* const light = inputs.light.environment.get();
  if (!light) return nullptr;
  const std::string key =
      fmt::format("mobile environment {} {}", static_cast<const void*>(light), static_cast<int>(encoding));
  return inputs.store.get(key, [&] {
    const lighting::CubeMap* cube = &light->prefiltered;
    return uploadCaptures(inputs.device, {&cube, 1}, *light, encoding);
  });
}

const gpu::BakedMaps* bakedOf(const paths::Inputs& inputs, LightmapForm form) {
  if (!inputs.baked) return nullptr;
  const base::Stopwatch watch(inputs.services.timings, "upload");
  return inputs.store.get(form == LightmapForm::hq ? "mobile lightmap hq" : "mobile lightmap",
                          [&] { return uploadBaked(inputs.device, *inputs.baked, form); });
}

// The high-end path's lightmap has only the bounces of stationary local lights, which the mobile path shades nowhere
// else.
bool lacksLocalLights(const paths::Inputs& inputs) {
  return inputs.baked && inputs.baked->localLights == lighting::LocalLights::isStationary &&
         std::ranges::any_of(inputs.buffers.scene().lights,
                             [](const scenes::Light& light) { return light.kind != scenes::LightKind::directional; });
}

// What acts: a lightmap that has all light.
Options withWholeLightmap(Options options, const paths::Inputs& inputs) {
  if (lacksLocalLights(inputs)) options.lightmap = LightmapForm::lq;
  return options;
}

gpu::ShadowMaps* shadowsOf(const paths::Inputs& inputs, const Options& options) {
  const std::vector<scenes::Light> casting = Renderer::needsShadowMaps(inputs.light.lights, options);
  if (casting.empty()) return nullptr;
  const base::Stopwatch watch(inputs.services.timings, "shadow maps");
  const std::string key = fmt::format("mobile shadow maps{}{}", options.sunShadow ? " of the sun" : "",
                                      options.spotShadow && options.localLights ? " of the spot light" : "");
  return inputs.store.get(key,
                          [&] { return gpu::ShadowMaps(inputs.device, inputs.buffers, casting, inputs.shadowMaps); });
}

// Of gpu::kFeatureLobes.
std::uint32_t shownLobes(const Options& options) {
  return (options.coat != CoatForm::none ? gpu::kFeatureCoat : 0u) |
         (options.sheen != SheenForm::none ? gpu::kFeatureSheen : 0u) |
         (options.anisotropy != AnisotropyForm::none ? gpu::kFeatureAnisotropy : 0u) |
         (options.iridescence != IridescenceForm::none ? gpu::kFeatureIridescence : 0u) |
         (options.transmission != TransmissionForm::none ? gpu::kFeatureTransmission : 0u) |
         (options.diffuseTransmission != DiffuseTransmissionForm::none ? gpu::kFeatureDiffuseTransmission : 0u);
}

std::string nameIn(const std::vector<std::string>& names, auto enumerator) {
  return names.at(static_cast<std::size_t>(enumerator));
}

// With notes on what casts no shadow, and on a lightmap that cannot be read. asked: before withWholeLightmap.
class PathRenderer final : public Renderer {
public:
  PathRenderer(const paths::Inputs& inputs, const Inputs& mine, const Options& options, const Options& asked)
      : Renderer(inputs.device, inputs.buffers, inputs.binKinds, mine, options), m_maps(mine.shadows),
        m_asksForAll(inputs.asksForShadows), m_replacesLightmap(options.lightmap != asked.lightmap) {}

  const gpu::ShadowMaps* shadowMaps() const override { return m_maps; }
  std::vector<std::string> notes() const override {
    std::vector<std::string> notes = Renderer::notes();
    if (m_replacesLightmap)
      notes.emplace_back(
          "--mobile-lightmap hq has no effect: stationary lights are in the lightmap of low quality alone");
    if (m_maps && !m_maps->note().empty()) notes.push_back(m_maps->note());
    if (m_asksForAll)
      notes.emplace_back(m_maps ? "there is no baked light, so only lights with a shadow map cast shadows; see --baked"
                                : "there is no baked light, so no light casts shadows; see --baked");
    return notes;
  }

private:
  const gpu::ShadowMaps* m_maps;
  bool m_asksForAll, m_replacesLightmap;
};

class MobilePath final : public paths::Path {
public:
  const std::string& name() const override {
    static const std::string name = "mobile";
    return name;
  }
  const std::string& title() const override { return name(); }
  const base::KnobTable<paths::Options>& knobs() const override {
    static const base::KnobTable<paths::Options> table = paths::knobsOf(mobile::knobs());
    return table;
  }
  std::string presetKnob() const override { return "mobile-preset"; }
  const paths::PresetHost* presetHost() const override { return &mobile::presetHost(); }
  void requireSense(const paths::Options& options, const std::string& display) const override {
    mobile::requireSense(options.of<Options>(), display);
  }
  std::string adapt(paths::Options& options, const gpu::DeviceReport& device) const override {
    Options& own = options.of<Options>();
    const Precision taken = precisionOn(device, own);
    if (taken == own.precision) return {};
    own.precision = taken;
    return "because the device has no shaderFloat16";
  }
  paths::LightNeeds lightNeeds(const paths::Options&) const override {
    return {.prefilter = {.levels = lighting::PrefilterLevels::first}, .hasOneSun = true, .bakesLocalLights = true};
  }
  const std::vector<paths::Intermediate>& intermediates() const override { return views(); }
  std::unique_ptr<paths::EnvBrdf> environmentBrdf(const paths::Options& options) const override {
    const Options& own = options.of<Options>();
    if (own.environmentBrdf == EnvironmentBrdf::own)
      return std::make_unique<SampledBrdf>(gpu::Device(gpu::DeviceOptions()), own);
    return std::make_unique<ApproximateBrdf>(own);
  }
  std::vector<std::string> environmentBrdfKnobs() const override {
    return {"mobile-preset", "mobile-roughness-floor", "mobile-fully-rough", "mobile-nonmetal"};
  }

  std::unique_ptr<paths::Renderer> makeRenderer(const paths::Inputs& inputs,
                                                const paths::Options& options) const override {
    const Options own = withWholeLightmap(options.of<Options>(), inputs);
    const Inputs mine{.environment = environmentOf(inputs, own.capture),
                      .lights = inputs.light.lights,
                      .shadows = shadowsOf(inputs, own),
                      .textures = inputs.textures,
                      .baked = bakedOf(inputs, own.lightmap),
                      .terms = inputs.terms,
                      .wide = inputs.wide,
                      .view = inputs.intermediate,
                      .compilation = inputs.compilation,
                      .expectedPixels = inputs.expectedPixels};
    return std::make_unique<PathRenderer>(inputs, mine, own, options.of<Options>());
  }

  std::optional<gpu::TargetCodec> target(const paths::Options& options, const gpu::DeviceReport& device,
                                         float exposureEv) const override {
    const Options& own = options.of<Options>();
    return gpu::TargetCodec(own.target, exposureEv, precisionOn(device, own) == Precision::fp16);
  }
  std::string targetName(const paths::Options& options) const override {
    return gpu::outputTargetNames().at(static_cast<std::size_t>(options.of<Options>().target));
  }
  base::TextureBlock textureBlock(const paths::Options& options) const override {
    return options.of<Options>().textures;
  }
  bool asksForShadows(const paths::Options& options) const override {
    return options.of<Options>().spotShadow || options.of<Options>().sunShadow;
  }
  std::vector<std::string> notesOn(const scenes::Material& m, const paths::Options& options) const override {
    const Options& own = options.of<Options>();
    std::vector<std::string> notes;
    const bool fullyRough = m.fullyRough || own.fullyRough;
    if (fullyRough) notes.emplace_back("fully rough: mobile has no specular light and no environment fetch");
    const std::uint32_t dropped = droppedLobes(m, options), shown = gpu::lobesOf(m) & ~dropped;
    for (const auto& [feature, lobe] : gpu::kLobeFeatures)
      if ((dropped & feature) != 0) notes.push_back(fmt::format("mobile drops the {}", lobe));
    // Their F0 changes with the view.
    const bool changesF0 =
        (own.coat == CoatForm::ue4 && (shown & gpu::kFeatureCoat) != 0) || (shown & gpu::kFeatureIridescence) != 0;
    const bool isKaris =
        own.environmentBrdf == EnvironmentBrdf::karis2014 || own.environmentBrdf == EnvironmentBrdf::ue4;
    const bool isOwn = own.environmentBrdf == EnvironmentBrdf::own && own.own->defines("presetEnvironmentBrdfNonmetal");
    if (!fullyRough && (m.isNonmetal() || own.nonmetal) && (isKaris || isOwn) && !changesF0)
      notes.emplace_back(isOwn ? "nonmetal: mobile uses presetEnvironmentBrdfNonmetal"
                               : "nonmetal: mobile uses EnvBRDFApproxNonmetal");
    return notes;
  }
  std::uint32_t droppedLobes(const scenes::Material& m, const paths::Options& options) const override {
    const Options& own = options.of<Options>();
    return gpu::lobesOf(m) & (m.fullyRough || own.fullyRough ? gpu::kFeatureLobes : ~shownLobes(own));
  }
  std::string describeLight(const paths::Options& options, bool hasCaptures) const override {
    const CaptureScale scale = captureScaleOf(options.of<Options>(), hasCaptures);
    return "scale of mobile reflections: " + captureScaleNames().at(static_cast<std::size_t>(scale));
  }

  bool mayDropLights(const std::vector<scenes::Light>& lights, const paths::Options& options) const override {
    return mobile::mayDropLights(lights, lightLimitOf(options.of<Options>()));
  }
  std::vector<paths::LightUse> countLightUse(const scenes::Scene& scene, const std::vector<scenes::Light>& lights,
                                             const paths::Options& options,
                                             const std::vector<std::uint64_t>& samples) const override {
    return mobile::countLightUse(scene, lights, lightLimitOf(options.of<Options>()), samples);
  }

  // Forms of the preset refit, then shadows and storage, then the overrides of quality.
  std::vector<Change> changes() const override {
    std::vector<Change> all;
    for (const std::string& name : presetNames()) {
      const Options preset = presetByName(name);
      all.push_back({.name = "formulas",
                     .value = name,
                     .words = "environment BRDF and direct lobe of " + name,
                     .approximation = "environment BRDF and direct lobe",
                     .values = {{"environment-brdf", nameIn(environmentBrdfNames(), preset.environmentBrdf)},
                                {"direct-lobe", nameIn(directLobeNames(), preset.directLobe)}},
                     .proposed = name == "refit"});
    }
    const auto add = [&](const char* knob, const char* value, const char* words, const char* approximation) -> Change& {
      return all.emplace_back(Change{
          .name = knob, .value = value, .words = words, .approximation = approximation, .values = {{knob, value}}});
    };
    add("capture-scale", "occlusion", "reflections scaled by occlusion alone", "scale of reflections");
    add("sky-sh", "9", "nine SH coefficients of the sky", "SH order of the sky");
    add("mobile-parallax", "on", "parallax of baked captures", "reflections without parallax");
    add("mobile-lightmap", "hq", "lightmap of high quality", "encoding of the lightmap");
    add("mobile-pixel-fog", "on", "fog for each pixel", "fog at vertices");
    add("mobile-coat", "refit", "clear coat of refit", "form of the clear coat");
    add("mobile-sheen", "fit", "sheen", "form of the sheen");
    add("mobile-anisotropy", "bent", "anisotropy by a bent normal", "form of the anisotropy");
    add("mobile-iridescence", "tint", "thin films as a tint", "form of the iridescence");
    add("mobile-transmission", "mixed", "glass with a refracted read", "form of the transmission");
    add("mobile-diffuse-transmission", "lambert", "diffuse transmission", "form of the diffuse transmission");
    add("mobile-local-lights", "on", "four local lights", "no local lights");
    add("mobile-light-cap", "off", "all local lights", "cap of four local lights");
    add("mobile-sun-shadow", "on", "shadow map of the sun", "no shadow map of the sun").ofShadows = true;
    add("mobile-spot-shadow", "on", "shadow map of the brightest spot light", "no shadow map of the spot light")
        .ofShadows = true;
    add("capture", "fp16", "reflections stored in 16-bit floats", "storage of reflections");
    add("precision", "fp32", "fp32 in place of half", "half precision");
    add("mobile-roughness-floor", "0", "no floor of the roughness", "floor of the roughness");
    add("mobile-target", "rgba16f", "render target of 16-bit floats", "format of the render target");
    add("mobile-textures", "none", "textures as they are", "texture compression");
    add("mobile-fully-rough", "on", "fully rough", "").cheapens = true;
    add("mobile-nonmetal", "on", "nonmetal", "").cheapens = true;
    return all;
  }

  // Every preset in both precisions, folders that are in use too; refit also where its capture costs no bits.
  std::vector<KnobSet> knobSets() const override {
    std::vector<KnobSet> sets;
    std::vector<std::pair<std::string, std::string>> presets; // name, value
    for (const std::string& preset : presetNames()) presets.emplace_back(preset, preset);
    for (const auto& folder : paths::readPresetFolders(name()))
      presets.emplace_back(folder->text(), folder->reference());
    for (const auto& [preset, value] : presets)
      for (const std::string& precision : precisionNames())
        sets.push_back(
            {fmt::format("{} {}", preset, precision), "", {{"mobile-preset", value}, {"precision", precision}}});
    for (const std::string& precision : precisionNames())
      sets.push_back({fmt::format("refit {}, capture fp16", precision),
                      "environment",
                      {{"mobile-preset", "refit"}, {"precision", precision}, {"capture", "fp16"}}});
    return sets;
  }
};

} // namespace

const paths::Path& path() {
  static const MobilePath path;
  return path;
}

} // namespace parity::mobile
