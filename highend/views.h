// The intermediates of the high-end path that can be looked at: `parity render --path highend --term NAME`. Those that
// the mobile path has, too, have the same names there (mobile/views.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "highend/shaders/views.h"

namespace parity::highend {

struct View {
  std::string_view name;
  std::string_view meaning;
};

// By number (highend/shaders/views.h). The first is the lit picture.
extern const std::array<View, kViewCount> kViews;

// The number of that name, or nothing.
std::optional<std::uint32_t> viewByName(const std::string& name);

} // namespace parity::highend
