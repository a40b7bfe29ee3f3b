// junit.xml, read back by an XML parser: cases, verdicts, counts, and names that would break naive XML.
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "compare/verdict/budget.h"
#include "report/judge.h"
#include "report/report.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

pugi::xml_document parse(const std::string& xml) {
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(xml.data(), xml.size(), pugi::parse_full, pugi::encoding_utf8);
  EXPECT_TRUE(result) << result.description() << " at byte " << result.offset;
  return document;
}

pugi::xml_node findCase(const pugi::xml_document& document, const std::string& className, const std::string& name) {
  for (const auto& suite : document.child("testsuites").children("testsuite"))
    for (const auto& test : suite.children("testcase"))
      if (test.attribute("classname").value() == className && test.attribute("name").value() == name) return test;
  return {};
}

// Tallies of the elements themselves must be what the attributes claim, in each suite and in total.
void expectCountsFit(const pugi::xml_document& document) {
  int totals[4] = {};
  for (const auto& suite : document.child("testsuites").children("testsuite")) {
    int counts[4] = {};
    for (const auto& test : suite.children("testcase")) {
      ++counts[0];
      counts[1] += test.child("failure") ? 1 : 0;
      counts[2] += test.child("error") ? 1 : 0;
      counts[3] += test.child("skipped") ? 1 : 0;
    }
    const char* names[4] = {"tests", "failures", "errors", "skipped"};
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(suite.attribute(names[i]).as_int(-1), counts[i]) << names[i];
      totals[i] += counts[i];
    }
  }
  EXPECT_EQ(document.child("testsuites").attribute("tests").as_int(-1), totals[0]);
  EXPECT_EQ(document.child("testsuites").attribute("failures").as_int(-1), totals[1]);
  EXPECT_EQ(document.child("testsuites").attribute("errors").as_int(-1), totals[2]);
  EXPECT_EQ(document.child("testsuites").attribute("skipped").as_int(-1), totals[3]);
}

TEST(Junit, EachMaterialOfEachViewIsACaseAndSoIsEachWholeImage) {
  const auto document = parse(toJunit(makeSampleReport(), makeSampleRun()));
  expectCountsFit(document);
  EXPECT_EQ(document.child("testsuites").attribute("tests").as_int(), 2 * (7 + 1) + 1);
  for (const char* name :
       {"Glass", "Rough metal", "Shade, cloth", "Screw", "Bulb", "Rivet", "Lit panel", "(whole image)"}) {
    EXPECT_TRUE(findCase(document, "Lamp.front", name)) << name;
    EXPECT_TRUE(findCase(document, "Lamp.back", name)) << name;
  }
}

TEST(Junit, VerdictsBecomeFailuresErrorsAndSkips) {
  const auto document = parse(toJunit(makeSampleReport(), makeSampleRun()));
  EXPECT_FALSE(findCase(document, "Lamp.front", "Glass").first_child());

  const auto failure = findCase(document, "Lamp.front", "Rough metal").child("failure");
  EXPECT_STREQ(failure.attribute("message").value(),
               "mean FLIP 0.270 is above 0.200; 95th percentile of FLIP 0.675 is above 0.500");
  const std::string details = failure.child_value();
  EXPECT_NE(details.find("\n120000 pixels, flip.mean 0.270"), std::string::npos) << details;
  EXPECT_NE(
      details.find("cause: skySpecular (reflections of the environment): FLIP 0.270 -> 0.061 with the high-end term\n"),
      std::string::npos)
      << details;
  EXPECT_NE(details.find("mobile is 0.5 EV darker\n"), std::string::npos) << details;
  EXPECT_NE(details.find("note: fully rough\n"), std::string::npos) << details;

  const auto warned = findCase(document, "Lamp.front", "Shade, cloth");
  EXPECT_FALSE(warned.child("failure"));
  EXPECT_EQ(std::string(warned.child("system-out").child_value()).find("warning: mean FLIP 0.140"), 0u);

  EXPECT_STREQ(findCase(document, "Lamp.front", "Screw").child("skipped").attribute("message").value(),
               "not seen: no view shows it");
  EXPECT_STREQ(findCase(document, "Lamp.front", "Rivet").child("skipped").attribute("message").value(),
               "too small: 12 pixels, fewer than min_pixels = 64 of its budget");
  EXPECT_STREQ(findCase(document, "Lamp.front", "Lit panel").child("skipped").attribute("message").value(),
               "not judged: 1.0 % of the pixels are black in both pictures and 80.0 % are white; a lower --exposure "
               "shows more of them");
  EXPECT_STREQ(findCase(document, "Broken", "scene").child("error").attribute("message").value(),
               "assets/Broken.glb: chunk 0: length 4096 runs past the end of the file");
}

