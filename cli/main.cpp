// parity: one line of error and the exit code of docs/design.md 8a, whatever happens.
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/text/error_words.h"
#include "base/text/shell_word.h"
#include "base/text/shown_text.h"
#include "cli/invocation.h"
#include "cli/output.h"

namespace {

// As a shell would take it again, program name without its folder: for run.json.
std::string joinCommandLine(int argc, char** argv) {
  std::string line = "parity";
  for (int i = 1; i < argc; ++i) line += ' ' + parity::base::shellWord(argv[i]);
  return line;
}

template <typename... F> struct Overloaded : F... { using F::operator()...; };

int run(int argc, char** argv) {
  using namespace parity::cli;
  const Parsed parsed = parseCommandLine(argc, argv);
  if (!parsed.command) {
    if (parsed.exitCode == 0)
      printText(parsed.text);
    else
      std::fputs(parity::base::shownText(parsed.text).c_str(), stderr);
    return parsed.exitCode;
  }
  const std::string line = joinCommandLine(argc, argv);
  parity::base::setInterruptNote(std::string(argv[1]) +
                                 ": interrupted: no output was written; the cache keeps its entries");
  return std::visit(Overloaded{[&](const ReportCommand& c) { return runReportCommand(c, line); },
                               [&](const PlanCommand& c) { return runPlanCommand(c, line); },
                               [](const WorkCommand& c) { return runWorkCommand(c); },
                               [](const MergeCommand& c) { return runMergeCommand(c); },
                               [&](const DiffCommand& c) { return runDiffCommand(c, line); },
                               [](const RenderCommand& c) { return runRenderCommand(c); },
                               [](const ListTermsCommand&) { return runListTermsCommand(); },
                               [](const ContractCommand& c) { return runContractCommand(c); },
                               [](const CalibrateCommand& c) { return runCalibrateCommand(c); },
                               [](const FlipCommand& c) { return runFlipCommand(c); },
                               [](const ApproveCommand& c) { return runApproveCommand(c); },
                               [](const BudgetSuggestCommand& c) { return runBudgetSuggestCommand(c); },
                               [](const BudgetCheckCommand& c) { return runBudgetCheckCommand(c); },
                               [](const FitCommand& c) { return runFitCommand(c); },
                               [&](const BenchCommand& c) { return runBenchCommand(c, line); },
                               [&](const ExplainCommand& c) { return runExplainCommand(c, line); },
                               [&](const WorstCommand& c) { return runWorstCommand(c, line); },
                               [](const PresetNewCommand& c) { return runPresetNewCommand(c); },
                               [](const PresetFunctionsCommand&) { return runPresetFunctionsCommand(); },
                               [](const StudyPresetCommand& c) { return runStudyPresetCommand(c); },
                               [](const StressCommand& c) { return runStressCommand(c); },
                               [](const BakeCommand& c) { return runBakeCommand(c); },
                               [](const DevicesCommand& c) { return runDevicesCommand(c); },
                               [](const InfoCommand& c) { return runInfoCommand(c); },
                               [](const ExportCommand& c) { return runExportCommand(c); },
                               [](const CacheCommand& c) { return runCacheCommand(c); },
                               [](const SuiteListCommand& c) { return runSuiteListCommand(c); },
                               [](const PlotCommand& c) { return runPlotCommand(c); },
                               [](const KnobsCommand&) { return runKnobsCommand(); },
                               [](const VersionCommand&) { return runVersionCommand(); },
                               [](const GuideCommand& c) { return runGuideCommand(c); },
                               [](const HistoryCommand& c) { return runHistoryCommand(c); }},
                    *parsed.command);
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN); // a closed pager is not a crash
  try {
    const int exitCode = run(argc, argv);
    parity::cli::finishStdout();
    return exitCode;
  } catch (const parity::base::Error& error) {
    parity::base::logError(error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    parity::base::logError("parity: out of memory; lower --size or --max-memory");
    return static_cast<int>(parity::base::ExitCode::failed);
  } catch (const std::exception& error) {
    parity::base::logError((argc > 1 ? std::string(argv[1]) : "parity") + ": " + parity::base::wordsOf(error));
    return static_cast<int>(parity::base::ExitCode::failed);
  }
}
