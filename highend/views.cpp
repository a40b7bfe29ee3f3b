#include "highend/views.h"

#include <iterator>

namespace parity::highend {

const std::vector<View>& views() {
  static constexpr View kViews[] = {
      {"Lit", "all light together"},
      {"EnvBRDF.A", "scale of F0, from the table"},
      {"EnvBRDF.B", "scale of F90, from the table; the same in all three channels"},
      {"EnvBRDF", "F0 A + F90 B: albedo of the specular lobe for single scattering"},
      {"EnvBRDF.Multiple", "addition of the compensation to EnvBRDF; 0 with --compensation none"},
      {"SpecularIBL", "environment as read (--off-specular), times colour and occlusion of the sky light"},
  };
  static_assert(std::size(kViews) == kViewCount);
  static const std::vector<View> all(std::begin(kViews), std::end(kViews));
  return all;
}

} // namespace parity::highend