TEST(Junit, WarningsAreFailuresWhereTheyFailTheRun) {
  RunInfo run = makeSampleRun();
  run.warningsFail = true;
  Report report = makeSampleReport();
  report.warnings = {"a rule judges nothing"};
  const auto document = parse(toJunit(report, run));
  expectCountsFit(document);
  const auto warning = findCase(document, "Lamp.front", "Shade, cloth").child("failure");
  EXPECT_STREQ(warning.attribute("type").value(), "warning");
  EXPECT_EQ(std::string(warning.attribute("message").value()).find("mean FLIP 0.140"), 0u);
  for (const char* name : {"Screw", "Rivet", "Lit panel"}) // exit 1, too
    EXPECT_STREQ(findCase(document, "Lamp.front", name).child("failure").attribute("type").value(), "warning") << name;
  EXPECT_STREQ(findCase(document, "run", "warning 1").child("failure").attribute("message").value(),
               "a rule judges nothing");
  EXPECT_FALSE(findCase(document, "Lamp.front", "Glass").first_child());

  MaterialResult& elsewhere = report.scenes[0].views[0].materials[0];
  elsewhere.figures.pixels = 0;
  settleVerdicts(report);
  ASSERT_TRUE(elsewhere.seenElsewhere);
  EXPECT_TRUE(findCase(parse(toJunit(report, run)), "Lamp.front", "Glass").child("skipped")) << "another view shows it";
}

TEST(Junit, ClippingAndWhatADarkMaterialLeavesOpenAreToldBesideAFailure) {
  Report report = makeSampleReport();
  MaterialResult& metal = report.scenes[0].views[0].materials[1];
  metal.figures.clippedBlack = 0;
  metal.figures.clippedWhite = 0.6;
  metal.figures.referenceLuminance = metal.figures.testLuminance = 0.001;
  judgeMaterial(metal, compare::defaultBudgets(), "Lamp");
  const auto document = parse(toJunit(report, makeSampleRun()));
  const std::string details = findCase(document, "Lamp.front", "Rough metal").child("failure").child_value();
  EXPECT_NE(details.find("clipped: 60.0 % of the pixels are white in both pictures; lower --exposure\n"),
            std::string::npos)
      << details;
  EXPECT_NE(details.find("not judged: mean exposure difference -0.49 EV is not judged: mean luminance"),
            std::string::npos)
      << details;
}

TEST(Junit, AMaterialThatCannotBeJudgedIsAnError) {
  Report report = makeSampleReport();
  report.scenes[0].views[0].materials[0].checks.clear();
  settleVerdicts(report);
  const auto document = parse(toJunit(report, makeSampleRun()));
  expectCountsFit(document);
  EXPECT_STREQ(findCase(document, "Lamp.front", "Glass").child("error").attribute("message").value(),
               "no budget check applies");
}

TEST(Junit, AnEmptyReportIsAnError) {
  Report empty;
  settleVerdicts(empty);
  const auto document = parse(toJunit(empty, {}));
  expectCountsFit(document);
  EXPECT_EQ(document.child("testsuites").attribute("errors").as_int(), 1);
}

