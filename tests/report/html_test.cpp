// index.html, read back as XML (it is well-formed): what it shows by itself, its policy, its data, and names that try
// to become markup.
#include <nlohmann/json.hpp>

#include "report/dashboard_files.h"
#include "report/html_reader.h"
#include "report/overview.h"
#include "report/page.h"
#include "report/pixel_chunk.h"
#include "report/sample_report.h"
#include "report/scene_file.h"

namespace parity::report {
namespace {

using nlohmann::json;

const base::Image kGrey(2, 2, 3, 0.5f);

std::string overviewText(const Report& report) {
  std::string text;
  writeOverview(report, {}, [&](std::string_view piece) { text += piece; });
  return text;
}

// With every kind of file.
std::string page(const Report& report, bool singleFile = false, std::string_view bench = {}) {
  const EncodedPlane planes[] = {encodePlane({"highend", PlaneKind::rgb16f, &kGrey})};
  const std::vector<std::byte> picture = {std::byte{0}, std::byte{255}, std::byte{'<'}};
  const std::vector<std::byte> chunk = makeChunk("pixels/0-a_0-b.js", 2, 2, planes);
  const Bench sweep{std::string(bench), bench.empty() ? "" : "[[]]"};
  PageRequest request{.bench = sweep, .singleFile = singleFile, .files = {}};
  if (singleFile) request.files = {{"images/\"<a>.png", picture}, {"pixels/0-a_0-b.js", chunk}};
  return toHtml(report, makeSampleRun(), request);
}

TEST(Html, HostileNamesAddNoElementAndNoAttribute) {
  const std::vector<std::string> hostile = hostileNames(), harmless(hostile.size(), "harmless");
  for (const bool singleFile : {false, true})
    for (const auto make : {makeSampleReport, makeSampleReportWithTruth})
      EXPECT_EQ(outlineOf(parse(page(make(hostile), singleFile))), outlineOf(parse(page(make(harmless), singleFile))));
  for (const std::string& name : hostile)
    EXPECT_EQ(outlineOf(parse(page(makeSampleReportSince({}, name)))), outlineOf(parse(page(makeSampleReportSince()))));
}

TEST(Html, EveryTextOfAReportIsEscaped) {
  const auto poison = [&](const std::string& text) {
    Report report = makeSampleReport();
    report.tool = report.version = report.device = report.displayTable = text;
    report.settings = {{text, text}, {"truth", text}};
    report.warnings = {text};
    report.baseline = BaselineSummary{text, text, text, 1, {{text, text, text}}, text};
    for (SceneResult& scene : report.scenes) {
      scene.name = scene.source = scene.environment = scene.sun = scene.error = text;
      scene.warnings = {text};
      scene.passes = {{text, text, 0, text}};
      scene.materials = {makeCard(text, text)};
      for (ViewResult& view : scene.views) {
        view.name = view.reason = text;
        view.images = {text, text, text};
        view.pixels = {text, text};
        view.truth = compare::Truth{{}, {{text, 1, 2, 3, {}, {}}}, {text}, {text, text, text}};
        view.droppedLights = makeDroppedLights(text, text, text);
        view.rule = {text, text, text, false, 64, text, 1};
        for (MaterialResult& material : view.materials) {
          material.name = material.reason = text;
          material.rule = view.rule;
          material.notes = material.notModelled = {text};
          material.terms = {{text, 1, 2}};
          material.truth = view.truth;
          material.attribution = compare::Attribution{1, {{text, 2}}};
          material.crops = {text, text, text};
          material.whatIf = {makeWhatIf(text, 0.1)};
          material.whatIf[0].words = material.whatIf[0].reason = text;
          for (compare::CheckResult& check : material.checks) check.metric = check.note = check.unjudged = text;
        }
      }
    }
    return toHtml(report, RunInfo{text, text, {{text, 1}}, 1, {text}}, {.bench = {}, .files = {}});
  };
  const std::string evil = "</style></script><script>alert(1)</script>\"'><img src=x onerror=alert(1)>";
  const std::string html = poison(evil);
  EXPECT_EQ(outlineOf(parse(html)), outlineOf(parse(poison("x"))));
  for (const char* part : {"<script>", "<img", "onerror=alert(1)>"}) EXPECT_EQ(html.find(part), std::string::npos);
}

TEST(Html, AFolderPageHasNoScriptNorStyleOfItsOwn) {
  const auto document = parse(page(makeSampleReport(hostileNames()), false, "{}"));
  for (const auto& script : select(document, "//script"))
    EXPECT_TRUE(
        std::string(script.node().attribute("type").value()) == "application/json" ||
        (std::string(script.node().attribute("src").value()) == "dashboard.js" && script.node().text().empty()));
  EXPECT_EQ(select(document, "//script[@src and @defer]").size(), 1u);
  EXPECT_EQ(select(document, "//style").size() + select(document, "//@style").size(), 0u);
  EXPECT_EQ(select(document, "//@*[starts-with(name(),'on')]").size(), 0u);
  EXPECT_STREQ(select(document, "//link[@rel='stylesheet']/@href").at(0).attribute().value(), "dashboard.css");
  EXPECT_STREQ(
      select(document, "//meta[@http-equiv='Content-Security-Policy']/@content").at(0).attribute().value(),
      "default-src 'none'; script-src 'self' file:; style-src 'self' file:; img-src 'self' file: data: blob:; base-uri "
      "'none'; form-action 'none'");
  EXPECT_EQ(select(document, "//script[starts-with(@data-file,'scenes/')]").size(), 0u) << "they lie beside it";
  const std::string html = page(makeSampleReport());
  for (const char* word : {"http:", "https:", "url(", "@import", "src=\"//"})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
}

TEST(Html, TheDataBlocksAreTheReportWithoutItsScenesTheListOfItsRowsAndTheRun) {
  std::vector<std::string> names = hostileNames();
  names[3] = "line\xe2\x80\xa8paragraph\xe2\x80\xa9 \xe2\x80\xa7 \xe2";
  const Report report = makeSampleReport(names);
  const std::string bench = R"({"tool": "</script><b> & -->", "scenes": []})";
  const std::string html = page(report, false, bench);
  const auto document = parse(html);
  const std::string block = textAt(document, "//script[@id='report']");
  json head = json::parse(toJson(report));
  head.erase("scenes");
  EXPECT_EQ(json::parse(block), head);
  EXPECT_EQ(json::parse(textAt(document, "//script[@id='overview']")), json::parse(overviewText(report)));
  for (const char* part : {"<", ">", "&", "\xe2\x80\xa8", "\xe2\x80\xa9", "\n "})
    EXPECT_EQ(block.find(part), std::string::npos) << part;
  EXPECT_EQ(json::parse(textAt(document, "//script[@id='run']")), json::parse(headJson(makeSampleRun())));
  EXPECT_EQ(json::parse(textAt(document, "//script[@id='bench']")), json::parse(bench));
  EXPECT_EQ(textAt(document, "//script[@id='bench-plots']"), "[[]]");
  EXPECT_EQ(html.find("</script><b>"), std::string::npos);
  const auto without = parse(page(report));
  EXPECT_EQ(select(without, "//script[starts-with(@id,'bench')]").size(), 0u);
}

TEST(Html, ASingleFileHoldsScenesPicturesValuesScriptAndStyle) {
  const std::string html = page(makeSampleReport(), true);
  const auto document = parse(html);
  const json scenes = json::parse(toJson(makeSampleReport()))["scenes"];
  for (const std::size_t i : {0, 1}) {
    const std::string file = SceneFiles::nameOf(i);
    const json scene = json::parse(textAt(document, ("//script[@data-file='" + file + "']").c_str()));
    EXPECT_EQ(scene, (json{{"file", file}, {"format", 1}, {"scene", scenes[i]}, {"again", json::array()}}));
  }
  EXPECT_EQ(textAt(document, "//script[@type='text/plain'][@data-file='images/\"<a>.png']"), "AP88");
  const json chunk =
      json::parse(textAt(document, "//script[@type='application/json'][@data-file='pixels/0-a_0-b.js']"));
  EXPECT_EQ(chunk["file"], "pixels/0-a_0-b.js");
  EXPECT_EQ(chunk["planes"][0]["data"], encodePlane({"highend", PlaneKind::rgb16f, &kGrey}).data);
  EXPECT_NE(html.find("<style>" + std::string(dashboardStyle().text) + "</style>"), std::string::npos);
  EXPECT_NE(html.find("<script>" + std::string(dashboardScript().text) + "</script>"), std::string::npos);
  EXPECT_EQ(select(document, "//@src").size(), 0u);
  EXPECT_EQ(select(document, "//@href[. != 'data:,']").size(), 0u);
  const std::string policy =
      select(document, "//meta[@http-equiv='Content-Security-Policy']/@content").at(0).attribute().value();
  for (const char* word : {"unsafe", "self", "file:", "http"}) EXPECT_EQ(policy.find(word), std::string::npos) << word;
}

TEST(Html, ASceneHasItsCommandsAndNoTime) {
  const Report report = makeSampleReport();
  RunInfo run = makeSampleRun();
  run.again = {{"Lamp", "front", "parity diff 'a'"}, {"Other", "front", "b"}, {"Lamp", "behind", "c"}};
  run.sceneTimes = {{"Other", 1}, {"Lamp", 2.5}};
  const SceneFiles files(report, run, nullptr);
  const std::string script = files.script(0);
  EXPECT_EQ(script, "parityScene(" + files.object(0) + ");\n");
  const json lamp = json::parse(files.object(0)), broken = json::parse(files.object(1));
  EXPECT_FALSE(lamp.contains("seconds"));
  EXPECT_EQ(lamp["again"], json::parse(toJson(run))["again"].patch(json::parse(R"([{"op": "remove", "path": "/1"}])")));
  EXPECT_EQ(broken["again"], json::array());
  EXPECT_EQ(broken["file"], "scenes/1.js");
  const json head = json::parse(headJson(run));
  EXPECT_FALSE(head.contains("again"));
  EXPECT_EQ(head["sceneTimes"].size(), 2u);
  EXPECT_EQ(head["startedAt"], run.startedAt);
}

TEST(Html, WithoutScriptsItShowsTheVerdictAndWhatIsOverBudget) {
  const Report report = makeSampleReport();
  const auto document = parse(page(report));
  EXPECT_EQ(textAt(document, "//title"), "parity: " + headline(report));
  EXPECT_EQ(textAt(document, "//main[@id='app']/header/h1"), headline(report));
  EXPECT_EQ(textAt(document, "//main[@id='app']/header/p[@class='badge error']"), "error");
  EXPECT_NE(textAt(document, "//main/noscript/p").find("report.json"), std::string::npos);
  std::vector<std::string> rows;
  for (const auto& row : select(document, "//noscript//tbody/tr")) {
    rows.emplace_back();
    for (const auto& cell : row.node().children("td")) rows.back() += std::string(cell.text().get()) + "|";
  }
  ASSERT_EQ(rows.size(), 3u) << "a material in two views, a scene";
  EXPECT_EQ(
      rows.at(0),
      "fail|Lamp|front|Rough metal|mean FLIP 0.270 is above 0.200; 95th percentile of FLIP 0.675 is above 0.500|");
  EXPECT_EQ(rows.back().substr(0, 15), "error|Broken|||");
}

TEST(Html, TheTableOfWhatIsOverBudgetIsShort) {
  Report report = makeSampleReport();
  report.scenes.resize(1);
  ViewResult& view = report.scenes[0].views[0];
  view.materials.assign(120, view.materials[1]);
  for (MaterialResult& material : view.materials) material.verdict = compare::Verdict::fail;
  view.wholeVerdict = compare::Verdict::pass;
  report.scenes[0].views.resize(1);
  const auto document = parse(page(report));
  EXPECT_EQ(select(document, "//noscript//tbody/tr").size(), 50u);
  EXPECT_EQ(textAt(document, "//noscript/p[2]"), "and 70 more");
}

TEST(Html, AReportOfNothingIsAPage) {
  Report report;
  settleVerdicts(report);
  for (const bool singleFile : {false, true}) {
    const auto document = parse(page(report, singleFile));
    EXPECT_EQ(textAt(document, "//h1"), "Nothing was compared");
    EXPECT_EQ(select(document, "//noscript/table").size(), 0u);
  }
}

TEST(Html, TheHeadlineSaysWhatHappened) {
  const auto headline = [](const Report& report) {
    const auto document = parse(page(report));
    return textAt(document, "//title");
  };
  Report report = makeSampleReport();
  EXPECT_EQ(headline(report), "parity: 1 scene could not be compared; 2 of 13 material views over budget");
  report.scenes.pop_back();
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "parity: 2 of 13 material views over budget");
  report.scenes[0].views.pop_back();
  report.scenes[0].views[0].materials.erase(report.scenes[0].views[0].materials.begin() + 1);
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "parity: Within budget, with warnings for 1 of 6 materials");
  report.scenes[0].views[0].materials.erase(report.scenes[0].views[0].materials.begin() + 1);
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "parity: Within budget, but 1 of 5 materials not judged");
  report.scenes[0].views[0].materials.pop_back();
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "parity: Within budget, but 1 of 4 materials too small");
  report.scenes[0].views[0].materials.pop_back();
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

} // namespace
} // namespace parity::report
