// The table for a terminal: the rows that matter, totals by cause, what is wrong with the run, a line that sums up.
#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "base/text/text.h"
#include "base/text/wrap.h"
#include "compare/verdict/wording.h"
#include "report/again.h"
#include "report/causes.h"
#include "report/report.h"
#include "report/table_rows.h"
#include "report/wording.h"

namespace parity::report {
namespace {

// Names of the paths, the one first that the others are compared with.
std::vector<std::string> pathsOf(const Report& report) {
  std::vector<std::string> paths;
  const auto add = [&](const ViewResult& view) {
    for (const std::string& path : {view.reference, view.test})
      if (std::ranges::count(paths, path) == 0) paths.push_back(path);
  };
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) add(view);
  if (paths.empty()) add({});
  return paths;
}

std::string summary(const Report& report) {
  const VerdictCounts materials = countVerdicts(report), wholes = countWholes(report);
  std::string text =
      materials.total() + wholes.total() == 0
          ? "nothing was compared"
          : fmt::format("materials: {}; whole images: {}", formatCounts(materials), formatCounts(wholes));
  const auto [acceptedMaterials, acceptedWholes] = countAccepted(report);
  if (acceptedMaterials + acceptedWholes > 0)
    text += fmt::format("; of these pass by accepted exceptions: {}", acceptedMaterials + acceptedWholes);
  if (const std::size_t broken = countBroken(report); broken > 0)
    text += fmt::format("; scenes not compared: {}", broken);
  if (const std::size_t notRun = countNotRun(report); notRun > 0) text += fmt::format("; scenes not run: {}", notRun);
  if (report.baseline && !report.baseline->error.empty()) text += "; the baseline could not be used";
  if (report.baseline && !report.baseline->gone.empty())
    text += fmt::format("; gone since the baseline: {}", report.baseline->gone.size());
  if (report.baseline && report.baseline->notComparable > 0)
    text += fmt::format("; not comparable to the baseline: {}", report.baseline->notComparable);
  return text;
}

// What the checks left open, so that nobody takes a regression for judged that was not.
std::string unjudgedLine(const Report& report) {
  std::size_t count = 0;
  const auto add = [&](const std::vector<compare::CheckResult>& checks, const compare::Figures& figures) {
    if (figures.nonFinite > 0) return; // that says why
    count += static_cast<std::size_t>(std::ranges::count_if(
        checks, [](const compare::CheckResult& check) { return check.regress && !check.judged(); }));
  };
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) {
      add(view.checks, view.whole);
      for (const MaterialResult& material : view.materials) add(material.checks, material.figures);
    }
  if (count == 0) return {};
  return fmt::format("regressions not judged: {} ({})\n", count,
                     !report.baseline                     ? "no --baseline was given"
                     : report.baseline->notComparable > 0 ? "the baseline has no comparable figures"
                                                          : "the baseline does not have their figures");
}

// What the columns of stages are, by the first view that shows each.
std::string stageLines(const Report& report) {
  std::vector<std::pair<std::string, std::string>> lines; // stage, line: empty where no view shows it
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views)
      for (const StageResult& stage : view.stages) {
        auto line = std::ranges::find(lines, stage.stage, &std::pair<std::string, std::string>::first);
        if (line == lines.end()) line = lines.insert(line, {stage.stage, ""});
        const StageWords words = describe(stage, view.test);
        if (line->second.empty() && showsStage(view, stage.stage))
          line->second = fmt::format("{}: {}.\n", words.column, words.figures);
      }
  std::string out;
  for (const auto& [stage, line] : lines) out += line;
  return out;
}

std::string joined(const std::vector<std::string>& paths, const char* between,
                   const std::function<std::string(const std::string&)>& shown) {
  std::string text;
  for (const std::string& path : paths) text += (text.empty() ? "" : between) + shown(path);
  return text;
}

