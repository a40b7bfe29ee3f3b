// What the end of a run says of its scenes.
#include "job/report_end.h"

#include <csignal>

#include <gtest/gtest.h>

#include "job/context.h"

namespace parity::job {
namespace {

ComparedScene failedScene(const SceneRequest& request) {
  ComparedScene scene;
  scene.result.name = request.name;
  scene.error = scene.result.error = request.name + ": cannot be read";
  return scene;
}

// Two threads begin scenes in another order than they stand: one that is done may stand behind one that was not begun.
TEST(ReportEnd, SaysWhatIsWrongWithAFinishedSceneBehindOneThatWasNotRun) {
  Context context(Settings{});
  context.stopWhen([] { return SIGINT; });
  ReportRequest request;
  request.scenes.resize(3);
  for (std::size_t i = 0; i < 3; ++i) request.scenes[i].name = "scene" + std::to_string(i);
  RunBudgets budgets(std::nullopt, std::nullopt);
  ReportEnd end(request, budgets, RunFacts{});
  testing::internal::CaptureStderr();
  end.add(2, failedScene(request.scenes[2]));
  end.add(0, failedScene(request.scenes[0]));
  const ReportResult result = end.finish(context, {}, {});
  const std::string text = testing::internal::GetCapturedStderr();
  const std::size_t first = text.find("error: scene0: cannot be read"),
                    last = text.find("error: scene2: cannot be read");
  ASSERT_NE(first, std::string::npos) << text;
  ASSERT_NE(last, std::string::npos) << text;
  EXPECT_LT(first, last);
  EXPECT_EQ(text.find("error: scene0", first + 1), std::string::npos) << "once: " << text;
  ASSERT_EQ(result.report.scenes.size(), 3u);
  EXPECT_TRUE(report::isNotRun(result.report.scenes[1]));
}

} // namespace
} // namespace parity::job
