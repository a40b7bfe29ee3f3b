#include "highend/views.h"

#include <algorithm>

namespace parity::highend {

const std::array<View, kViewCount> kViews = {{
    {"Lit", "all of it"},
    {"EnvBRDF.A", "of the table: what F0 is multiplied with"},
    {"EnvBRDF.B", "of the table: what F90 is multiplied with, in all three channels"},
    {"EnvBRDF", "F0 A + F90 B: the specular lobe's albedo, of light scattered once"},
    {"EnvBRDF.Multiple", "what the compensation adds to it; 0 with --compensation none"},
    {"SpecularIBL", "the environment as read (--off-specular), in the sky light's colour and occlusion"},
}};

std::optional<std::uint32_t> viewByName(const std::string& name) {
  const auto found = std::find_if(kViews.begin(), kViews.end(), [&](const View& view) { return view.name == name; });
  if (found == kViews.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - kViews.begin());
}

} // namespace parity::highend
