// The table for a terminal: a row a material, a block a view, a line that sums up.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "base/text/text.h"
#include "compare/verdict/wording.h"
#include "report/report.h"
#include "report/wording.h"

namespace parity::report {
namespace {

constexpr std::size_t kMaxNameColumns = 40, kMinNameColumns = 11;

// One column of a view's table: a figure.
struct Column {
  std::string title, metric;
  bool change = false; // since the baseline
  std::size_t width = 5;
  compare::Figures compare::TruthFigures::*path = nullptr; // against the truth: this path's
  std::string stage = {};                                  // not empty: of this stage
};

// The figures that are shown where they were measured, in this order; "rmse" only where its twin psnr is not.
constexpr std::array<std::pair<std::string_view, const char*>, 8> kShown = {{{"hdrflip.mean", "hdrflip"},
                                                                             {"ssim.mean", "ssim"},
                                                                             {"msssim", "msssim"},
                                                                             {"deltae.mean", "dE00"},
                                                                             {"relmse", "relmse"},
                                                                             {"maxabs", "maxabs"},
                                                                             {"psnr", "psnr"},
                                                                             {"rmse", "rmse"}}};

bool showsStage(const ViewResult& view, const std::string& stage) {
  const auto shows = [&](const std::vector<StageResult>& stages) {
    const StageResult* found = findStage(stages, stage);
    return found && isShown(*found);
  };
  return shows(view.stages) || std::ranges::any_of(view.materials, shows, &MaterialResult::stages);
}

// "hi/truth": two letters of the path's name, or as many as tell it from all others.
std::string truthColumn(const std::string& path, const std::vector<std::string>& paths) {
  std::size_t letters = 2;
  const auto isTaken = [&](const std::string& other) {
    return other != path && other.substr(0, letters) == path.substr(0, letters);
  };
  while (letters < path.size() && std::ranges::any_of(paths, isTaken)) ++letters;
  return path.substr(0, letters) + "/truth";
}

std::vector<Column> columnsOf(const ViewResult& view, const std::vector<std::string>& paths, bool baseline) {
  const compare::Figures* sample = view.whole.values.empty() ? nullptr : &view.whole;
  for (const MaterialResult& material : view.materials)
    if (!sample && !material.figures.values.empty()) sample = &material.figures;
  std::vector<Column> columns;
  if (!sample) return columns;
  if (sample->find("flip.mean")) columns = {{"mean", "flip.mean"}, {"p95", "flip.p95"}, {"max", "flip.max"}};
  if (sample->find("bias.ev")) columns.push_back({.title = "EV", .metric = "bias.ev", .width = 8});
  if (baseline && sample->find("flip.mean")) columns.push_back({"since", "flip.mean", true, 6});
  if (view.truth) {
    const auto add = [&](const std::string& path, auto figures) {
      const std::string title = truthColumn(path, paths) + " ";
      columns.push_back({title, "flip.mean", false, std::max<std::size_t>(title.size(), 9), figures});
    };
    add(view.reference, &compare::TruthFigures::reference);
    add(view.test, &compare::TruthFigures::test);
  }
  for (const StageResult& stage : view.stages)
    if (showsStage(view, stage.stage)) {
      const std::string title = describe(stage, view.test).column;
      columns.push_back({.title = title, .metric = "flip.mean", .width = title.size(), .stage = stage.stage});
    }
  for (const auto& [metric, title] : kShown)
    if (sample->find(metric) && !(metric == "rmse" && sample->find("psnr")))
      columns.push_back({title, std::string(metric), false, metric == "psnr" ? 9u : 7u});
  return columns;
}

std::string paint(compare::Verdict verdict, const std::string& text, bool color) {
  if (!color) return text;
  const char* code = verdict == compare::Verdict::pass ? "32" : verdict <= compare::Verdict::warn ? "33" : "1;31";
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

struct Row {
  std::string name;
  const std::string& test; // path
  compare::Verdict verdict;
  const compare::Figures& figures;
  const std::optional<BaselineChange>& baseline;
  const std::optional<compare::Truth>& truth;
  const std::vector<StageResult>& stages;
  const std::string& reason;
  std::string cause; // in words; empty where it was not looked for
  std::string accepted = {};
};

std::string formatCell(const Column& column, const Row& row) {
  if (row.figures.pixels == 0) return "-";
  if (column.change) {
    if (!row.baseline) return "-";
    if (row.baseline->isNew) return "new";
    const auto& changes = row.baseline->changes;
    const auto change = std::ranges::find(changes, column.metric, &FigureChange::metric);
    return change == changes.end() ? "-" : compare::formatChange(column.metric, change->change());
  }
  if (column.path) {
    if (!row.truth) return "- ";
    const compare::TruthFigures& truth = row.truth->figures;
    const std::optional<double> mean = (truth.*column.path).find(column.metric);
    if (!mean) return "- ";
    return compare::formatFigure(column.metric, *mean) +
           (compare::isWithinNoise(truth.*column.path, truth.error) ? "~" : " ");
  }
  if (!column.stage.empty()) {
    const StageResult* stage = findStage(row.stages, column.stage);
    const std::optional<double> mean = stage ? stage->figures.find(column.metric) : std::nullopt;
    return mean ? compare::formatFigure(column.metric, *mean) : "-";
  }
  const std::optional<double> value = row.figures.find(column.metric);
  if (!value) return "-";
  return std::isnan(*value) ? "NaN" : compare::formatFigure(column.metric, *value);
}

std::string formatRow(const Row& row, std::size_t nameColumns, const std::vector<Column>& columns, bool color) {
  std::string line = fmt::format("  {}  {} {:>9}", paint(row.verdict, base::fitColumns(nameOf(row.verdict), 10), color),
                                 base::fitColumns(base::plainLine(row.name), nameColumns), row.figures.pixels);
  for (const Column& column : columns) line += fmt::format("  {:>{}}", formatCell(column, row), column.width);
  std::string words = row.figures.pixels > 0 ? compare::describeBias(row.figures, row.test) : "";
  for (const std::string& more : {row.reason, row.cause})
    if (!more.empty()) words += (words.empty() ? "" : "; ") + base::plainLine(more);
  if (!row.accepted.empty()) words += (words.empty() ? "accepted: " : "; accepted: ") + base::plainLine(row.accepted);
  return line + (words.empty() ? "" : "  " + words) + "\n";
}

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

std::string formatView(const SceneResult& scene, const ViewResult& view, const std::vector<std::string>& paths,
                       bool baseline, bool color) {
  std::size_t nameColumns = kMinNameColumns;
  for (const MaterialResult& material : view.materials)
    nameColumns = std::max(nameColumns, base::displayWidth(base::plainLine(material.name)));
  nameColumns = std::min(nameColumns, kMaxNameColumns);
  const std::vector<Column> columns = columnsOf(view, paths, baseline);

  std::string out = fmt::format("{}, view {} ({}x{})\n", base::plainLine(scene.name), base::plainLine(view.name),
                                view.width, view.height);
  out += fmt::format("  {}  {} {:>9}", base::fitColumns("verdict", 10), base::fitColumns("material", nameColumns),
                     "pixels");
  for (const Column& column : columns) out += fmt::format("  {:>{}}", column.title, column.width);
  out += "\n";
  for (const MaterialResult& material : view.materials)
    out +=
        formatRow({material.name, material.test, material.verdict, material.figures, material.baseline, material.truth,
                   material.stages, material.reason,
                   material.attribution ? describeCause(*material.attribution, view.reference) : "", material.accepted},
                  nameColumns, columns, color);
  out += formatRow({"whole image", view.test, view.wholeVerdict, view.whole, view.baseline, view.truth, view.stages,
                    view.reason, "", view.accepted},
                   nameColumns, columns, color);
  if (view.truth)
    for (const std::string& note : view.truth->notes) out += fmt::format("  {}\n", base::plainLine(note));
  if (view.droppedLights)
    out += fmt::format("  {}\n", base::plainLine(describe(*view.droppedLights, view.reference, view.test)));
  return out + "\n";
}

std::string formatCounts(const VerdictCounts& counts) {
  const std::array<std::pair<std::size_t, const char*>, 7> parts = {{{counts.pass, "pass"},
                                                                     {counts.notSeen, "not seen"},
                                                                     {counts.tooSmall, "too small"},
                                                                     {counts.notJudged, "not judged"},
                                                                     {counts.warn, "warn"},
                                                                     {counts.fail, "fail"},
                                                                     {counts.error, "error"}}};
  std::string text;
  for (const auto& [count, name] : parts)
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  return text.empty() ? "none" : text;
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
  const auto broken = std::ranges::count_if(report.scenes, [](const SceneResult& s) { return !s.error.empty(); });
  if (broken > 0) text += fmt::format("; scenes not compared: {}", broken);
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
  const auto add = [&](const std::vector<compare::CheckResult>& checks) {
    count += static_cast<std::size_t>(std::ranges::count_if(
        checks, [](const compare::CheckResult& check) { return check.regress && !check.judged(); }));
  };
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) {
      add(view.checks);
      for (const MaterialResult& material : view.materials) add(material.checks);
    }
  if (count == 0) return {};
  return fmt::format("regressions not judged: {} ({})\n", count,
                     !report.baseline                     ? "no --baseline was given"
                     : report.baseline->notComparable > 0 ? "the baseline has no comparable figures"
                                                          : "the baseline does not have their figures");
}

// A line for each problem.
std::string errorLines(const SceneResult& scene, bool color) {
  std::string out;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = scene.error.find('\n', begin);
    out += fmt::format("{}: {}: {}\n", base::plainLine(scene.name), paint(compare::Verdict::error, "error", color),
                       base::plainLine(scene.error.substr(begin, end - begin)));
  }
  return out;
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

} // namespace

std::string toTable(const Report& report, bool color) {
  std::string out;
  const std::vector<std::string> paths = pathsOf(report);
  for (const SceneResult& scene : report.scenes) {
    for (const ViewResult& view : scene.views)
      out += formatView(scene, view, paths, report.baseline.has_value(), color);
    if (const std::string costs = describeCosts(scene.permutations); !costs.empty())
      out += fmt::format("{}: {}\n\n", base::plainLine(scene.name), costs);
    if (!scene.error.empty()) out += errorLines(scene, color) + "\n";
  }
  if (report.baseline) {
    const BaselineSummary& baseline = *report.baseline;
    if (!baseline.error.empty())
      out += fmt::format("{}: baseline: {}\n", paint(compare::Verdict::error, "error", color),
                         base::plainLine(baseline.error));
    for (const GoneRow& row : baseline.gone)
      out +=
          fmt::format("{}: {}\n", paint(compare::Verdict::warn, "warning", color), base::plainLine(describeGone(row)));
  }
  for (const RunProblem& problem : problemsOf(report))
    out += fmt::format("{}: {}\n", paint(problem.verdict, nameOf(problem.verdict), color),
                       base::plainLine(problem.reason));
  out += unjudgedLine(report);
  const std::string tests = joined({paths.begin() + 1, paths.end()}, " or ", titleOf), first = titleOf(paths.front());
  out += fmt::format(
      "mean, p95, max: FLIP of the displayed images (0: identical, 1: largest difference). A material row compares the "
      "{} picture with a copy in which only this material has the colours of {}. The row of the whole image compares "
      "{} "
      "with {}.\n",
      first, tests, first, tests);
  out += stageLines(report);
  if (hasTruth(report))
    out += fmt::format(
        "{}: mean FLIP of {} against the truth; ~ marks a difference within 2 standard errors of the truth.\n",
        joined(paths, ", ", [&](const std::string& path) { return truthColumn(path, paths); }),
        joined(paths, " and of ", titleOf));
  return out + fmt::format("verdict: {} ({})\n", paint(report.verdict, nameOf(report.verdict), color), summary(report));
}

} // namespace parity::report
