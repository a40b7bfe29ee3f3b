#include "external/encoding.h"

#include <algorithm>

namespace parity::external {

std::string Encoding::name() const {
  const Transfer* transfer = std::get_if<Transfer>(&m_how);
  return transfer ? nameOf(*transfer) : kFitted;
}

bool Encoding::isLinear() const {
  const Transfer* transfer = std::get_if<Transfer>(&m_how);
  return transfer && *transfer == Transfer::linear;
}

Rgb Encoding::decode(const Rgb& value) const {
  if (const FittedCurve* curve = std::get_if<FittedCurve>(&m_how)) return curve->light(value);
  return external::decode(std::get<Transfer>(m_how), value);
}

bool Encoding::isClipped(const Rgb& value) const {
  if (const FittedCurve* curve = std::get_if<FittedCurve>(&m_how)) return curve->isClipped(value);
  return !isLinear() && std::ranges::any_of(value, [](double v) { return v >= 1; });
}

} // namespace parity::external
