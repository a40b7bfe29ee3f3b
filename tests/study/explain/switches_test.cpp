// Switches: what is proposed, what is read, what is refused.
#include "study/explain/switches.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "job/knobs.h"
#include "mobile/options.h"

namespace parity::explain {
namespace {

using base::ExitCode;

std::vector<std::string> idsOf(const std::vector<Switch>& switches) {
  std::vector<std::string> ids;
  for (const Switch& each : switches) ids.push_back(each.id());
  return ids;
}

TEST(Switches, AreProposedAsFarAsTheyChangeSomething) {
  const std::vector<std::string> ids = idsOf(proposedSwitches({}));
  for (const char* id : {"formulas=refit", "sky-sh=9", "mobile-coat=refit", "precision=fp32", "mobile-fully-rough=on"})
    EXPECT_EQ(std::ranges::count(ids, id), 1) << id;
  for (const char* id : {"mobile-local-lights=on", "mobile-target=rgba16f", "mobile-sun-shadow=on"})
    EXPECT_EQ(std::ranges::count(ids, id), 0) << id << ": it is so already, or there are no shadows";
  job::Settings refit = job::withKnobs({}, {{"mobile-preset", {{"refit"}, ""}}, {"shadows", {{"on"}, ""}}});
  const std::vector<std::string> others = idsOf(proposedSwitches(refit));
  EXPECT_EQ(std::ranges::count(others, "formulas=refit"), 0);
  EXPECT_EQ(std::ranges::count(others, "mobile-sun-shadow=on"), 1);
}

TEST(Switches, SetWhatTheirMaskSays) {
  const std::vector<Switch> switches = {parseSwitch("formulas=refit", {}), parseSwitch("sky-sh=9", {})};
  const auto options = [&](SwitchMask mask) { return withSwitches({}, switches, mask).of<mobile::Options>(); };
  EXPECT_EQ(options(0).environmentBrdf, mobile::EnvironmentBrdf::ue4);
  EXPECT_EQ(options(1).environmentBrdf, mobile::EnvironmentBrdf::refit);
  EXPECT_EQ(options(1).directLobe, mobile::DirectLobe::refit);
  EXPECT_EQ(options(1).sky, mobile::SkyForm::sh4);
  EXPECT_EQ(options(2).sky, mobile::SkyForm::sh9);
  EXPECT_EQ(options(3).sky, mobile::SkyForm::sh9);
  EXPECT_EQ(namesOf(switches, 3), "formulas=refit + sky-sh=9");
  EXPECT_EQ(namesOf(switches, 0), "nothing");
}

TEST(Switches, RefuseWhatCannotBeTurned) {
  const auto expectRefused = [](const char* text, const std::vector<std::string>& parts) {
    base::expectError([&] { parseSwitch(text, {}); }, parts, ExitCode::usage);
  };
  expectRefused("sky-sh", {"--switch", "is not KNOB=VALUE"});
  expectRefused("=9", {"is not KNOB=VALUE"});
  expectRefused("sky-hs=9", {"'sky-hs' is no setting of the path 'mobile'", "did you mean 'sky-sh'?"});
  expectRefused("lut-size=8", {"is no setting of the path"});
  expectRefused("sky-sh=5", {"5"});
  expectRefused("sky-sh=4", {"is set already"});
  expectRefused("formulas=refitt", {"is no value of formulas", "did you mean 'refit'?"});
}

} // namespace
} // namespace parity::explain
