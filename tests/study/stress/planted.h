// A function made up for a test: r and c in, one number out, with what the test claims of it.
#pragma once

#include "study/stress/function_stress.h"

namespace parity::tests {

inline stress::FunctionCase makePlanted() {
  stress::FunctionCase function;
  function.name = "planted";
  function.id = -1;
  function.takes({stress::unit(0, "r"), stress::unit(1, "c")}).gives(1, 1);
  return function;
}

// The same double arithmetic in every precision.
template <typename F>
stress::FunctionResult run(const stress::FunctionCase& function, F f, std::uint32_t points = 20'000) {
  return stress::stressOnCpu(function, points, [&](stress::Precision, const stress::Row& row) {
    stress::Result result{};
    result[0] = f(row[0], row[1]);
    return result;
  });
}

// The findings that are not expected, of half.
inline std::vector<stress::Finding> unexpectedOf(const stress::FunctionResult& result) {
  std::vector<stress::Finding> found;
  for (const stress::Finding& finding : stress::findingsOf(result))
    if (!finding.expected && finding.place == "cpu fp16") found.push_back(finding);
  return found;
}

} // namespace parity::tests
