// How the values of an engine's picture become light: by a known transfer, or by a curve that its calibration tells.
#pragma once

#include <string>
#include <variant>

#include "external/fitted_curve.h"
#include "external/transfer.h"

namespace parity::external {

inline constexpr const char* kFitted = "fitted"; // a suite's transfer: the curve of the calibration's picture

class Encoding {
public:
  Encoding(Transfer transfer) : m_how(transfer) {} // NOLINT(google-explicit-constructor): a transfer is one
  explicit Encoding(FittedCurve curve) : m_how(std::move(curve)) {}

  std::string name() const; // as a suite says it
  bool isLinear() const;
  Rgb decode(const Rgb& value) const;
  // Whether the value tells no more of some channel than "at least this much light".
  bool isClipped(const Rgb& value) const;

private:
  std::variant<Transfer, FittedCurve> m_how;
};

} // namespace parity::external
