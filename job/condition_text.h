// Values of conditions in words.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace parity::job {

std::string placesText(const std::vector<glm::vec3>& places); // "x,y,z; x,y,z", which reads back as the very same
std::string wordsOf(const std::vector<std::string>& list, const char* none);

} // namespace parity::job
