#include "highend/views.h"

#include <iterator>

namespace parity::highend {

const std::vector<View>& views() {
  static constexpr View kViews[] = {
      {"Lit", "all of it"},
      {"EnvBRDF.A", "of the table: what F0 is multiplied with"},
      {"EnvBRDF.B", "of the table: what F90 is multiplied with, in all three channels"},
      {"EnvBRDF", "F0 A + F90 B: the specular lobe's albedo, of light scattered once"},
      {"EnvBRDF.Multiple", "what the compensation adds to it; 0 with --compensation none"},
      {"SpecularIBL", "the environment as read (--off-specular), in the sky light's colour and occlusion"},
  };
  static_assert(std::size(kViews) == kViewCount);
  static const std::vector<View> all(std::begin(kViews), std::end(kViews));
  return all;
}

} // namespace parity::highend
