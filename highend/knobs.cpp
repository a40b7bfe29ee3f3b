#include "highend/knobs.h"

#include "base/member_count.h"
#include "highend/programs.h"

namespace parity::highend {

namespace {

static_assert(base::memberCount<shading::SurfaceModel>() == 3 && base::memberCount<Options>() == 8,
              "a new member needs a row");

base::KnobTable<Options> makeKnobs() {
  using base::KnobStage;
  base::KnobTable<Options> t;
  t.section("Paths", {"highend"});
  t.special(
       base::KnobType::choice, "highend-preset", "", "Formulas of the high-end path",
       [](Options& o, const std::string& text) {
         const bool isFolder = text != kBuiltInPreset && paths::namesPresetFolder(text);
         if (!isFolder) base::readChoice(text, {kBuiltInPreset});
         o = isFolder ? optionsOfFolder(text) : Options();
       },
       [](const Options& o) { return o.preset; })
      .costs(KnobStage::shading)
      .orFolder()
      .pinnedBy([](const Options& o) { return o.own ? o.own->reference() : o.preset; })
      .knob.choices = {kBuiltInPreset};
  t.section("Paths", {"highend", "truth"});
  t.choice<&Options::model, &shading::SurfaceModel::geometryTerm>("geometry-term", geometryTermNames(),
                                                                  "Geometry term of the high-end path and the truth")
      .titled("highend geometry term")
      .costs(KnobStage::shading);
  t.choice<&Options::model, &shading::SurfaceModel::fresnel>("fresnel", fresnelNames(),
                                                             "Fresnel curve of the high-end path and the truth")
      .titled("highend fresnel")
      .costs(KnobStage::shading);
  t.choice<&Options::model, &shading::SurfaceModel::diffuse>(
       "diffuse", diffuseNames(),
       "Diffuse lobe of the high-end path and the truth.\n"
       "balanced: only light that the specular lobe leaves; lambert: all light")
      .titled("highend diffuse")
      .costs(KnobStage::shading);
  t.section("Paths", {"highend"});
  t.choice<&Options::compensation>("compensation", compensationNames(),
                                   "High-end path: method that restores the light that single scattering loses")
      .titled("highend compensation")
      .costs(KnobStage::shading);
  t.choice<&Options::offSpecular>("off-specular", offSpecularNames(),
                                  "High-end path: correction of the prefiltered environment, which assumes N = V = R")
      .titled("highend off-specular")
      .costs(KnobStage::shading)
      .needsScene("environment");
  const auto prepares = [&](base::KnobRow<Options>& row) {
    row.titled("highend " + row.knob.title).costs(KnobStage::preparation).needsScene("environment");
  };
  prepares(t.oneOf<&Options::lutSize>("lut-size", {"8", "16", "32", "64", "128", "256"},
                                      "High-end path: side of the environment BRDF's table in texels"));
  prepares(t.oneOf<&Options::prefilterSamples>(
      "prefilter-samples", {"8", "32", "128", "512"},
      "High-end path: samples for each texel in the first blurred mip of the prefiltered environment"));
  prepares(t.oneOf<&Options::prefilterSize>("prefilter-size", {"64", "128", "256"},
                                            "High-end path: side of the prefiltered environment's faces in texels"));
  return t;
}

} // namespace

const base::KnobTable<Options>& knobs() {
  static const base::KnobTable<Options> table = makeKnobs();
  return table;
}

} // namespace parity::highend
