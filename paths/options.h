// The options of every path in one value, each of its own type.
#pragma once

#include <any>
#include <map>
#include <typeindex>

#include "base/knob/table.h"

namespace parity::paths {

// Options by their type. A path that nobody has set has the defaults of its type.
class Options {
public:
  template <typename T> T& of() {
    std::any& any = m_options[typeid(T)];
    if (!any.has_value()) any = T{};
    return *std::any_cast<T>(&any);
  }
  template <typename T> const T& of() const {
    static const T plain{};
    const auto found = m_options.find(typeid(T));
    return found == m_options.end() ? plain : *std::any_cast<T>(&found->second);
  }

private:
  std::map<std::type_index, std::any> m_options;
};

// The rows of one path's table, over the options of all.
template <typename T> base::KnobTable<Options> knobsOf(const base::KnobTable<T>& table) {
  base::KnobTable<Options> all;
  all.addAllAt(
      table, [](auto& options) -> auto& { return options.template of<T>(); });
  return all;
}

} // namespace parity::paths
