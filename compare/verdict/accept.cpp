#include "compare/verdict/accept.h"

#include <algorithm>
#include <iterator>

namespace parity::compare {

const char* nameOf(Accept accept) {
  switch (accept) {
  case Accept::notSeen:
    return "not seen";
  case Accept::tooSmall:
    return "too small";
  case Accept::notJudged:
    return "not judged";
  case Accept::clipped:
    return "clipped";
  case Accept::baseLayerOnly:
    return "base layer only";
  case Accept::nonFinite:
    return "non-finite";
  case Accept::noLimit:
    return "no limit";
  }
  return "no limit";
}

std::optional<Accept> acceptByName(std::string_view name) {
  const auto* const found = std::ranges::find(kAccepts, name, [](Accept each) { return nameOf(each); });
  return found == std::end(kAccepts) ? std::nullopt : std::optional(*found);
}

std::vector<std::string_view> acceptNames() {
  std::vector<std::string_view> names;
  for (const Accept each : kAccepts) names.emplace_back(nameOf(each));
  return names;
}

bool isOfWholes(Accept accept) { return accept != Accept::tooSmall && accept != Accept::baseLayerOnly; }

} // namespace parity::compare
