// The functions of a path's shader that a preset folder may define, as the shader declares them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace parity::paths {

struct PresetFunction {
  std::string name;      // "presetEnvironmentBrdf"
  std::string prototype; // "real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV);"
  std::string words;     // the comment above it: what it returns, units and ranges; lines as they stand
  std::string macro() const { return "PARITY_OWN_" + name; }
};

// Those of a text of declarations (shading/mobile_preset.glsl), in its order:
//   // comment
//   #ifdef PARITY_OWN_name
//   prototype
//   #endif
std::vector<PresetFunction> presetFunctionsOf(std::string_view declarations);

// The text with blanks in place of comments and of the preprocessor's lines; line feeds stay.
std::string withoutComments(std::string_view text);

// The paths of its #include directives.
std::vector<std::string> includesOf(std::string_view glsl);

// A definition of a function: `name(...) {`.
struct DefinedFunction {
  std::string name;
  std::size_t line = 0; // from 1
};

// The functions that a text of GLSL defines outside of any other, comments left out.
std::vector<DefinedFunction> definedFunctionsOf(std::string_view glsl);

} // namespace parity::paths
