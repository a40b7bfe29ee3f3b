// The table of all knobs as a whole.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "job/knob_page.h"
#include "job/knobs.h"
#include "mobile/options.h"

namespace parity::job {
namespace {

TEST(Knobs, HaveNamesOfTheirOwn) {
  std::set<std::string> names, titles;
  const auto add = [&](const base::Knob& knob) {
    EXPECT_TRUE(names.insert(knob.id).second) << knob.id;
    EXPECT_TRUE(titles.insert(knob.title).second) << knob.title;
    for (const std::string& alias : knob.aliases) EXPECT_TRUE(names.insert(alias).second) << alias;
  };
  for (const auto& row : knobs().rows()) add(row.knob);
  for (const auto& row : scenes::viewKnobs().rows()) add(row.knob);
}

TEST(Knobs, NeedKnobsThatThereAre) {
  for (const auto& row : knobs().rows()) {
    if (row.knob.needsKnob.empty()) continue;
    ASSERT_NE(knobs().find(row.knob.needsKnob), nullptr) << row.knob.id;
    EXPECT_FALSE(isActive(row.knob, Settings{})) << row.knob.id;
  }
}

// What a default is called can be given, and is the default.
TEST(Knobs, TakeTheirOwnText) {
  const Settings defaults;
  for (const auto& row : knobs().rows()) {
    const bool isText = row.knob.type == base::KnobType::text || row.knob.type == base::KnobType::texts ||
                        row.knob.type == base::KnobType::file;
    if (!row.knob.isOption || isText || row.text(defaults) == row.knob.otherwise) continue;
    Settings settings;
    row.set(settings, {row.text(defaults)});
    EXPECT_EQ(row.text(settings), row.text(defaults)) << row.knob.id;
  }
}

// Each choice is told apart, and nothing but the row's own text changes (a preset changes others).
TEST(Knobs, SetTheirMemberAndNoOther) {
  for (const auto& row : knobs().rows()) {
    if (row.knob.id == "mobile-preset") continue;
    std::set<std::string> texts;
    for (const std::string& choice : row.knob.choices) {
      Settings settings;
      row.set(settings, {choice});
      EXPECT_TRUE(texts.insert(row.text(settings)).second) << row.knob.id << " " << choice;
      for (const auto& other : knobs().rows())
        if (other.knob.id != row.knob.id) {
          EXPECT_EQ(other.text(settings), other.text(Settings{})) << row.knob.id << " sets " << other.knob.id;
        }
    }
  }
}

// A command may begin with a precision of its own, as `bench` does.
TEST(Knobs, APresetLeavesWhatNoPresetSets) {
  Settings settings;
  auto& mobile = settings.of<mobile::Options>();
  mobile.precision = mobile::Precision::fp32;
  mobile.target = gpu::OutputTarget::r11g11b10f;
  mobile.textures = base::TextureBlock::astc4x4;
  mobile.lightCap = false;
  mobile.pixelFog = true;
  mobile.lightmap = mobile::LightmapForm::hq;
  const Settings changed = withKnobs(settings, {{"mobile-preset", {{"refit"}, "--mobile-preset"}}});
  const auto& refit = changed.of<mobile::Options>();
  EXPECT_EQ(refit.preset, "refit");
  EXPECT_EQ(refit.precision, mobile::Precision::fp32);
  EXPECT_EQ(refit.target, gpu::OutputTarget::r11g11b10f);
  EXPECT_EQ(refit.textures, base::TextureBlock::astc4x4);
  EXPECT_FALSE(refit.lightCap);
  EXPECT_TRUE(refit.pixelFog);
  EXPECT_EQ(refit.lightmap, mobile::LightmapForm::hq);
}

TEST(Knobs, PathsAreTwoKnownOnesAtLeast) {
  const auto paths = [](const std::string& text) { return withKnobs({}, {{"paths", {{text}, "--paths"}}}).pathNames; };
  EXPECT_EQ(paths("mobile,highend"), (std::vector<std::string>{"mobile", "highend"}));
  for (const char* wrong : {"mobile", "mobile,mobile", "mobile,desktop", "highend,", ""})
    EXPECT_THROW(paths(wrong), base::Error) << wrong;
  const base::GivenKnobs stored = {{"mobile-target", {{"rgba8-srgb"}, "--mobile-target"}}};
  EXPECT_NO_THROW(withKnobs({}, stored));
  EXPECT_THROW(withKnobs(withKnobs({}, {{"paths", {{"mobile,highend"}, "--paths"}}}), stored), base::Error)
      << "the reference would be cut off at white";
}

TEST(Knobs, GoIntoSettingsThatMakeSense) {
  const auto reasonOf = [](const base::GivenKnobs& given) -> std::string {
    try {
      withKnobs({}, given);
      return {};
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::usage);
      return error.what();
    }
  };
  const auto one = [](const std::string& id, const std::string& text) {
    return base::GivenKnobs{{id, {{text}, "--" + id}}};
  };
  EXPECT_EQ(reasonOf(one("direct-lobe", "refit")), "--direct-lobe: 'refit' cannot be combined with the preset "
                                                   "ue4-2020: refit's lobe and its environment BRDF need each other");
  EXPECT_NE(reasonOf(one("mixing-end", "0.1")), "");
  EXPECT_NE(reasonOf(base::merged(one("mobile-target", "rgba8-srgb"), one("display", "raw"))), "");
  EXPECT_EQ(reasonOf(one("direct-lobe", "phong-approx")), "");
  const Settings settings = withKnobs({}, one("fresnel", "dielectric"));
  EXPECT_EQ(settings.reference.model.surface.fresnel, shading::FresnelCurve::dielectric) << "the truth has it, too";
}

TEST(Knobs, ThePageOfTheDocumentationIsTheirs) {
  EXPECT_EQ(base::readText(PARITY_SOURCE_DIR "/docs/knobs.md"), describeKnobs())
      << "make it again: build/parity knobs > docs/knobs.md";
}

} // namespace
} // namespace parity::job
