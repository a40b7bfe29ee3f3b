#include "report/table_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text/text.h"
#include "base/text/wrap.h"
#include "compare/verdict/wording.h"
#include "report/dropped_lobes.h"
#include "report/what_if.h"
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

} // namespace

bool showsStage(const ViewResult& view, const std::string& stage) {
  const auto shows = [&](const std::vector<StageResult>& stages) {
    const StageResult* found = findStage(stages, stage);
    return found && isShown(*found);
  };
  return shows(view.stages) || std::ranges::any_of(view.materials, shows, &MaterialResult::stages);
}

std::string truthColumn(const std::string& path, const std::vector<std::string>& paths) {
  std::size_t letters = 2;
  const auto isTaken = [&](const std::string& other) {
    return other != path && other.substr(0, letters) == path.substr(0, letters);
  };
  while (letters < path.size() && std::ranges::any_of(paths, isTaken)) ++letters;
  return path.substr(0, letters) + "/truth";
}

std::string paint(compare::Verdict verdict, const std::string& text, bool color) {
  if (!color) return text;
  const char* code = verdict == compare::Verdict::pass ? "32" : verdict <= compare::Verdict::warn ? "33" : "1;31";
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
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

namespace {

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

constexpr std::size_t kVerdictColumns = 10, kPixelColumns = 9;
constexpr std::size_t kTextIndent = 2 + kVerdictColumns + 2; // below the material's name

// The columns that the width has room for, and those whose figures are in the text of each row.
struct Layout {
  std::size_t name = kMinNameColumns;
  std::vector<Column> columns, inText;
};

Layout layOut(const ViewResult& view, std::vector<Column> columns, const TableOptions& options) {
  Layout layout;
  for (const MaterialResult& material : view.materials)
    if (isShownRow(material.verdict, options.all))
      layout.name = std::max(layout.name, base::displayWidth(base::plainLine(material.name)));
  layout.name = std::min(layout.name, kMaxNameColumns);
  layout.columns = std::move(columns);
  if (options.columns == 0) return layout;
  std::size_t width = kTextIndent + 1 + kPixelColumns;
  for (const Column& column : layout.columns) width += 2 + column.width;
  while (width + kMinNameColumns > options.columns && layout.columns.size() > 1) {
    width -= 2 + layout.columns.back().width;
    layout.inText.insert(layout.inText.begin(), layout.columns.back());
    layout.columns.pop_back();
  }
  const std::size_t room = options.columns > width ? options.columns - width : kMinNameColumns;
  layout.name = std::max(kMinNameColumns, std::min(layout.name, room));
  return layout;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

// The figures without a column, the difference of light, why, and the cause.
std::string wordsOf(const Row& row, const Layout& layout) {
  std::string figures, words;
  for (const Column& column : layout.inText)
    if (column.metric == "bias.ev")
      continue; // the words of the bias say it
    else if (const std::string cell = trimmed(formatCell(column, row)); cell != "-")
      figures += fmt::format("{}{} {}", figures.empty() ? "" : ", ", trimmed(column.title), cell);
  const std::string bias = row.figures.pixels > 0 ? compare::describeBias(row.figures, row.test) : "";
  for (const std::string& more : {figures, bias, row.reason, row.cause})
    if (!more.empty()) words += (words.empty() ? "" : "; ") + base::plainLine(more);
  if (!row.accepted.empty()) words += (words.empty() ? "accepted: " : "; accepted: ") + base::plainLine(row.accepted);
  return words;
}

std::string formatRow(const Row& row, const Layout& layout, const TableOptions& options) {
  std::string line = fmt::format(
      "  {}  {} {:>{}}", paint(row.verdict, base::fitColumns(nameOf(row.verdict), kVerdictColumns), options.color),
      base::fitColumns(base::plainLine(row.name), layout.name), row.figures.pixels, kPixelColumns);
  for (const Column& column : layout.columns) line += fmt::format("  {:>{}}", formatCell(column, row), column.width);
  const std::string words = wordsOf(row, layout);
  if (words.empty()) return line + "\n";
  if (options.columns == 0) return line + "  " + words + "\n";
  return line + "\n" + std::string(kTextIndent, ' ') +
         base::wrapText(words, options.columns, kTextIndent, kTextIndent) + "\n";
}

// Of materials that the view's block does not show; those that another view shows do not count.
VerdictCounts countHidden(const ViewResult& view) {
  Report hidden;
  ViewResult& copy = hidden.scenes.emplace_back().views.emplace_back();
  for (const MaterialResult& material : view.materials)
    if (!isShownRow(material.verdict, false) && !material.seenElsewhere)
      copy.materials.emplace_back().verdict = material.verdict;
  return countVerdicts(hidden);
}

std::string indented(const std::string& text, const TableOptions& options) {
  return "  " + base::wrapText(base::plainLine(text), options.columns, 2, 4) + "\n";
}

} // namespace

std::string formatView(const SceneResult& scene, const ViewResult& view, const std::vector<std::string>& paths,
                       bool hasBaseline, const TableOptions& options) {
  const auto isShown = [&](const MaterialResult& material) {
    return isShownRow(material.verdict, options.all) && (options.all || !material.seenElsewhere);
  };
  const bool showsWhole = isShownRow(view.wholeVerdict, options.all);
  if (!showsWhole && std::ranges::none_of(view.materials, isShown)) return {};
  const Layout layout = layOut(view, columnsOf(view, paths, hasBaseline), options);

  std::string out = fmt::format("{}, view {} ({}x{})\n", base::plainLine(scene.name), base::plainLine(view.name),
                                view.width, view.height);
  out += fmt::format("  {}  {} {:>{}}", base::fitColumns("verdict", kVerdictColumns),
                     base::fitColumns("material", layout.name), "pixels", kPixelColumns);
  for (const Column& column : layout.columns) out += fmt::format("  {:>{}}", column.title, column.width);
  out += "\n";
  for (const MaterialResult& material : view.materials) {
    if (!isShown(material)) continue;
    out +=
        formatRow({material.name, material.test, material.verdict, material.figures, material.baseline, material.truth,
                   material.stages, material.reason, describeCauses(material, view.reference), material.accepted},
                  layout, options);
    if (!material.droppedLobes.empty())
      out += "    " + indented(describeDroppedLobes(material, view.reference, view.test), options);
    if (!material.whatIf.empty()) out += "    " + indented(describeWhatIfs(material), options);
  }
  if (showsWhole)
    out += formatRow({"whole image", view.test, view.wholeVerdict, view.whole, view.baseline, view.truth, view.stages,
                      view.reason, "", view.accepted},
                     layout, options);
  if (const VerdictCounts hidden = countHidden(view); !options.all && hidden.total() > 0)
    out +=
        indented(fmt::format("{} more material{} ({}): --all shows {}", hidden.total(), hidden.total() == 1 ? "" : "s",
                             formatCounts(hidden), hidden.total() == 1 ? "it" : "them"),
                 options);
  if (view.truth)
    for (const std::string& note : view.truth->notes) out += indented(note, options);
  if (view.droppedLights) out += indented(describe(*view.droppedLights, view.reference, view.test), options);
  return out + "\n";
}

} // namespace parity::report