// A row of any kind that is not well, and where it is.
struct Worst {
  compare::Verdict verdict = compare::Verdict::pass;
  double flip = 0; // mean
  const SceneResult* scene = nullptr;
  const ViewResult* view = nullptr;
  const MaterialResult* material = nullptr; // null: the whole image
};

// The gravest first, of those the largest FLIP.
std::vector<Worst> worstRows(const Report& report) {
  std::vector<Worst> rows;
  const auto add = [&](const SceneResult& scene, const ViewResult& view, const MaterialResult* material,
                       compare::Verdict verdict, const compare::Figures& figures) {
    if (isShownRow(verdict, false))
      rows.push_back({verdict, figures.find("flip.mean").value_or(-1), &scene, &view, material});
  };
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) {
      for (const MaterialResult& material : view.materials)
        if (!material.seenElsewhere) add(scene, view, &material, material.verdict, material.figures);
      add(scene, view, nullptr, view.wholeVerdict, view.whole);
    }
  std::ranges::stable_sort(rows, [](const Worst& a, const Worst& b) {
    return a.verdict != b.verdict ? a.verdict > b.verdict : a.flip > b.flip;
  });
  return rows;
}

class Table {
public:
  Table(const Report& report, const RunInfo& run, const TableOptions& options)
      : m_report(report), m_run(run), m_options(options), m_paths(pathsOf(report)) {}

