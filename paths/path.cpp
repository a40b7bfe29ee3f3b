#include "paths/path.h"

#include <algorithm>

namespace parity::paths {

std::optional<std::uint32_t> placeOf(const std::vector<Intermediate>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &Intermediate::name);
  if (found == all.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - all.begin());
}

} // namespace parity::paths
