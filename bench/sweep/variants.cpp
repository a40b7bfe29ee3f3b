#include "sweep/variants.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace parity::sweep {

namespace {

template <typename Enum> std::string nameAt(const std::vector<std::string>& names, Enum value) {
  return names.at(static_cast<std::size_t>(value));
}

std::string mobileName(const mobile::Options& o) {
  return fmt::format("{} {}", o.preset, nameAt(mobile::precisionNames(), o.precision));
}

// Collects variants of one path, each as its default but for what `turn` does.
struct Collector {
  Variant plain;
  std::vector<Variant>& all;

  void add(const std::string& knob, const std::string& value, const std::string& needs, auto turn) {
    Variant v = plain;
    turn(v);
    // The default's value is there already, but for what is prepared, which has times of its own.
    if (v.knobs() == plain.knobs() && plain.stage != Stage::preparation) return;
    v.knob = knob;
    v.name = knob + " " + value;
    v.needs = needs;
    all.push_back(std::move(v));
  }

  // One for each name of an enumeration.
  template <typename Options, typename Enum>
  void addEach(const std::string& knob, const std::vector<std::string>& names, const std::string& needs,
               Options Variant::*options, Enum Options::*member) {
    for (std::size_t i = 0; i < names.size(); ++i)
      add(knob, names[i], needs, [&](Variant& v) { v.*options.*member = static_cast<Enum>(i); });
  }

  void addSet(const std::string& name, const std::string& needs, auto turn) {
    Variant v = plain;
    turn(v);
    if (v.knobs() == plain.knobs()) return;
    v.name = name;
    v.needs = needs;
    all.push_back(std::move(v));
  }
};

void addHighend(Collector& c) {
  using highend::Options;
  c.addEach("off-specular", highend::offSpecularNames(), "environment", &Variant::highend, &Options::offSpecular);
  c.addEach("compensation", highend::compensationNames(), "", &Variant::highend, &Options::compensation);
  c.addEach("geometry-term", highend::geometryTermNames(), "", &Variant::highend, &Options::geometryTerm);
  c.addEach("fresnel", highend::fresnelNames(), "", &Variant::highend, &Options::fresnel);
  c.addEach("diffuse", highend::diffuseNames(), "", &Variant::highend, &Options::diffuse);
  const auto karis2013 = [](Variant& v) {
    v.highend.offSpecular = highend::OffSpecular::none;
    v.highend.compensation = highend::Compensation::none;
  };
  c.addSet("Karis 2013 (no off-specular read, no compensation)", "environment", karis2013);
  c.addSet("Karis 2013 and Turquin 2019", "environment", [&](Variant& v) {
    karis2013(v);
    v.highend.compensation = highend::Compensation::turquin;
  });
  c.plain.stage = Stage::preparation;
  for (const int size : {8, 16, 32, 64, 128, 256})
    c.add("lut-size", std::to_string(size), "environment", [&](Variant& v) { v.lutSize = size; });
  for (const int samples : {8, 32, 128, 512})
    c.add("prefilter-samples", std::to_string(samples), "environment",
          [&](Variant& v) { v.prefilter.sampleCount = samples; });
  for (const int size : {64, 128, 256})
    c.add("prefilter-size", std::to_string(size), "environment", [&](Variant& v) { v.prefilter.faceSize = size; });
}

void addMobile(Collector& c) {
  using mobile::Options;
  for (const std::string& preset : mobile::presetNames())
    for (const mobile::Precision precision : {mobile::Precision::fp16, mobile::Precision::fp32}) {
      Options options = mobile::presetByName(preset);
      options.precision = precision;
      c.addSet(mobileName(options), "", [&](Variant& v) { v.mobile = options; });
    }
  // The form of refit belongs to its lobe, so these two stay as they are there.
  if (c.plain.mobile.environmentBrdf != mobile::EnvironmentBrdf::refit) {
    for (const auto form : {mobile::EnvironmentBrdf::karis2014, mobile::EnvironmentBrdf::ue4})
      c.add("environment-brdf", nameAt(mobile::environmentBrdfNames(), form), "environment",
            [&](Variant& v) { v.mobile.environmentBrdf = form; });
    for (const auto form :
         {mobile::DirectLobe::dApprox, mobile::DirectLobe::phongApprox, mobile::DirectLobe::calcSpecular})
      c.add("sun", nameAt(mobile::directLobeNames(), form), "directional light",
            [&](Variant& v) { v.mobile.directLobe = form; });
  }
  c.addEach("capture", mobile::captureEncodingNames(), "environment", &Variant::mobile, &Options::capture);
  for (std::size_t i = 1; i < mobile::captureScaleNames().size(); ++i) // all but auto, which is one of them
    c.add("capture-scale", mobile::captureScaleNames()[i], "environment",
          [&](Variant& v) { v.mobile.captureScale = static_cast<mobile::CaptureScale>(i); });
  c.addEach("sky-sh", mobile::skyFormNames(), "environment", &Variant::mobile, &Options::sky);
  for (const bool lights : {false, true})
    c.add("local-lights", lights ? "4" : "0", "local light", [&](Variant& v) { v.mobile.localLights = lights; });
  for (const mobile::Precision precision : {mobile::Precision::fp16, mobile::Precision::fp32})
    c.addSet(fmt::format("refit {}, capture fp16", nameAt(mobile::precisionNames(), precision)), "environment",
             [&](Variant& v) {
               v.mobile = mobile::presetByName("refit");
               v.mobile.precision = precision;
               v.mobile.capture = mobile::CaptureEncoding::fp16;
             });
  c.plain.stage = Stage::storage;
  for (std::size_t i = 0; i < gpu::outputTargetNames().size(); ++i)
    c.add("mobile-target", gpu::outputTargetNames()[i], "",
          [&](Variant& v) { v.target = static_cast<gpu::OutputTarget>(i); });
  for (std::size_t i = 0; i < base::textureBlockNames().size(); ++i)
    c.add("mobile-textures", base::textureBlockNames()[i], "texture",
          [&](Variant& v) { v.textures = static_cast<base::TextureBlock>(i); });
}

} // namespace

