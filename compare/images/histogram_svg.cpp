#include "compare/images/histogram_svg.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/text.h"
#include "compare/flip/magma.h"

namespace parity::compare {

namespace {

constexpr double kWidth = 760, kHeight = 420;
constexpr double kLeft = 84, kRight = 740, kTop = 92, kBottom = 356; // of the plot
constexpr double kLeastDecade = -5, kDecades = 5;                    // 10^-5 = 0.001 % to 1 = 100 %

double xOf(double value) { return kLeft + std::clamp(value, 0.0, 1.0) * (kRight - kLeft); }

double yOf(double share) {
  const double up = share > 0 ? (std::log10(share) - kLeastDecade) / kDecades : 0;
  return kBottom - std::clamp(up, 0.0, 1.0) * (kBottom - kTop);
}

std::string text(double x, double y, const char* anchor, const std::string& words, const char* style = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, style,
                     base::escapeMarkup(words));
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2, style);
}

double requireWeights(std::span<const double> buckets) {
  double total = 0;
  for (const double weight : buckets) {
    if (!(weight >= 0) || !std::isfinite(weight))
      throw base::Error(base::ExitCode::failed, "histogram", "", "a bucket's weight is negative or not finite");
    total += weight;
  }
  if (total <= 0) throw base::Error(base::ExitCode::failed, "histogram", "", "holds no pixels");
  return total;
}

std::string drawAxes(const std::string& axis) {
  std::string out;
  for (int decade = 0; decade <= static_cast<int>(kDecades); ++decade) {
    const double share = std::pow(10.0, decade + kLeastDecade), y = yOf(share);
    out += line(kLeft, y, kRight, y, "stroke=\"#ddd\"");
    out += text(kLeft - 8, y + 4, "end", fmt::format("{:g} %", share * 100));
  }
  for (int tenth = 0; tenth <= 10; ++tenth) {
    const double x = xOf(tenth / 10.0);
    out += line(x, kBottom, x, kBottom + 5, "stroke=\"#333\"");
    out += text(x, kBottom + 20, "middle", fmt::format("{:g}", tenth / 10.0));
  }
  out += line(kLeft, kBottom, kRight, kBottom, "stroke=\"#333\"");
  out += text((kLeft + kRight) / 2, kBottom + 44, "middle", axis);
  out += fmt::format("<text transform=\"translate(18 {:.1f}) rotate(-90)\" text-anchor=\"middle\">share of pixels "
                     "(logarithmic)</text>\n",
                     (kTop + kBottom) / 2);
  return out;
}

// Marks that would stand on each other, as all of them do for identical pictures, become one of all their names.
std::vector<std::pair<std::string, double>> mergeMarks(const std::vector<std::pair<std::string, double>>& marks) {
  constexpr double kLeastDistance = 5e-5; // the labels have four digits
  std::vector<std::pair<std::string, double>> merged;
  for (const auto& [name, value] : marks)
    if (!merged.empty() && value - merged.back().second < kLeastDistance)
      merged.back().first += ", " + name;
    else
      merged.emplace_back(name, value);
  return merged;
}

// Labels take turns in three rows, so that neighbours do not overlap; a halo keeps them readable on the lines.
std::string drawMarks(std::vector<std::pair<std::string, double>> marks) {
  std::stable_sort(marks.begin(), marks.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  marks = mergeMarks(marks);
  std::string lines, labels;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const double x = xOf(marks[i].second), y = kTop - 8 - 15.0 * static_cast<double>((marks.size() - 1 - i) % 3);
    const bool right = x > kRight - 90;
    lines += line(x, y + 2, x, kBottom, "stroke=\"#06c\" stroke-dasharray=\"4 3\"");
    labels += text(right ? x - 4 : x + 4, y, right ? "end" : "start",
                   fmt::format("{} {:.4f}", marks[i].first, marks[i].second),
                   " fill=\"#06c\" stroke=\"white\" stroke-width=\"4\" paint-order=\"stroke\"");
  }
  return lines + labels;
}

} // namespace

std::string toSvg(const HistogramPicture& picture) {
  const double total = requireWeights(picture.buckets);
  std::string out = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
                                "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"sans-serif\" font-size=\"12\">\n"
                                "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                                kWidth, kHeight);
  out += text(kLeft, 28, "start", picture.title, " font-size=\"16\" font-weight=\"bold\"");
  out += drawAxes(picture.axis);
  const double count = static_cast<double>(picture.buckets.size());
  for (std::size_t i = 0; i < picture.buckets.size(); ++i) {
    const double share = picture.buckets[i] / total, y = yOf(share), left = xOf(static_cast<double>(i) / count);
    if (share <= 0) continue;
    const double middle = (static_cast<double>(i) + 0.5) / count;
    const auto rgb = magmaColor(static_cast<int>(255 * middle + 0.5));
    // At least a hair: a single pixel of 8K is below the axis.
    out += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
                       "fill=\"#{:02x}{:02x}{:02x}\" stroke=\"#555\" stroke-width=\"0.4\"><title>{:g} to {:g}: {:.4g} "
                       "%</title></rect>\n",
                       left, std::min(y, kBottom - 1), xOf(static_cast<double>(i + 1) / count) - left,
                       std::max(kBottom - y, 1.0), rgb[0], rgb[1], rgb[2], static_cast<double>(i) / count,
                       static_cast<double>(i + 1) / count, share * 100);
  }
  return out + drawMarks(picture.marks) + "</svg>\n";
}

} // namespace parity::compare
