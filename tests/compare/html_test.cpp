// index.html, read back as XML (it is well-formed): structure, order, policy, and names that try to become markup.
#include <algorithm>
#include <cmath>

#include "compare/html_reader.h"
#include "compare/report.h"
#include "compare/sample_report.h"

namespace parity::compare {
namespace {

std::string page(const Report& report) { return toHtml(report, makeSampleRun()); }

TEST(Html, HostileNamesAddNoElementAndNoAttribute) {
  const std::vector<std::string> hostile = hostileNames(), harmless(hostile.size(), "harmless");
  EXPECT_EQ(outlineOf(parse(page(makeSampleReport(hostile)))), outlineOf(parse(page(makeSampleReport(harmless)))));
  EXPECT_EQ(outlineOf(parse(page(makeSampleReportWithTruth(hostile)))),
            outlineOf(parse(page(makeSampleReportWithTruth(harmless)))));
}

TEST(Html, EveryTextOfAReportIsEscaped) {
  const std::string evil = "</style></script><script>alert(1)</script>\"'><img src=x onerror=alert(1)>";
  bool withTruth = false;
  const auto poison = [&](Report report, RunInfo run, const std::string& text) {
    report.tool = report.version = report.device = text;
    report.settings = {{text, text}, {"truth", text}};
    report.warnings = {text};
    report.baseline = BaselineSummary{text, text, text, 1, {{text, text, text}}, text};
    run = {text, text, {{text, 1}}, 1, {text}};
    for (SceneResult& scene : report.scenes) {
      scene.name = scene.source = scene.environment = scene.sun = scene.error = text;
      scene.warnings = {text};
      scene.passes = {{text, text, 0, text}};
      for (ViewResult& view : scene.views) {
        view.name = view.reason = text;
        view.images = {text, text, text};
        view.truth = Truth{{}, {}, {{text, 1, 2, 3, {}, {}}}, {text}, {text, text, text}};
        view.rule = {text, text, text, false, text, 1};
        for (MaterialResult& material : view.materials) {
          material.name = material.reason = text;
          material.rule = {text, text, text, false, text, 1};
          material.notes = {text};
          material.terms = {{text, 1, 2}};
          if (withTruth) material.truth = view.truth;
          material.crops = {text, text, text};
          for (CheckResult& check : material.checks) check.metric = check.region = check.note = check.unjudged = text;
        }
      }
    }
    return toHtml(report, run);
  };
  for (int round = 0; round < 2; ++round, withTruth = true)
    EXPECT_EQ(outlineOf(parse(poison(makeSampleReport(), {}, evil))),
              outlineOf(parse(poison(makeSampleReport(), {}, "x"))));
  const std::string html = poison(makeSampleReport(), {}, evil);
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("onerror=alert(1)>"), std::string::npos);
  EXPECT_EQ(html.find("<script>", html.find("<script>") + 1), std::string::npos) << "there is exactly one script";
}

TEST(Html, NamesAreShownAsTheyAre) {
  const std::vector<std::string> names = hostileNames();
  const auto document = parse(page(makeSampleReport(names)));
  std::vector<std::string> shown;
  for (const auto& node : select(document, "//article/div/h4/bdi")) shown.push_back(node.node().child_value());
  for (const std::size_t i : {1, 2, 3, 4, 5}) EXPECT_NE(std::ranges::find(shown, names[i]), shown.end()) << names[i];
}

TEST(Html, ImagePathsBecomeRelativeUrlsWithoutScheme) {
  Report report = makeSampleReport();
  report.scenes[0].views[0].images = {"javascript:alert(1)", "//example.org/x.png", "images/a b\"#?%&'é.png"};
  const auto document = parse(page(report));
  const auto links = select(document, "//a[@class='shot']");
  ASSERT_GE(links.size(), 3u);
  EXPECT_STREQ(links[0].node().attribute("href").value(), "javascript%3Aalert%281%29");
  EXPECT_STREQ(links[1].node().attribute("href").value(), ".//example.org/x.png");
  EXPECT_STREQ(links[2].node().attribute("href").value(), "images/a%20b%22%23%3F%25%26%27%C3%A9.png");
  for (const auto& link : links) {
    EXPECT_STREQ(link.node().attribute("href").value(), link.node().child("img").attribute("src").value());
    EXPECT_STREQ(link.node().child("img").attribute("loading").value(), "lazy");
    EXPECT_STRNE(link.node().child("img").attribute("alt").value(), "");
  }
}

TEST(Html, NeedsNoNetworkAndForbidsIt) {
  const std::string html = page(makeSampleReport());
  for (const char* word : {"http:", "https:", "url(", "@import", "src=\"//"})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  const auto document = parse(html);
  const auto policy = select(document, "//meta[@http-equiv='Content-Security-Policy']");
  ASSERT_EQ(policy.size(), 1u);
  const std::string content = policy[0].node().attribute("content").value();
  EXPECT_EQ(
      content.find(
          "default-src 'none'; img-src 'self' data: file:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"),
      0u);
}

TEST(Html, TheWorstMaterialComesFirst) {
  const auto document = parse(page(makeSampleReport()));
  std::vector<std::string> names;
  for (const auto& row : select(document, "//section[@id='scene-1-view-1']//article"))
    names.push_back(row.node().attribute("data-name").value());
  const std::vector<std::string> expected = {"Rough metal", "Shade, cloth", "Screw", "Glass", "Bulb"};
  EXPECT_EQ(names, expected);
}

TEST(Html, EachRowHasItsVerdictInWordsImagesAndNumbers) {
  const auto document = parse(page(makeSampleReport()));
  const auto rows = select(document, "//article[@data-name='Rough metal']");
  ASSERT_EQ(rows.size(), 2u);
  const pugi::xml_node row = rows[0].node();
  const auto textOf = [&](const char* path) { return std::string(row.select_node(path).node().text().get()); };
  EXPECT_NE(row.select_node(".//span[contains(@class,'badge') and contains(.,'fail')]").node(), pugi::xml_node());
  EXPECT_EQ(textOf(".//p[@class='reason']"), "mean FLIP 0.270 over interior pixels is above 0.200 (and 1 more)");
  EXPECT_EQ(textOf(".//p[@class='light']"), "mobile is 29.0 % darker");
  EXPECT_EQ(row.select_nodes(".//img").size(), 3u);
  EXPECT_EQ(row.select_nodes(".//div[starts-with(@class,'check ')]").size(), 2u);
  EXPECT_EQ(row.select_nodes(".//ul[@class='notes']/li").size(), 2u);
  EXPECT_EQ(row.select_nodes(".//details[@class='terms']//tbody/tr").size(), 3u);
  std::vector<std::string> cells;
  for (const auto& cell : row.select_nodes("./div[@class='numbers']/table/tbody/tr[position()=1 or position()=9]/td"))
    cells.push_back(cell.node().text().get());
  const std::vector<std::string> expected = {"0.270", "0.297", "90000", "120000"};
  EXPECT_EQ(cells, expected);
}

TEST(Html, BarsStayWithinTheirTrack) {
  Report report = makeSampleReport();
  for (MaterialResult& material : report.scenes[0].views[0].materials)
    for (CheckResult& check : material.checks) {
      check.value = material.name == "Glass" ? INFINITY : material.name == "Bulb" ? NAN : 1e9;
      if (material.name == "Bulb") check.warnAbove = check.failAbove = 0;
    }
  const auto document = parse(page(report));
  for (const auto& part : select(document, "//div[@class='bar']/i")) {
    const std::string style = part.node().attribute("style").value();
    const double percent = std::stod(style.substr(style.find(':') + 1));
    EXPECT_GE(percent, 0) << style;
    EXPECT_LE(percent, 100) << style;
  }
}

TEST(Html, WhatIsNotSeenSaysSoAndShowsNoFigures) {
  const auto document = parse(page(makeSampleReport()));
  const auto rows = select(document, "//article[@data-name='Screw']");
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows[0].node().select_nodes(".//img").size(), 0u);
  EXPECT_EQ(rows[0].node().select_nodes(".//table").size(), 0u);
  EXPECT_STREQ(rows[0].node().select_node(".//p[@class='unseen']").node().text().get(),
               "No pixel of this view shows it.");
}

