// A fit as text: GLSL, HLSL or JSON.
#pragma once

#include <string>

#include "study/fit/refit.h"

namespace parity::fit {

// To the six significant digits that are printed.
double roundConstant(double value);

enum class Language { glsl, hlsl };

// Constants named as in docs/refit.md, below comments with the settings, the forms and the errors.
std::string formatShader(const Refit& refit, Language language);
// The same as one object: settings, constants, errors.
std::string formatJson(const Refit& refit);

} // namespace parity::fit