  std::string make() {
    const bool anyShown = addScenes();
    addBaseline();
    for (const RunProblem& problem : problemsOf(m_report)) addLine(problem.verdict, "", problem.reason);
    if (const std::string notRun = describeNotRun(m_report); !notRun.empty())
      addLine(compare::Verdict::notRun, "", notRun.substr(notRun.find(':') + 2));
    addText(unjudgedLine(m_report));
    addCauses();
    addCommands();
    if (anyShown) addExplanations();
    m_out += "verdict: " + paint(m_report.verdict, nameOf(m_report.verdict), m_options.color);
    const std::size_t used = 9 + base::displayWidth(nameOf(m_report.verdict)) + 1;
    m_out += " " + base::wrapText(fmt::format("({})", summary(m_report)), m_options.columns, used, 2) + "\n";
    return std::move(m_out);
  }

private:
  // One or several lines of text, wrapped.
  void addText(const std::string& lines, std::size_t indent = 2) {
    for (std::size_t begin = 0, end = 0; begin < lines.size(); begin = end + 1) {
      end = std::min(lines.find('\n', begin), lines.size());
      m_out += base::wrapText(base::plainLine(lines.substr(begin, end - begin)), m_options.columns, 0, indent) + "\n";
    }
  }
  // "Desk: error: why", its verdict in colour; a line for each of the text.
  void addLine(compare::Verdict verdict, const std::string& subject, const std::string& text) {
    const std::string name = verdict == compare::Verdict::warn ? "warning" : nameOf(verdict);
    const std::string begin = subject.empty() ? "" : base::plainLine(subject) + ": ";
    for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 1) {
      end = text.find('\n', at);
      const std::size_t used = base::displayWidth(begin) + name.size() + 2;
      m_out += begin + paint(verdict, name, m_options.color) + ": " +
               base::wrapText(base::plainLine(text.substr(at, end - at)), m_options.columns, used, 2) + "\n";
    }
  }

  // Whether any row is shown. Views of which none is are counted.
  bool addScenes() {
    bool anyShown = false;
    std::size_t hidden = 0;
    for (const SceneResult& scene : m_report.scenes) {
      for (const ViewResult& view : scene.views) {
        const std::string block = formatView(scene, view, m_paths, m_report.baseline.has_value(), m_options);
        m_out += block;
        anyShown = anyShown || !block.empty();
        hidden += block.empty();
      }
      if (const std::string costs = describeCosts(scene.permutations); !costs.empty())
        addText(scene.name + ": " + costs), m_out += "\n";
      if (!scene.error.empty() && !isNotRun(scene))
        addLine(compare::Verdict::error, scene.name, scene.error), m_out += "\n";
    }
    if (hidden > 0)
      addText(fmt::format("{} {} nothing that failed, warned or could not be judged: --all shows {}", hidden,
                          hidden == 1 ? "view has" : "views have", hidden == 1 ? "it" : "them"));
    return anyShown;
  }

  void addBaseline() {
    if (!m_report.baseline) return;
    const BaselineSummary& baseline = *m_report.baseline;
    if (!baseline.error.empty()) addLine(compare::Verdict::error, "", "baseline: " + baseline.error);
    constexpr std::size_t kMostGone = 10;
    const std::size_t shown = m_options.all ? baseline.gone.size() : std::min(baseline.gone.size(), kMostGone);
    for (std::size_t i = 0; i < shown; ++i) addLine(compare::Verdict::warn, "", describeGone(baseline.gone[i]));
    if (shown < baseline.gone.size())
      addLine(compare::Verdict::warn, "", fmt::format("gone: {} more: --all shows them", baseline.gone.size() - shown));
  }

  // Of one material its row says it.
  void addCauses() {
    const std::vector<CauseTotal> totals = totalsByCause(m_report);
    std::size_t materials = 0;
    for (const CauseTotal& total : totals) materials += total.materials;
    if (materials < 2) return;
    m_out += "causes:\n";
    for (const CauseTotal& total : totals) {
      const std::optional<double> flip = total.worst->figures.find("flip.mean");
      const char* const hint = total.words == kCauseNotMeasured ? " (--attribution all measures warnings, too)" : "";
      const std::string line =
          fmt::format("{}{}: {} material{}, worst {} in scene {}, view {}{}", total.words, hint, total.materials,
                      total.materials == 1 ? "" : "s", total.worst->name, total.scene->name, total.view->name,
                      flip ? ": mean FLIP " + compare::formatFigure("flip.mean", *flip) : "");
      m_out += "  " + base::wrapText(base::plainLine(line), m_options.columns, 2, 4) + "\n";
    }
  }

  void addCommands() {
    if (m_run.again.empty()) return;
    constexpr std::size_t kMostCommands = 3;
    const AgainCommands again(m_run);
    std::vector<std::string> commands;
    for (const Worst& row : worstRows(m_report))
      if (std::string command = again.of(*row.scene, *row.view, row.material); !command.empty())
        commands.push_back(std::move(command));
    const std::size_t shown = m_options.all ? commands.size() : std::min(commands.size(), kMostCommands);
    if (shown == 0) return;
    m_out += "to see it again:\n";
    for (std::size_t i = 0; i < shown; ++i)
      m_out += base::wrapCommand(base::plainLine(commands[i]), m_options.columns, 2) + "\n";
    if (shown < commands.size())
      addText(fmt::format("  {} more: --all, junit.xml and the page have the commands", commands.size() - shown));
  }

  void addExplanations() {
    const std::string tests = joined({m_paths.begin() + 1, m_paths.end()}, " or ", titleOf),
                      first = titleOf(m_paths.front());
    addText(
        fmt::format("mean, p95, max: FLIP, 0 (identical) to 1. A material's row: only this material has the colours "
                    "of {}, all others those of {}.",
                    tests, first));
    addText(stageLines(m_report));
    if (hasTruth(m_report))
      addText(fmt::format(
          "{}: mean FLIP of {} against the truth; ~ marks a difference within 2 standard errors of the truth.",
          joined(m_paths, ", ", [&](const std::string& path) { return truthColumn(path, m_paths); }),
          joined(m_paths, " and of ", titleOf)));
  }

  const Report& m_report;
  const RunInfo& m_run;
  const TableOptions& m_options;
  const std::vector<std::string> m_paths;
  std::string m_out;
};

} // namespace

std::string toTable(const Report& report, const RunInfo& run, const TableOptions& options) {
  return Table(report, run, options).make();
}

} // namespace parity::report
