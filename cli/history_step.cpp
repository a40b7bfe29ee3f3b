// parity history step: a commit judged for git bisect.
#include <exception>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <sys/stat.h>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/process.h"
#include "base/text/error_words.h"
#include "base/text/text.h"
#include "cli/history_parts.h"
#include "cli/output.h"
#include "history/step.h"
#include "report/reader.h"

namespace parity::cli {

namespace {

// What tells a file from another one of its name.
std::optional<std::pair<ino_t, long>> identityOf(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  constexpr long kNanoseconds = 1'000'000'000;
  return std::pair(status.st_ino, status.st_mtim.tv_sec * kNanoseconds + status.st_mtim.tv_nsec);
}

// Nothing where the command has made the report; else why not. A report that was there before is of another commit.
std::string makeReport(const HistoryStepCommand& command) {
  std::vector<std::string> words = command.command;
  const std::optional<std::string> program = base::findProgram(words.front());
  if (!program) return words.front() + ": is no program";
  words.front() = *program;
  const std::filesystem::path file = report::reportFileOf(command.report);
  const auto before = identityOf(file);
  const base::ProcessEnd end = base::runInForeground(words);
  if (end.signal != 0) return fmt::format("{}: {} ended it", words.front(), base::signalName(end.signal));
  const auto now = identityOf(report::reportFileOf(command.report));
  if (!now || now == before)
    return fmt::format("{}: ended with {} and wrote no {}", words.front(), end.exitCode, file.string());
  return {};
}

// Of git bisect: any other code up to 127 means bad.
constexpr int kGood = 0, kBad = 1, kSkip = 125;

} // namespace

int stepHistory(const HistoryStepCommand& command) {
  try {
    if (!command.command.empty())
      if (const std::string why = makeReport(command); !why.empty()) {
        base::logError("skip: " + why);
        return kSkip;
      }
    const history::StepVerdict verdict =
        history::judgeStep(report::readReport(command.report), command.limits, command.choice);
    print("{}: {}\n",
          verdict.kind == history::StepVerdict::good  ? "good"
          : verdict.kind == history::StepVerdict::bad ? "bad"
                                                      : "skip",
          base::plainLine(verdict.reason));
    return verdict.kind == history::StepVerdict::good  ? kGood
           : verdict.kind == history::StepVerdict::bad ? kBad
                                                       : kSkip;
  } catch (const std::exception& error) { // any other exit code names a commit
    base::logError("skip: " + base::wordsOf(error));
    return kSkip;
  }
}

} // namespace parity::cli
