// The terms of a path's light in words: one table for the terminal, JUnit, annotations and the page.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace parity::report {

struct TermWords {
  std::string_view term, words;
};

// In the order of shading::kTermNames (shading/terms.h), which this folder may not include; a test compares the two.
inline constexpr std::array<TermWords, 12> kTermWords = {
    {{"sunDiffuse", "diffuse light of the sun"},
     {"sunSpecular", "highlights of the sun"},
     {"localDiffuse", "diffuse light of local lights"},
     {"localSpecular", "highlights of local lights"},
     {"lightmap", "light of the lightmap"},
     {"skyDiffuse", "diffuse light of the environment"},
     {"skySpecular", "reflections of the environment"},
     {"emissive", "emitted light"},
     {"fog", "light of the fog"},
     {"coatSpecular", "reflections and highlights of the clear coat"},
     {"sheen", "light of the sheen"},
     {"transmission", "light through the surface"}}};

// "skySpecular (reflections of the environment)"; a term without words by its name alone.
std::string termWithWords(const std::string& term);

} // namespace parity::report