TEST(Html, TheHeadlineSaysWhatHappened) {
  const auto headline = [](const Report& report) {
    const auto document = parse(page(report));
    return std::string(select(document, "//title").at(0).node().text().get());
  };
  Report report = makeSampleReport();
  EXPECT_EQ(headline(report), "parity: 1 scene could not be compared; 2 of 9 material views over budget");
  report.scenes.pop_back();
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "parity: 2 of 9 material views over budget");
  report.scenes[0].views.pop_back();
  report.scenes[0].views[0].materials.erase(report.scenes[0].views[0].materials.begin() + 1);
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "parity: Within budget, with warnings for 1 of 4 materials");
  report.scenes[0].views[0].materials.erase(report.scenes[0].views[0].materials.begin() + 1);
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "parity: Within budget, but 1 of 3 materials not seen");
  report.scenes[0].views[0].materials.erase(report.scenes[0].views[0].materials.begin() + 1);
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "parity: All 2 materials are within budget");
  Report since = report;
  since.baseline = BaselineSummary{};
  since.baseline->gone = {{"s", "v", "m"}};
  settleVerdicts(since);
  EXPECT_EQ(headline(since), "parity: Within budget, but 1 entry of the baseline is missing");
  since.baseline->gone.push_back({"s", "v", "n"});
  EXPECT_EQ(headline(since), "parity: Within budget, but 2 entries of the baseline are missing");
  report.scenes.clear();
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "parity: Nothing was compared");
}

