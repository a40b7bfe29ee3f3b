// What several renderers read, made once.
#pragma once

#include <any>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "base/background.h"

namespace parity::paths {

// Objects by name. Lives as long as the renderers that read them. Not thread-safe.
class Store {
public:
  // The object of that name; `make` returns it by value where there is none yet. One name has one type.
  template <typename Make> auto get(const std::string& name, const Make& make) {
    using T = decltype(make());
    std::any& any = m_objects[name];
    if (const auto* begun = std::any_cast<base::Background<std::shared_ptr<T>>>(&any)) any = begun->get();
    if (!any.has_value()) any = std::make_shared<T>(make());
    return std::any_cast<std::shared_ptr<T>>(any).get();
  }

  // Begins to make the object of that name in the background, if there is none, for get() to wait for. What `make`
  // refers to must outlive the store.
  template <typename Make> void begin(const std::string& name, const Make& make) {
    using T = decltype(make());
    std::any& any = m_objects[name];
    if (any.has_value()) return;
    any = base::Background<std::shared_ptr<T>>::begin([make] { return std::make_shared<T>(make()); });
  }

private:
  std::map<std::string, std::any> m_objects;
};

} // namespace parity::paths
