#include "compare/encoding.h"

namespace parity::compare {

namespace {

constexpr double kNotable = 0.0005; // what three digits show

} // namespace

bool isNotable(const std::optional<Encoding>& encoding) {
  if (!encoding) return false;
  const std::optional<double> mean = encoding->figures.find("flip.mean");
  return mean && !(*mean < kNotable);
}

} // namespace parity::compare
