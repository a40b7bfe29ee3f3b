// Messages: which level lets which through, and that they go to stderr only.
#include "base/log.h"

#include <gtest/gtest.h>

namespace parity::base {
namespace {

struct Output {
  std::string out, err;
};

Output logAll(LogLevel level) {
  setLogLevel(level);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  logDetail("detail");
  logInfo("news");
  logWarning("odd {}");
  logError("broken %s");
  Output output{testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
  setLogLevel(LogLevel::normal);
  return output;
}

TEST(Log, WritesWhatTheLevelLetsThrough) {
  EXPECT_EQ(logAll(LogLevel::quiet).err, "error: broken %s\n");
  EXPECT_EQ(logAll(LogLevel::normal).err, "news\nwarning: odd {}\nerror: broken %s\n");
  EXPECT_EQ(logAll(LogLevel::verbose).err, "detail\nnews\nwarning: odd {}\nerror: broken %s\n");
}

TEST(Log, WarningsOfARunAreOneLineWithQuiet) {
  const auto logRun = [](LogLevel level) {
    setLogLevel(level);
    testing::internal::CaptureStderr();
    logRunWarnings({"one", "two"});
    logRunWarnings({});
    setLogLevel(LogLevel::normal);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(logRun(LogLevel::quiet), "warning: one; two\n");
  EXPECT_EQ(logRun(LogLevel::normal), "warning: one\nwarning: two\n");
}

TEST(Log, LeavesStdoutToTheResults) { EXPECT_EQ(logAll(LogLevel::verbose).out, ""); }

} // namespace
} // namespace parity::base
