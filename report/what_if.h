// What a material's figures and verdict would be with another preset of the test path (--what-if): measured in the same
// run.
#pragma once

#include <string>
#include <vector>

#include "compare/pooling/figures.h"
#include "compare/verdict/check.h"

namespace parity::report {

struct MaterialResult;

struct WhatIf {
  std::string preset;
  compare::Figures figures;
  std::vector<compare::CheckResult> checks;
  compare::Verdict verdict = compare::Verdict::pass;
  std::string reason; // all that decided the verdict; empty on a pass
  std::string words;  // describe()
};

// "with refit: FLIP 0.031 instead of 0.210, +0.02 EV instead of -0.31 EV, pass".
std::string describe(const WhatIf& whatIf, const compare::Figures& now);

// The same of all of a material's, one behind the other; empty where there is none.
std::string describeWhatIfs(const MaterialResult& material);

// The one that would help a material most: the best verdict of pass, warn and fail, then the least mean FLIP. Null
// where none has a better verdict than the material, or the same one with a FLIP that is less by a tenth. It points
// into the material.
const WhatIf* bestWhatIf(const MaterialResult& material);

} // namespace parity::report
