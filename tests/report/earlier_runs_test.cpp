// A history beside a report: what the page, the exit code and the counts take from it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "report/earlier_runs.h"
#include "report/page.h"
#include "report/sample_report.h"
#include "report/scene_file.h"

namespace parity::report {
namespace {

using nlohmann::json;

// Of which all failures are known for three runs, but those of one material.
class FakeRuns : public EarlierRuns {
public:
  explicit FakeRuns(std::string fresh, bool isEmpty = false) : m_fresh(std::move(fresh)), m_isEmpty(isEmpty) {}
  bool knowsAny() const override { return !m_isEmpty; }
  RowStanding standingOf(const SceneResult&, const ViewResult& view, const MaterialResult* material) const override {
    if (!isFailure(material ? material->verdict : view.wholeVerdict)) return {};
    if (material && material->name == m_fresh) return {Standing::isNew, 1, "me"};
    return {material ? Standing::flaky : Standing::still, 3, ""};
  }
  std::string runsJson() const override { return R"({"format":1,"runs":[]})"; }
  std::string trendsJson(const SceneResult& scene) const override { return json{{"of", scene.name}}.dump(); }
  std::vector<ApprovedPicture> approvedPictures() const override { return {}; }

private:
  std::string m_fresh;
  bool m_isEmpty;
};

std::string failingMaterial(const Report& report) {
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views)
      for (const MaterialResult& material : view.materials)
        if (material.verdict == compare::Verdict::fail) return material.name;
  return {};
}

// Without errors, which count whatever is known of earlier runs.
Report makeReport() {
  Report report = makeSampleReport();
  std::erase_if(report.scenes, [](const SceneResult& scene) { return scene.verdict == compare::Verdict::error; });
  settleVerdicts(report);
  return report;
}

TEST(EarlierRuns, SayWhichFailuresCount) {
  const Report report = makeReport();
  const std::string fresh = failingMaterial(report);
  ASSERT_FALSE(fresh.empty());
  const FakeRuns all(""), one(fresh), none(fresh, true);
  EXPECT_EQ(countFailures(report, standingBy(&all)).isNew, 0u);
  EXPECT_GT(countFailures(report, standingBy(&all)).still, 0u) << "flaky ones are no new ones";
  EXPECT_GE(countFailures(report, standingBy(&one)).isNew, 1u);
  EXPECT_EQ(whyNewIsUnknown(report, &all), "");
  EXPECT_NE(whyNewIsUnknown(report, &none), "") << "no run, and no baseline";
  EXPECT_EQ(exitCode(report, false, FailOn::isNew, &all), 0);
  EXPECT_EQ(exitCode(report, false, FailOn::isNew, &one), 2);
  EXPECT_EQ(exitCode(report, false, FailOn::isNew, &none), 4);
  EXPECT_EQ(exitCode(report, false, FailOn::any, &all), 2);
}

TEST(EarlierRuns, StandInThePage) {
  const Report report = makeReport();
  const RunInfo run = makeSampleRun();
  const std::string fresh = failingMaterial(report);
  const FakeRuns runs(fresh), none(fresh, true);
  const Bench bench;
  PageRequest request{.bench = bench, .singleFile = false, .files = {}, .earlier = &runs};
  const std::string page = toHtml(report, run, request);
  EXPECT_NE(page.find("id=\"history\">{\"format\":1,\"runs\":[]}</script>"), std::string::npos);
  const std::string begin = "id=\"overview\">";
  const std::size_t at = page.find(begin) + begin.size();
  const json overview = json::parse(page.substr(at, page.find("</script>", at) - at));
  for (const char* column : {"standing", "nights", "owner"})
    EXPECT_TRUE(overview["rows"]["columns"].contains(column)) << column;
  const json& texts = overview["texts"];
  EXPECT_NE(std::ranges::find(texts, "me"), texts.end()) << "the owner";
  EXPECT_NE(SceneFiles(report, run, &runs).script(0).find(R"("history":{"of":")" + report.scenes[0].name + "\"}"),
            std::string::npos);
  request.earlier = &none;
  EXPECT_EQ(toHtml(report, run, request).find("id=\"history\""), std::string::npos);
  EXPECT_EQ(SceneFiles(report, run, &none).script(0).find("\"history\""), std::string::npos);
  request.earlier = nullptr;
  EXPECT_EQ(toHtml(report, run, request).find("id=\"history\""), std::string::npos);
}

} // namespace
} // namespace parity::report
