// The terms that a path's colour is the sum of (docs/design.md 6a): ids and names, for C++ and GLSL.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace parity::shading {

// Order of the images in base::Frame::terms and of the planes that the shaders write (shading/terms.glsl).
enum class Term : int {
  sunDiffuse, // directional lights
  sunSpecular,
  localDiffuse, // point and spot lights
  localSpecular,
  lightmap,
  skyDiffuse,  // environment, by SH
  skySpecular, // environment, by the prefiltered cube
  emissive,
  fog,          // inscattered light; all others are after fog transmittance
  coatSpecular, // of every light and the environment, by the clear coat
  sheen,        // likewise, by the fibres
  transmission, // of what lies behind, by a surface that lets light through
};
inline constexpr std::size_t kTermCount = 12;
inline constexpr std::size_t kBaseTermCount = 9; // of scenes without lobes beside the base's own: those up to fog
inline constexpr std::array<std::string_view, kTermCount> kTermNames = {
    "sunDiffuse",  "sunSpecular", "localDiffuse", "localSpecular", "lightmap", "skyDiffuse",
    "skySpecular", "emissive",    "fog",          "coatSpecular",  "sheen",    "transmission"};

// Whether lights alone add to the term: none of the environment, of lightmaps or of the material's own light.
constexpr bool isOfLightsAlone(std::size_t term) { return term <= static_cast<std::size_t>(Term::localSpecular); }

// The term of that name, or nothing.
constexpr std::optional<Term> termByName(std::string_view name) {
  for (std::size_t i = 0; i < kTermCount; ++i)
    if (kTermNames[i] == name) return static_cast<Term>(i);
  return std::nullopt;
}

} // namespace parity::shading