TEST(Html, ABaselineShowsWhatChangedWhatIsNewAndWhatIsGone) {
  const auto document = parse(page(makeSampleReportSince()));
  const auto textOf = [&](const std::string& path) {
    const auto found = select(document, path.c_str());
    return found.empty() ? "nothing at " + path : std::string(found[0].node().text().get());
  };
  EXPECT_EQ(textOf("//section[@class='since']//ul[@class='warnings']/li"),
            "gone: material 'Old lamp', scene Lamp, view front: the baseline has it, this run does not");
  EXPECT_EQ(select(document, "//section[@class='since']//ul[@class='changes']/li").size(), 1u) << "only one changed";
  EXPECT_EQ(textOf("//section[@class='since']//ul[@class='changes']/li"),
            "Rough metal (scene Lamp, view front): 0.200 to 0.270, +0.070");
  EXPECT_EQ(textOf("//section[@class='since']//dd[1]"), "old/report.json");
  EXPECT_NE(textOf("//main/ul[@class='warnings']/li").find("size was '512x512', is '1024x1024'"), std::string::npos);
  const std::string metal = "//section[@id='scene-1-view-1']//article[@data-name='Rough metal']";
  EXPECT_EQ(textOf(metal + "//table[@class='figures']/thead//th[4]"), "since then");
  EXPECT_EQ(textOf(metal + "/div[@class='numbers']/table/tbody/tr[1]/td[3]"), "+0.070");
  EXPECT_EQ(select(document, (metal + "[@data-change='0.070000']").c_str()).size(), 1u);
  EXPECT_EQ(textOf("//article[@data-name='Bulb']//p[@class='baseline']/b"), "New");
  EXPECT_EQ(select(document, "//select[@id='sort']/option[@value='change']").size(), 1u);
  EXPECT_EQ(select(document, "//article[@data-name='Bulb']//div[@class='check not-seen']").size(), 1u)
      << "what is not judged does not look as if it had passed";
}

TEST(Html, TheLargestChangesSinceTheBaselineComeFirstAndNotAll) {
  Report report = makeSampleReport();
  ViewResult& view = report.scenes[0].views[0];
  const MaterialResult sample = view.materials[0];
  view.materials.clear();
  for (int i = -7; i <= 7; ++i) {
    view.materials.push_back(sample);
    view.materials.back().name = "m" + std::to_string(i);
    view.materials.back().baseline = BaselineChange{};
    view.materials.back().baseline->interior = {{"flip.mean", 0.3, 0.3 + 0.01 * i}};
  }
  report.baseline = BaselineSummary{};
  const auto document = parse(page(report));
  std::vector<std::string> names;
  for (const auto& line : select(document, "//ul[@class='changes']/li")) {
    const std::string text = line.node().text().get();
    names.push_back(text.substr(0, text.find(' ')));
  }
  const std::vector<std::string> expected = {"m7", "m6", "m5", "m4", "m3", "m-7", "m-6", "m-5", "m-4", "m-3"};
  EXPECT_EQ(names, expected);
  EXPECT_STREQ(select(document, "//section[@class='since']/h3")[1].node().text().get(),
               "Better by mean FLIP: 7, the 5 largest");
}

TEST(Html, AnUnmeasuredFlipIsNotShownAsZero) {
  Report report = makeSampleReport();
  for (ViewResult& view : report.scenes[0].views) {
    std::erase_if(view.whole.all.values, [](const Figure& f) { return f.name == "flip.mean"; });
    for (MaterialResult& material : view.materials)
      for (Figures* figures : {&material.figures.all, &material.figures.interior})
        std::erase_if(figures->values, [](const Figure& f) { return f.name == "flip.mean"; });
  }
  const auto document = parse(page(report));
  const auto cells = select(document, "//table[@class='overview']/tbody/tr[td[3]='front' or td[3]='back']/td[6]");
  ASSERT_EQ(cells.size(), 2u);
  for (const auto& cell : cells) EXPECT_STREQ(cell.node().text().get(), "–");
  for (const auto& row : select(document, "//article")) EXPECT_STREQ(row.node().attribute("data-mean").value(), "");
}

TEST(Html, HostileNamesOfABaselineAddNothing) {
  const std::string harmless = outlineOf(parse(page(makeSampleReportSince())));
  for (const std::string& name : hostileNames())
    EXPECT_TRUE(outlineOf(parse(page(makeSampleReportSince({}, name)))) == harmless) << name;
}

TEST(Html, ErrorsAndWarningsOfScenesAreShown) {
  const std::string html = page(makeSampleReport());
  EXPECT_NE(html.find("<b>Not compared:</b> assets/Broken.glb: chunk 0"), std::string::npos);
  EXPECT_NE(html.find("<li>KHR_materials_transmission is not supported: drawn opaque</li>"), std::string::npos);
}

} // namespace
} // namespace parity::compare
