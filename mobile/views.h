// The intermediates of the mobile base pass that can be looked at: `parity render --path mobile --term NAME`.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mobile/shaders/views.h"

namespace parity::mobile {

struct View {
  std::string_view name; // as in Unreal Engine 4's base pass, where it has a name
  std::string_view meaning;
};

// By number (mobile/shaders/views.h). The first is the lit picture.
extern const std::array<View, kViewCount> kViews;

// The number of that name, or nothing.
std::optional<std::uint32_t> viewByName(const std::string& name);

} // namespace parity::mobile
