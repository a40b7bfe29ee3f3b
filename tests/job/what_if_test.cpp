// Presets that a run measures beside its own settings: what each is, and which are refused.
#include <gtest/gtest.h>

#include "base/error.h"
#include "job/knobs.h"
#include "job/what_if.h"
#include "mobile/options.h"

namespace parity::job {
namespace {

base::GivenKnobs given(std::initializer_list<std::pair<const char*, base::KnobValue>> knobs) {
  base::GivenKnobs all;
  for (const auto& [id, value] : knobs) all[id] = {value, std::string("--") + id};
  return all;
}

std::string refusalOf(const base::GivenKnobs& knobs) {
  try {
    withKnobs({}, knobs);
    return {};
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::usage);
    return error.what();
  }
}

TEST(WhatIf, IsWhatARunWithThatPresetWouldBe) {
  const base::GivenKnobs others = given({{"sky-sh", {"9"}}, {"precision", {"fp32"}}});
  const Settings asked = withKnobs({}, base::merged(others, given({{"what-if", {"refit"}}})));
  const Settings plain = withKnobs({}, base::merged(others, given({{"mobile-preset", {"refit"}}})));
  ASSERT_EQ(asked.whatIfs.size(), 1u);
  EXPECT_EQ(asked.whatIfs[0].path, "mobile");
  for (const auto& row : pathOfPreset("refit")->knobs().rows())
    EXPECT_EQ(row.text(asked.whatIfs[0].options), row.text(plain.options)) << row.knob.id;
  EXPECT_EQ(asked.of<mobile::Options>().preset, mobile::Options().preset) << "the run itself stays";
}

TEST(WhatIf, TakesListsAndEachOnce) {
  const Settings settings = withKnobs({}, given({{"what-if", {"refit,karis2014", "refit", "ue4-2020"}}}));
  std::vector<std::string> names;
  for (const WhatIfPreset& each : settings.whatIfs) names.push_back(each.preset);
  EXPECT_EQ(names, (std::vector<std::string>{"refit", "karis2014", "ue4-2020"}));
  EXPECT_EQ(whatIfText(withKnobs({}, {})), "none");
}

// The preset's own value, given: the same settings of the run, but not of what it asks about.
TEST(WhatIf, CountsByAllThatThePresetSets) {
  const base::GivenKnobs asked = given({{"what-if", {"refit"}}}), sky = given({{"sky-sh", {"4"}}});
  const Settings without = withKnobs({}, asked), with = withKnobs({}, base::merged(asked, sky));
  EXPECT_EQ(knobs().find("sky-sh")->text(without), knobs().find("sky-sh")->text(with));
  EXPECT_NE(whatIfText(without), whatIfText(with));
  EXPECT_EQ(whatIfText(without), whatIfText(withKnobs({}, asked)));
}

TEST(WhatIf, RefusesWhatCannotBeMeasured) {
  const std::string unknown = refusalOf(given({{"what-if", {"refitt"}}}));
  EXPECT_NE(unknown.find("'refitt' is unknown; did you mean 'refit'?"), std::string::npos) << unknown;
  EXPECT_NE(refusalOf(given({{"what-if", {"refit,"}}})), "");
  const std::string first = refusalOf(given({{"what-if", {"refit"}}, {"paths", {"mobile,highend"}}}));
  EXPECT_NE(first.find("'refit' is a preset of 'mobile', which is not a test path here"), std::string::npos) << first;
  const std::string lobe = refusalOf(given({{"what-if", {"refit"}}, {"direct-lobe", {"phong-approx"}}}));
  EXPECT_NE(lobe.find("--what-if: 'refit' does not go together with other options"), std::string::npos) << lobe;
  EXPECT_EQ(refusalOf(given({{"what-if", {"refit"}}})), "");
}

} // namespace
} // namespace parity::job
