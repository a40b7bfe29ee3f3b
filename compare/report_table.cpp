// The table for a terminal: a row a material, a block a view, a line that sums up.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "compare/report.h"
#include "compare/text.h"
#include "compare/wording.h"

namespace parity::compare {
namespace {

constexpr std::size_t kMaxNameColumns = 40, kMinNameColumns = 11;

std::string paint(Verdict verdict, const std::string& text, bool color) {
  if (!color) return text;
  const char* code = verdict == Verdict::pass ? "32" : verdict <= Verdict::warn ? "33" : "1;31";
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

std::string formatLuma(const Figures& figures) {
  if (figures.referenceLuma < 0.5 / 255) return "-";
  return fmt::format("{:+.1f} %", 100 * (figures.testLuma / figures.referenceLuma - 1));
}

std::string formatRow(const std::string& name, std::size_t nameColumns, Verdict verdict, const RegionFigures& regions,
                      const Figures& main, const std::string& reason, bool color) {
  std::string row = fmt::format("  {}  {}", paint(verdict, fitColumns(nameOf(verdict), 8), color),
                                fitColumns(plainLine(name), nameColumns));
  if (regions.all.pixels > 0) {
    row += fmt::format(" {:>9}  {:.3f}  {:.3f}  {:.3f}  {:.3f}  {:>8}  {:>9}", regions.all.pixels, main.flip.mean,
                       main.flip.p95, main.flip.max, regions.all.flip.mean, formatLuma(main),
                       formatFigure("psnr", main.psnr));
  } else {
    row += fmt::format(" {:>9}  {:>5}  {:>5}  {:>5}  {:>5}  {:>8}  {:>9}", 0, "-", "-", "-", "-", "-", "-");
  }
  if (!reason.empty()) row += "  " + plainLine(reason);
  return row + "\n";
}

std::string formatView(const SceneResult& scene, const ViewResult& view, bool color) {
  std::size_t columns = kMinNameColumns;
  for (const MaterialResult& material : view.materials)
    columns = std::max(columns, displayWidth(plainLine(material.name)));
  columns = std::min(columns, kMaxNameColumns);

  std::string out =
      fmt::format("{}, view {} ({}x{})\n", plainLine(scene.name), plainLine(view.name), view.width, view.height);
  out += fmt::format("  {}  {} {:>9}  {:>5}  {:>5}  {:>5}  {:>5}  {:>8}  {:>9}\n", fitColumns("verdict", 8),
                     fitColumns("material", columns), "pixels", "mean", "p95", "max", "all", "luma", "psnr");
  for (const MaterialResult& material : view.materials)
    out += formatRow(material.name, columns, material.verdict, material.figures, mainFigures(material.figures),
                     material.reason, color);
  out += formatRow("whole image", columns, view.wholeVerdict, view.whole, view.whole.all, view.reason, color);
  return out + "\n";
}

std::string summary(const Report& report) {
  const VerdictCounts counts = countVerdicts(report);
  const std::array<std::pair<std::size_t, const char*>, 5> parts = {{{counts.pass, "pass"},
                                                                     {counts.notSeen, "not seen"},
                                                                     {counts.warn, "warn"},
                                                                     {counts.fail, "fail"},
                                                                     {counts.error, "error"}}};
  std::string text;
  for (const auto& [count, name] : parts)
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  return text.empty() ? "nothing was compared" : text;
}

} // namespace

std::string toTable(const Report& report, bool color) {
  std::string out;
  for (const SceneResult& scene : report.scenes) {
    for (const ViewResult& view : scene.views) out += formatView(scene, view, color);
    if (!scene.error.empty())
      out += fmt::format("{}: {}: {}\n\n", plainLine(scene.name), paint(Verdict::error, "error", color),
                         plainLine(scene.error));
  }
  out += "FLIP of the displayed images (0 alike, 1 far apart): mean, p95, max over interior pixels (whole image: "
         "all), 'all' the mean over every pixel.\n";
  return out + fmt::format("verdict: {} ({})\n", paint(report.verdict, nameOf(report.verdict), color), summary(report));
}

} // namespace parity::compare
