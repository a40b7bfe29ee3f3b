#include "compare/encoding.h"

#include <cmath>

#include <fmt/format.h>

#include "compare/wording.h"

namespace parity::compare {

namespace {

constexpr double kNotable = 0.0005; // what three digits show

const Figures& figuresOf(const Encoding& encoding, bool whole) {
  return whole ? encoding.figures.all : mainFigures(encoding.figures);
}

} // namespace

bool isNotable(const std::optional<Encoding>& encoding) {
  if (!encoding) return false;
  const std::optional<double> mean = encoding->figures.all.find("flip.mean");
  return mean && !(*mean < kNotable);
}

std::string describeEncoding(const std::optional<Encoding>& encoding, bool whole) {
  if (!encoding) return {};
  const Figures& figures = figuresOf(*encoding, whole);
  if (figures.pixels == 0) return {};
  const auto figure = [&](const char* name) { return formatFigure(name, figures.find(name).value_or(std::nan(""))); };
  if (figures.nonFinite == 0 && figures.find("flip.max") == 0.)
    return fmt::format("stored in {}: no difference", encoding->target);
  return fmt::format("stored in {}: FLIP {} on average, {} p95, {} at most; {}", encoding->target, figure("flip.mean"),
                     figure("flip.p95"), figure("flip.max"), describeBias(figures, "it"));
}

} // namespace parity::compare
