#include "base/simd_level.h"

#include <cstdint>

#include <hwy/highway.h>

#include "base/error.h"

namespace parity::base {

std::vector<std::string> simdLevels() {
  std::vector<std::string> names;
  for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.push_back(hwy::TargetName(target));
  return names;
}

void useSimdLevel(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  if (name.empty()) return;
  for (std::int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) return hwy::SetSupportedTargetsForTest(target);
  throw Error(ExitCode::usage, "SIMD level", name, "is not one that this processor can run");
}

} // namespace parity::base