TEST(Junit, ABaselineIsASuiteOfItsOwn) {
  Report report = makeSampleReportSince();
  auto document = parse(toJunit(report, makeSampleRun()));
  expectCountsFit(document);
  EXPECT_FALSE(findCase(document, "baseline", "old/report.json").first_child());
  const std::string gone = "gone: material 'Old lamp', scene Lamp, view front: in the baseline, but not in this run";
  EXPECT_TRUE(findCase(document, "baseline", gone).child("system-out"));
  const std::string details = findCase(document, "Lamp.front", "Rough metal").child("failure").child_value();
  EXPECT_NE(details.find("baseline: fail, flip.mean +0.070"), std::string::npos) << details;

  const auto other = findCase(document, "Lamp.back", "Glass"); // the baseline's view had another camera
  const std::string said = other.child("system-out").child_value();
  EXPECT_NE(said.find("warning: not comparable to the baseline: field of view was 44, is 45"), std::string::npos)
      << said;
  EXPECT_NE(said.find("baseline: not comparable: field of view was 44, is 45\n"), std::string::npos) << said;

  report.baseline->error = "no material of this run is visible in the baseline";
  settleVerdicts(report);
  document = parse(toJunit(report, makeSampleRun()));
  expectCountsFit(document);
  EXPECT_STREQ(findCase(document, "baseline", "old/report.json").child("error").attribute("message").value(),
               "no material of this run is visible in the baseline");
}

TEST(Junit, HostileNamesAreOnlyEverNames) {
  const std::vector<std::string> names = hostileNames();
  const auto document = parse(toJunit(makeSampleReport(names), makeSampleRun()));
  expectCountsFit(document);
  EXPECT_EQ(document.child("testsuites").attribute("tests").as_int(), 17);
  EXPECT_TRUE(findCase(document, names[0] + ".front", names[1]));
  EXPECT_TRUE(findCase(document, names[0] + ".front", names[2]));
  EXPECT_TRUE(findCase(document, names[0] + ".front", names[4])); // its line break survives
  EXPECT_TRUE(findCase(document, names[0] + ".front", names[5])); // ]]>
  EXPECT_TRUE(findCase(document, names[0] + ".bell\uFFFD zero\uFFFD escape\uFFFD[31m", names[1]));
}

TEST(Junit, SaysHowLongAScenesTestsTookWhereTheRunKnows) {
  RunInfo run = makeSampleRun();
  EXPECT_EQ(toJunit(makeSampleReport(), run).find(" time="), std::string::npos);
  run.sceneTimes = {{"Lamp", 12.34567}, {"Sofa", 1}};
  const auto document = parse(toJunit(makeSampleReport(), run));
  const auto suites = document.child("testsuites");
  EXPECT_STREQ(suites.attribute("time").value(), "13.346");
  EXPECT_STREQ(suites.find_child_by_attribute("testsuite", "name", "Lamp").attribute("time").value(), "12.346");
  EXPECT_FALSE(suites.find_child_by_attribute("testsuite", "name", "Broken").attribute("time"));
}

TEST(Junit, IsTheSameInPieces) {
  std::string pieces;
  std::size_t count = 0;
  writeJunit(makeSampleReport(), makeSampleRun(), [&](std::string_view piece) { pieces += piece, ++count; });
  EXPECT_EQ(pieces, toJunit(makeSampleReport(), makeSampleRun()));
  EXPECT_GE(count, 4u) << "a scene at a time";
}

// XML 1.0, production 2: no control characters but tab, line feed, carriage return; pugixml lets others pass.
TEST(Junit, HoldsNoCharacterThatXmlForbids) {
  Report report = makeSampleReport(hostileNames());
  report.scenes[1].error = "control \x01 and \xEF\xBF\xBF noncharacter ]]>";
  report.scenes[0].views[0].materials[1].notes = {"\x02 ]]>"};
  report.device = "\x03\"<&";
  RunInfo run = makeSampleRun();
  run.startedAt = "\x04";
  const std::string xml = toJunit(report, run);
  for (const char c : xml) EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20 && c != '\n') << static_cast<int>(c);
  EXPECT_EQ(xml.find("]]>"), std::string::npos);
  EXPECT_EQ(xml.find("\xEF\xBF\xBF"), std::string::npos);
  parse(xml);
}

} // namespace
} // namespace parity::report