const std::vector<std::string>& stageKinds() {
  static const std::vector<std::string> names = {"shading", "preparation", "storage"};
  return names;
}

std::vector<std::pair<std::string, std::string>> Variant::knobs() const {
  if (path == "highend")
    return {{"off-specular", nameAt(highend::offSpecularNames(), highend.offSpecular)},
            {"compensation", nameAt(highend::compensationNames(), highend.compensation)},
            {"geometry-term", nameAt(highend::geometryTermNames(), highend.geometryTerm)},
            {"fresnel", nameAt(highend::fresnelNames(), highend.fresnel)},
            {"diffuse", nameAt(highend::diffuseNames(), highend.diffuse)},
            {"lut-size", std::to_string(lutSize)},
            {"prefilter-samples", std::to_string(prefilter.sampleCount)},
            {"prefilter-size", std::to_string(prefilter.faceSize)}};
  return {{"preset", mobile.preset},
          {"precision", nameAt(mobile::precisionNames(), mobile.precision)},
          {"environment-brdf", nameAt(mobile::environmentBrdfNames(), mobile.environmentBrdf)},
          {"sun", nameAt(mobile::directLobeNames(), mobile.directLobe)},
          {"capture", nameAt(mobile::captureEncodingNames(), mobile.capture)},
          {"capture-scale", nameAt(mobile::captureScaleNames(), mobile::captureScaleOf(mobile, false))},
          {"sky-sh", nameAt(mobile::skyFormNames(), mobile.sky)},
          {"local-lights", mobile.localLights ? "4" : "0"},
          {"mobile-target", nameAt(gpu::outputTargetNames(), target)},
          {"mobile-textures", nameAt(base::textureBlockNames(), textures)}};
}

std::vector<Variant> makeVariants(const highend::Options& highend, const mobile::Options& mobile,
                                  gpu::OutputTarget target, base::TextureBlock textures) {
  std::vector<Variant> all;
  Variant highendPlain, mobilePlain;
  highendPlain.path = "highend";
  highendPlain.highend = highend;
  mobilePlain.path = "mobile";
  mobilePlain.mobile = mobile;
  mobilePlain.target = target;
  mobilePlain.textures = textures;
  all.push_back(highendPlain);
  all.push_back(mobilePlain);
  Collector ofHighend{highendPlain, all}, ofMobile{mobilePlain, all};
  addHighend(ofHighend);
  addMobile(ofMobile);
  return all;
}

} // namespace parity::sweep
