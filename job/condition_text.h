// Values of conditions in words.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace parity::job {

std::string placesText(const std::vector<glm::vec3>& places); // "x,y,z; x,y,z", which reads back as the very same
std::string wordsOf(const std::vector<std::string>& list, const char* none);

template <typename Enum> const std::string& nameAt(const std::vector<std::string>& names, Enum value) {
  return names.at(static_cast<std::size_t>(value));
}

} // namespace parity::job
