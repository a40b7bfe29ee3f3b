// One list of conditions: whatever decides a figure is seen by the cache's key, by the report and by the comparison
// with a baseline.
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/temp_folder.h"
#include "highend/options.h"
#include "job/conditions.h"
#include "mobile/options.h"
#include "report/baseline.h"
#include "report/reader.h"

namespace parity::job {
namespace {

using compare::ActsOn;
using compare::Condition;

// What a run is asked for: its settings are the scene's, too, but for what the scene says.
struct Asked {
  Settings settings;
  SceneRequest request;
};

// Of a scene that says something of everything, so that each member of what it says counts.
Asked makeAsked() {
  Asked asked;
  asked.settings.truth = true;
  asked.settings.reference.bounces = 1;
  mobile::Options& mobile = asked.settings.of<mobile::Options>();
  mobile.spotShadow = mobile.sunShadow = true;
  asked.request.name = "Desk";
  asked.request.scene = "Desk.glb";
  asked.settings.scene.environment = "no-such.hdr";
  asked.settings.scene.baked = "no-such";
  asked.settings.scene.sun = scenes::SunRequest{30, 50, 4};
  asked.settings.scene.fog.density = 0.1f;
  asked.request.views.emplace_back().orbit = glm::vec3(30, 70, 2);
  asked.request.views[0].target = glm::vec3(0);
  return asked;
}

gpu::DeviceReport makeDevice() {
  gpu::DeviceReport device;
  device.name = "llvmpipe";
  device.driver = "Mesa 22";
  device.float16 = true;
  return device;
}

// As if the scene said nothing else than the run.
Conditions conditionsOf(Asked asked) {
  asked.request.settings = asked.settings;
  return job::conditionsOf(asked.settings, asked.request, makeDevice());
}

// A change of one member, and the row that says so.
struct Change {
  const char* row;
  std::function<void(Settings& s, SceneRequest& r)> make;
};

#define CHANGE(statement) [](Settings& s, SceneRequest& r) { static_cast<void>(s), static_cast<void>(r), statement; }
const std::vector<Change> kChanges = {
    {"size", CHANGE(s.width = 1025)},
    {"size", CHANGE(s.height = 1025)},
    {"samples", CHANGE(s.samples = 4)},
    {"filter width", CHANGE(s.filterWidth = 2)},
    {"display", CHANGE(s.display = "ACES SDR")},
    {"background", CHANGE(s.background.y = 0.18000002f)},
    {"materials", CHANGE(s.materials = {"Hero*"})},
    {"metrics", CHANGE(s.metrics.push_back("ssim"))},
    {"terms", CHANGE(s.terms = true)},
    {"coverage", CHANGE(s.coverage = true)},
    {"dropped lights", CHANGE(s.droppedLights = 3)},
    {"costs", CHANGE(s.costs = true)},
    {"what if", CHANGE(s.whatIfs.push_back({"refit", "mobile", {}, "refit"}))},
    {"specular anti-aliasing", CHANGE(s.specularAa = gpu::SpecularAa::toksvig)},
    {"shadow map size", CHANGE(s.shadowMaps.mapSize = 512)},
    {"shadow filter", CHANGE(s.shadowMaps.filter = 5)},
    {"memory of shadow maps", CHANGE(s.shadowMaps.maxBytes -= 1)},
    {"highend preset", CHANGE(s.of<highend::Options>().preset = "./mine@0123456789ab")},
    {"highend geometry term",
     CHANGE(s.of<highend::Options>().model.geometryTerm = highend::GeometryTerm::schlickSmith)},
    {"highend fresnel", CHANGE(s.of<highend::Options>().model.fresnel = highend::FresnelCurve::sphericalGaussian)},
    {"highend diffuse", CHANGE(s.of<highend::Options>().model.diffuse = highend::DiffuseLobe::lambert)},
    {"highend compensation", CHANGE(s.of<highend::Options>().compensation = highend::Compensation::none)},
    {"highend off-specular", CHANGE(s.of<highend::Options>().offSpecular = highend::OffSpecular::dominant)},
    {"mobile preset", CHANGE(s.of<mobile::Options>().preset = "refit")},
    {"mobile environment BRDF", CHANGE(s.of<mobile::Options>().environmentBrdf = mobile::EnvironmentBrdf::karis2014)},
    {"mobile direct lobe", CHANGE(s.of<mobile::Options>().directLobe = mobile::DirectLobe::dApprox)},
    {"mobile capture scale", CHANGE(s.of<mobile::Options>().captureScale = mobile::CaptureScale::full)},
    {"mobile capture", CHANGE(s.of<mobile::Options>().capture = mobile::CaptureEncoding::fp16)},
    {"mobile sky", CHANGE(s.of<mobile::Options>().sky = mobile::SkyForm::sh9)},
    {"mobile clear coat", CHANGE(s.of<mobile::Options>().coat = mobile::CoatForm::none)},
    {"mobile sheen", CHANGE(s.of<mobile::Options>().sheen = mobile::SheenForm::fit)},
    {"mobile anisotropy", CHANGE(s.of<mobile::Options>().anisotropy = mobile::AnisotropyForm::bent)},
    {"mobile iridescence", CHANGE(s.of<mobile::Options>().iridescence = mobile::IridescenceForm::tint)},
    {"mobile transmission", CHANGE(s.of<mobile::Options>().transmission = mobile::TransmissionForm::refracted)},
    {"mobile diffuse transmission",
     CHANGE(s.of<mobile::Options>().diffuseTransmission = mobile::DiffuseTransmissionForm::lambert)},
    {"mobile fully rough", CHANGE(s.of<mobile::Options>().fullyRough = true)},
    {"mobile nonmetal", CHANGE(s.of<mobile::Options>().nonmetal = true)},
    {"mobile parallax", CHANGE(s.of<mobile::Options>().parallax = true)},
    {"mobile local lights", CHANGE(s.of<mobile::Options>().localLights = false)},
    {"mobile light cap", CHANGE(s.of<mobile::Options>().lightCap = false)},
    {"mobile pixel fog", CHANGE(s.of<mobile::Options>().pixelFog = true)},
    {"mobile lightmap", CHANGE(s.of<mobile::Options>().lightmap = mobile::LightmapForm::hq)},
    {"mixing begin", CHANGE(s.of<mobile::Options>().mixing.begin = 0.1000001f)},
    {"mixing end", CHANGE(s.of<mobile::Options>().mixing.end = 0.4f)},
    {"mixing largest", CHANGE(s.of<mobile::Options>().mixing.largest = 9999)},
    {"mobile spot shadow", CHANGE(s.of<mobile::Options>().spotShadow = false)},
    {"mobile spot sharpen", CHANGE(s.of<mobile::Options>().spotShadowSharpen = 2)},
    {"mobile spot fade", CHANGE(s.of<mobile::Options>().spotShadowFade = 0.5f)},
    {"mobile sun shadow", CHANGE(s.of<mobile::Options>().sunShadow = false)},
    {"mobile sun distance", CHANGE(s.of<mobile::Options>().sunShadowDistance = 100)},
    {"mobile sun fade", CHANGE(s.of<mobile::Options>().sunShadowFade = 0.2f)},
    {"mobile roughness floor", CHANGE(s.of<mobile::Options>().roughnessFloor = 0.015625002f)},
    {"mobile precision", CHANGE(s.of<mobile::Options>().precision = mobile::Precision::fp32)},
    {"highend lut size", CHANGE(s.of<highend::Options>().lutSize = 64)},
    {"highend prefilter samples", CHANGE(s.of<highend::Options>().prefilterSamples = 8)},
    {"highend prefilter size", CHANGE(s.of<highend::Options>().prefilterSize = 128)},
    {"paths", CHANGE(std::ranges::reverse(s.pathNames))},
    {"mobile target", CHANGE(s.of<mobile::Options>().target = gpu::OutputTarget::rgba8Srgb)},
    {"mobile textures", CHANGE(s.of<mobile::Options>().textures = base::TextureBlock::astc6x6)},
    {"truth", CHANGE(s.truth = false)},
    {"scattering of the truth", CHANGE(s.reference.model.scattering = reference::Scattering::single)},
    {"error of the truth", CHANGE(s.reference.integral.relativeError = 0.0050001)},
    {"truth min samples", CHANGE(s.reference.integral.minSamples = 512)},
    {"truth max samples", CHANGE(s.reference.integral.maxSamples = 512)},
    {"truth seed", CHANGE(s.reference.integral.seed = 1)},
    {"exposure", CHANGE(s.exposureEv = 1)},
    {"sun extraction", CHANGE(s.scene.extractSun = false)},
    {"shadows", CHANGE(s.shadows = true)},
    {"interreflection", CHANGE(s.reference.bounces = 2)},
    {"fully rough", CHANGE(s.scene.fullyRough = {"*"})},
    {"name", CHANGE(r.name = "Table")},
    {"file", CHANGE(r.scene = "Table.glb")},
    {"time", CHANGE(s.scene.load.timeSeconds = 1e-9)},
    {"animation", CHANGE(s.scene.load.animation = "all")},
    {"scene of the file", CHANGE(s.scene.load.scene = "1")},
    {"variant", CHANGE(s.scene.load.variant = "none")},
    {"limit of images", CHANGE(s.scene.load.maxImageSide = 64)},
    {"limit of images", CHANGE(s.scene.load.maxImageTexels = 64 << 20)},
    {"limit of memory", CHANGE(s.scene.load.maxMemoryBytes = 64)},
    {"subject", CHANGE(s.scene.subject = scenes::Subject::ball)},
    {"environment", CHANGE(s.scene.environment = "builtin:studio")},
    {"file of the environment", CHANGE(s.scene.environment = "./no-such.hdr")},
    {"environment rotation", CHANGE(s.scene.environmentRotationDeg = 90)},
    {"sun", CHANGE(s.scene.sun.reset())},
    {"sun", CHANGE(s.scene.sun->azimuthDeg = 31)},
    {"sun", CHANGE(s.scene.sun->elevationDeg = 51)},
    {"sun", CHANGE(s.scene.sun->lux = 4.0000005f)},
    {"sky light color", CHANGE(s.scene.lightScales.skyLightColor.z = 0.5f)},
    {"indirect color scale", CHANGE(s.scene.lightScales.indirectColorScale.x = 0.5f)},
    {"sun specular scale", CHANGE(s.scene.lightScales.sunSpecularScale = 0.5f)},
    {"falloff", CHANGE(s.scene.falloff = scenes::Falloff::ue4)},
    {"fog", CHANGE(s.scene.fog = {})},
    {"fog", CHANGE(s.scene.fog.density = 0.2f)},
    {"fog", CHANGE(s.scene.fog.heightFalloff = 0.2f)},
    {"fog", CHANGE(s.scene.fog.height = 0.2f)},
    {"fog color", CHANGE(s.scene.fog.color.x = 0.2f)},
    {"fog start", CHANGE(s.scene.fog.startDistance = 0.2f)},
    {"fog opacity", CHANGE(s.scene.fog.maxOpacity = 0.2f)},
    {"baked light", CHANGE(s.scene.baked.clear())},
    {"file of the baked light", CHANGE(s.scene.baked = "./no-such/")},
    {"places of captures", CHANGE(r.captures.emplace_back(1, 2, 3))},
    {"view", CHANGE(r.views[0].name = "front")},
    {"camera", CHANGE(r.views[0].camera = "automatic")},
    {"orbit", CHANGE(r.views[0].orbit->z = 3)},
    {"orbit", CHANGE(r.views[0].orbit.reset())},
    {"target", CHANGE(r.views[0].target->x = 1)},
    {"target", CHANGE(r.views[0].target.reset())},
    {"field of view", CHANGE(r.views[0].fovYDeg = 44)},
};
#undef CHANGE

// A run's report as later runs read it: one material that passes, also by its regressions where they can be judged.
report::Report makeReport(const Conditions& conditions) {
  report::Report report;
  report.device = "llvmpipe (Mesa 22)";
  report.conditions = reported(conditions.run);
  report::SceneResult& scene = report.scenes.emplace_back();
  scene.name = "Desk";
  scene.conditions = reported(conditions.scene);
  report::ViewResult& view = scene.views.emplace_back();
  view.name = "auto";
  view.width = view.height = 64;
  view.conditions = reported(conditions.views.at(0));
  compare::Figures figures;
  figures.pixels = 100;
  figures.values = {{"flip.mean", 0.05}};
  compare::CheckResult level;
  level.metric = "flip.mean";
  level.value = 0.05;
  compare::CheckResult regression = level;
  regression.regress = true;
  regression.failAbove = 0;
  regression.unjudged = "no baseline";
  report::MaterialResult& material = view.materials.emplace_back();
  material.name = "Wood";
  view.whole = material.figures = figures;
  view.checks = material.checks = {level, regression};
  report::settleVerdicts(report);
  return report;
}

report::Report readBack(const report::Report& report) {
  const base::TempFolder folder;
  base::writeText(folder / "report.json", report::toJson(report));
  return report::readReport(folder.path());
}

report::Report hold(const Conditions& now, const Conditions& before) {
  report::Report report = makeReport(now);
  report::compareWithBaseline(report, readBack(makeReport(before)), {"old", {}, false});
  return report;
}

std::map<std::string, ActsOn> rowsOf(const Conditions& conditions) {
  std::map<std::string, ActsOn> rows;
  for (const auto* list : {&conditions.run, &conditions.scene, &conditions.views.at(0)})
    for (const Condition& condition : *list) {
      EXPECT_FALSE(rows.contains(condition.name)) << condition.name << " stands there twice";
      rows[condition.name] = condition.actsOn;
    }
  return rows;
}

// The three notice one change as `actsOn` has it.
void expectNoticed(const Conditions& before, const Conditions& now, const std::string& row, ActsOn actsOn) {
  EXPECT_NE(hashOf(now), hashOf(before)) << row << ": the key does not see it";
  EXPECT_EQ(report::toJson(makeReport(now)) != report::toJson(makeReport(before)), actsOn != ActsOn::nothing)
      << row << ": the report";
  const report::Report report = hold(now, before);
  const report::ViewResult& view = report.scenes[0].views[0];
  const report::MaterialResult& material = view.materials[0];
  const auto expectOne = [&](const std::string& notComparable, compare::Verdict verdict, const compare::CheckResult& c,
                             bool differs) {
    EXPECT_EQ(notComparable.find(row + " was ") != std::string::npos, differs) << row << ": " << notComparable;
    EXPECT_EQ(verdict, differs ? compare::Verdict::warn : compare::Verdict::pass) << row;
    EXPECT_EQ(c.unjudged, differs ? "not comparable: " + notComparable : "") << row;
  };
  expectOne(material.baseline->notComparable, material.verdict, material.checks[1], actsOn == ActsOn::figures);
  expectOne(view.baseline->notComparable, view.wholeVerdict, view.checks[1],
            actsOn == ActsOn::figures || actsOn == ActsOn::wholes);
}

TEST(Conditions, EachMemberIsSeenByKeyReportAndBaseline) {
  const Asked asked = makeAsked();
  const Conditions before = conditionsOf(asked);
  const std::map<std::string, ActsOn> rows = rowsOf(before);
  for (const auto& [row, make] : kChanges) {
    Asked other = asked;
    make(other.settings, other.request);
    const auto known = rows.find(row);
    ASSERT_NE(known, rows.end()) << row;
    expectNoticed(before, conditionsOf(other), row, known->second);
  }
}

TEST(Conditions, EachRowHasAChangeAbove) {
  std::set<std::string> changed;
  for (const Change& change : kChanges) changed.insert(change.row);
  for (const auto& [row, actsOn] : rowsOf(conditionsOf(makeAsked())))
    EXPECT_TRUE(changed.contains(row)) << "add a change of '" << row << "' to kChanges";
}

// A knob that none of the three has ever heard of.
TEST(Conditions, ANewRowIsSeenByKeyReportAndBaseline) {
  for (const ActsOn actsOn : {ActsOn::figures, ActsOn::wholes, ActsOn::truth, ActsOn::nothing})
    for (const auto list : {+[](Conditions& c) { return &c.run; }, +[](Conditions& c) { return &c.scene; },
                            +[](Conditions& c) { return &c.views[0]; }}) {
      Conditions before = conditionsOf(makeAsked()), now = before;
      list(before)->push_back({"knob", "0.1", actsOn});
      list(now)->push_back({"knob", "0.2", actsOn});
      expectNoticed(before, now, "knob", actsOn);
      expectNoticed(conditionsOf(makeAsked()), now, "knob", actsOn); // recorded by the one alone
    }
}

TEST(Conditions, WhatJudgesAfterwardsOrMakesNoDifferenceIsNone) {
  const Asked asked = makeAsked();
  Asked other = asked;
  other.settings.budgets = other.request.budgets = "strict.toml";
  other.settings.attribution = Attribution::overBudget;
  other.settings.cacheFolder = "elsewhere";
  other.settings.cacheBytes = 1;
  other.settings.device.name = "1";
  EXPECT_EQ(hashOf(conditionsOf(other)), hashOf(conditionsOf(asked)));
  Asked plain = asked;
  plain.settings.truth = other.settings.truth = false;
  other.settings.reference.integral.seed = 7;
  other.request.views[0].camera = "auto";
  EXPECT_EQ(hashOf(conditionsOf(other)), hashOf(conditionsOf(plain))) << "no truth, and the camera as without a name";
}

TEST(Conditions, WhatASceneSaysHidesWhatTheRunSays) {
  Asked asked = makeAsked();
  asked.settings.exposureEv = 2;
  Asked other = asked;
  other.request.settings = asked.settings;
  other.settings.exposureEv = 1;
  other.settings.of<mobile::Options>() = mobile::presetByName("refit");
  const Conditions own = job::conditionsOf(other.settings, other.request, makeDevice());
  EXPECT_EQ(hashOf(own), hashOf(conditionsOf(asked)));
  const auto count = [](const std::vector<Condition>& list, const std::string& name) {
    return std::ranges::count(list, name, &Condition::name);
  };
  EXPECT_EQ(count(own.scene, "exposure"), 1) << "the run says another";
  EXPECT_EQ(count(own.scene, "mobile preset"), 1);
  EXPECT_EQ(count(own.scene, "display"), 0) << "the run says it";
  const report::Report report = hold(own, conditionsOf(asked));
  EXPECT_EQ(report.scenes[0].views[0].materials[0].baseline->notComparable, "");
}

// A user's name is none of the program's words, and two lists are never one text.
TEST(Conditions, ValuesThatDifferNeverReadAlike) {
  const auto valueOf = [](const std::vector<std::string>& globs) {
    Asked asked = makeAsked();
    asked.settings.materials = globs;
    return hashOf(conditionsOf(asked));
  };
  const std::set<std::string> different = {valueOf({}),           valueOf({"all"}),       valueOf({"a", "b"}),
                                           valueOf({"a, b"}),     valueOf({"a', 'b"}),    valueOf({"a\\', 'b"}),
                                           valueOf({"a\\", "b"}), valueOf({"a\\', \\'b"})};
  EXPECT_EQ(different.size(), 8u);
}

TEST(Conditions, FilesCountByTheirContentAndNoFolderIsSaid) {
  const base::TempFolder one, two;
  const auto conditionsWith = [](const std::filesystem::path& sky, const std::filesystem::path& baked) {
    Asked asked = makeAsked();
    asked.settings.scene.environment = sky.string();
    asked.settings.scene.baked = baked.string();
    return conditionsOf(asked);
  };
  for (const base::TempFolder* folder : {&one, &two}) {
    base::writeText(*folder / "sky.hdr", "light");
    std::filesystem::create_directory(*folder / "lamp");
    base::writeText(*folder / "lamp" / "manifest.json", "{}");
  }
  const Conditions before = conditionsWith(one / "sky.hdr", one / "lamp");
  const report::Report same = hold(conditionsWith(two / "sky.hdr", two / "lamp/"), before);
  EXPECT_EQ(same.scenes[0].views[0].materials[0].baseline->notComparable, "") << "elsewhere, but the same";
  EXPECT_EQ(report::toJson(same).find(two.path().string()), std::string::npos);
  base::writeText(two / "sky.hdr", "other light");
  base::writeText(two / "lamp" / "manifest.json", "{ }");
  const report::Report other = hold(conditionsWith(two / "sky.hdr", two / "lamp"), before);
  const std::string words = other.scenes[0].views[0].materials[0].baseline->notComparable;
  EXPECT_EQ(words.find("environment was sky.hdr (content "), 0u) << words;
  EXPECT_NE(words.find("; baked light was lamp (content "), std::string::npos) << words;
  EXPECT_EQ(report::toJson(makeReport(conditionsWith(two / "none.hdr", ""))).find("/none.hdr"), std::string::npos);
}

// A file may be called as the program calls none.
TEST(Conditions, NoFileIsTakenForNone) {
  Asked none = makeAsked(), named = none;
  none.settings.scene.environment = none.settings.scene.baked = "";
  named.settings.scene.environment = "not given";
  named.settings.scene.baked = "none";
  const std::map<std::string, ActsOn> rows = rowsOf(conditionsOf(named));
  EXPECT_TRUE(rows.contains("file of the environment"));
  EXPECT_TRUE(rows.contains("file of the baked light"));
  EXPECT_NE(hashOf(conditionsOf(named)), hashOf(conditionsOf(none)));
}

TEST(Conditions, PrecisionIsWhatTheDeviceCan) {
  const Asked asked = makeAsked();
  gpu::DeviceReport without = makeDevice();
  without.float16 = false;
  for (const auto& [name, value] : describeSettings(asked.settings, without))
    if (name == "mobile precision") {
      EXPECT_EQ(value, "fp32, because the device has no shaderFloat16");
    }
  EXPECT_NE(hashOf(job::conditionsOf(
                asked.settings,
                [&] {
                  SceneRequest r = asked.request;
                  r.settings = asked.settings;
                  return r;
                }(),
                without)),
            hashOf(conditionsOf(asked)));
}

TEST(Conditions, SettingsAreTheirWords) {
  const Asked asked = makeAsked();
  const auto settings = describeSettings(asked.settings, makeDevice());
  std::map<std::string, std::string> texts(settings.begin(), settings.end());
  EXPECT_EQ(settings.size(), texts.size()) << "a name twice";
  EXPECT_EQ(texts["size"], "1024x1024");
  EXPECT_EQ(texts["exposure"], "0 EV");
  EXPECT_EQ(texts["mobile sky"], "4 SH coefficients");
  EXPECT_EQ(texts["materials"], "all");
  EXPECT_EQ(texts["shadow map size"], "2048");
  EXPECT_EQ(texts["mobile textures"], "as they are");
  for (const Condition& condition : reported(runConditions(asked.settings, makeDevice())))
    EXPECT_EQ(texts[condition.name], condition.text());
  EXPECT_FALSE(texts.contains("terms")) << "it acts on nothing";
}

} // namespace
} // namespace parity::job
