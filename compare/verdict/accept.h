// What a budget rule may accept although it is no pass. The rule gives its reason, and reports show both.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace parity::compare {

enum class Accept {
  notSeen,       // no view shows the material, or no pixel of the view a material
  tooSmall,      // fewer pixels than the rule's min_pixels
  notJudged,     // most pixels are clipped in both pictures, or both are too dark for all of the rule's figures
  clipped,       // a notable share of the pixels is clipped in both pictures
  baseLayerOnly, // parts that no path models
  nonFinite,     // NaN or infinite pixels, up to the rule's max_non_finite
  noLimit        // no limit judges it, whatever its figures are
};
inline constexpr Accept kAccepts[] = {Accept::notSeen,       Accept::tooSmall,  Accept::notJudged, Accept::clipped,
                                      Accept::baseLayerOnly, Accept::nonFinite, Accept::noLimit};

// As budget files and reports name it: "not seen", "base layer only".
const char* nameOf(Accept accept);
std::optional<Accept> acceptByName(std::string_view name);
std::vector<std::string_view> acceptNames();

// Whether it may be accepted of a whole image.
bool isOfWholes(Accept accept);

} // namespace parity::compare
