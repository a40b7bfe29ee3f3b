// Presets as the tests of formulas take them.
#pragma once

#include "mobile/options.h"

namespace parity::tests {

// In fp32, whose formulas are held against double; with a capture of floats, as the tests' environments are.
inline mobile::Options inFp32(const char* preset) {
  mobile::Options options = mobile::presetByName(preset);
  options.precision = mobile::Precision::fp32;
  options.capture = mobile::CaptureEncoding::fp16;
  return options;
}

} // namespace parity::tests
