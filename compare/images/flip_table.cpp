// The result of parity flip for people.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text/text.h"
#include "compare/images/flip_text.h"
#include "compare/metrics/metric.h"
#include "compare/verdict/wording.h"

namespace parity::compare {

namespace {

std::string word(const FlipResult& result, Verdict verdict) {
  return verdict == Verdict::fail ? "FAIL" : verdict == Verdict::error ? "ERROR" : nameOf(result, verdict);
}

// Six digits where a figure has no unit: this is where one looks for the last ones.
std::string preciseFigure(const std::string& name, double value) {
  const auto statistic = statisticByName(name);
  const bool plain = statistic && statistic->unit.empty() && std::isfinite(value);
  return plain ? fmt::format("{:.6f}", value) : formatFigure(name, value);
}

std::string describePair(const FlipPair& pair) {
  std::string out = fmt::format("{}x{}, {}, {}: {}\n", pair.width, pair.height, pair.channels, pair.hdr ? "HDR" : "LDR",
                                pair.rangeReason);
  const bool same = pair.referenceSpace == pair.testSpace;
  out += same ? fmt::format("colour: {}\n", pair.referenceSpace)
              : fmt::format("colour: {}; the test: {}\n", pair.referenceSpace, pair.testSpace);
  if (!pair.where.empty())
    out += fmt::format("region: {}, {} pixels ({})\n", base::plainLine(pair.rows.front().name),
                       pair.rows.front().figures.pixels, base::plainLine(pair.where));
  for (const std::string& note : pair.notes) out += fmt::format("note: {}\n", base::plainLine(note));
  return out;
}

std::string listFigures(const FlipPair& pair) {
  std::string out = describePair(pair);
  const FlipRow& row = pair.rows.front();
  std::size_t width = 24;
  for (const Figure& figure : row.figures.values) width = std::max(width, figure.name.size());
  for (const Figure& figure : row.figures.values)
    out += fmt::format("{} {}\n", base::fitColumns(figure.name, width), preciseFigure(figure.name, figure.value));
  if (pair.pooling) {
    const std::string flip = pair.hdr ? "hdrflip" : "flip";
    for (const auto& [name, value] : {std::pair{"weighted median", pair.pooling->weightedMedian},
                                      {"weighted Q1", pair.pooling->weightedQ1},
                                      {"weighted Q3", pair.pooling->weightedQ3},
                                      {"min", pair.pooling->min}})
      out += fmt::format("{} {:.6f}\n", base::fitColumns(flip + " " + name, width), value);
    out += fmt::format(
        "(weighted: pixels count by their error, as in NVIDIA's tool; in {}.p50 all pixels count the same)\n", flip);
  }
  if (row.figures.find("bias.ev")) out += describeBias(row.figures, "the test") + "\n";
  return out;
}

// What a table has room for: what is judged, each metric's first figure, and FLIP's tail.
std::vector<std::string> columnsOf(const FlipResult& result) {
  std::vector<std::string> columns;
  const auto add = [&](const std::string& name) {
    if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
  };
  for (const FlipPair& pair : result.pairs)
    for (const FlipRow& row : pair.rows)
      for (const CheckResult& check : row.checks) add(check.metric);
  for (const Metric& metric : metricRegistry())
    for (const FlipPair& pair : result.pairs)
      for (const FlipRow& row : pair.rows)
        for (std::size_t i = 0; i < metric.statistics.size(); ++i) {
          const std::string& name = metric.statistics[i].name;
          if ((i == 0 || name.ends_with("flip.p95") || name.ends_with("flip.max")) && row.figures.find(name)) add(name);
        }
  return columns;
}

// What may be said of a pair whose compared pixels are all the same.
std::string sameness(const FlipPair& pair) {
  return std::string(pair.partial ? "the compared parts are the same" : "identical") +
         (pair.invisible ? ", transparent" : "");
}

using Cells = std::vector<std::string>;

// The first `left` columns flush left, the others flush right; the last one is free text.
std::string layOut(const std::vector<Cells>& lines, std::size_t left) {
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const Cells& line : lines)
    for (std::size_t c = 0; c + 1 < line.size(); ++c) widths[c] = std::max(widths[c], base::displayWidth(line[c]));
  std::string out;
  for (const Cells& line : lines) {
    std::string text;
    for (std::size_t c = 0; c + 1 < line.size(); ++c) {
      const std::string padding(widths[c] - base::displayWidth(line[c]), ' ');
      text += c < left ? line[c] + padding + "  " : padding + line[c] + "  ";
    }
    text += line.back();
    text.erase(text.find_last_not_of(' ') + 1);
    out += text + '\n';
  }
  return out;
}

std::string tabulate(const FlipResult& result) {
  const std::vector<std::string> columns = columnsOf(result);
  Cells head = {"verdict", "pair", "region"};
  head.insert(head.end(), columns.begin(), columns.end());
  head.push_back("");
  std::vector<Cells> lines = {head};
  for (const FlipPair& pair : result.pairs) {
    const std::string name = base::plainLine(pair.files.name);
    if (pair.errorCode != 0) { // whatever was found before is no result
      Cells line(head.size());
      line[0] = word(result, pair.verdict), line[1] = name, line.back() = base::plainLine(pair.reason);
      lines.push_back(line);
      continue;
    }
    for (const FlipRow& row : pair.rows) {
      Cells line = {word(result, row.verdict), name, base::plainLine(row.name)};
      for (const std::string& column : columns) {
        const auto value = row.figures.find(column);
        line.push_back(value ? formatFigure(column, *value) : "");
      }
      line.push_back(row.reason.empty() && pair.identical ? sameness(pair) : base::plainLine(row.reason));
      lines.push_back(line);
    }
  }
  std::string out = layOut(lines, 3);
  for (const FlipPair& pair : result.pairs)
    for (const std::string& note : pair.notes)
      out += fmt::format("note: {}: {}\n", base::plainLine(pair.files.name), base::plainLine(note));
  return out;
}

std::string describeOutcome(const FlipResult& result) {
  std::size_t failed = 0, errors = 0, warned = 0;
  const FlipPair* first = nullptr;
  const Verdict worst = worstVerdict(result);
  for (const FlipPair& pair : result.pairs) {
    failed += pair.verdict == Verdict::fail;
    errors += pair.verdict == Verdict::error;
    warned += pair.verdict == Verdict::warn;
    if (!first && pair.verdict == worst) first = &pair;
  }
  const std::size_t count = result.pairs.size();
  const std::string reason = first ? base::plainLine(first->reason) : "";
  if (count > 1 && failed + errors > 0) {
    std::string what = failed > 0 ? fmt::format("FAIL: {} of {} pairs", failed, count) : "";
    if (errors > 0)
      what += failed > 0 ? fmt::format(", and {} could not be judged", errors)
                         : fmt::format("ERROR: {} of {} pairs could not be judged", errors, count);
    return fmt::format("{}; {}: {}", what, base::plainLine(first->files.name), reason);
  }
  if (failed + errors > 0) return fmt::format("{}: {}", word(result, worst), reason);
  if (warned > 0)
    return count > 1 ? fmt::format("warning: {} of {} pairs; {}: {}", warned, count, base::plainLine(first->files.name),
                                   reason)
                     : fmt::format("warning: {}", reason);
  if (count == 1 && result.pairs[0].identical) {
    const FlipPair& pair = result.pairs[0];
    const char* what = pair.partial ? "the compared parts of the files are identical" : "identical";
    return fmt::format("{}{}: every pixel is the same{}", result.judged ? "pass, " : "", what,
                       pair.invisible ? ", but all are transparent, so nothing is visible"
                       : pair.black   ? ", and black in both"
                                      : "");
  }
  const auto same = static_cast<std::size_t>(std::count_if(
      result.pairs.begin(), result.pairs.end(), [](const FlipPair& p) { return p.identical && !p.partial; }));
  const std::string identical = same > 0 ? fmt::format(", {} of them identical", same) : "";
  if (count > 1)
    return fmt::format("{}: {} pairs{}", result.judged ? "pass, within the limits" : "compared, no limits were given",
                       count, identical);
  return result.judged ? "pass: within the limits" : "compared: no limits were given";
}

} // namespace

std::string toTable(const FlipResult& result) {
  const bool single = result.pairs.size() == 1 && result.pairs[0].rows.size() == 1;
  return (single ? listFigures(result.pairs[0]) : tabulate(result)) + describeOutcome(result) + "\n";
}

} // namespace parity::compare
