#include "job/condition_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace parity::job {

std::string placesText(const std::vector<glm::vec3>& places) {
  std::vector<std::string> texts;
  for (const glm::vec3& place : places) texts.push_back(fmt::format("{},{},{}", place.x, place.y, place.z));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string wordsOf(const std::vector<std::string>& list, const char* none) {
  return list.empty() ? none : fmt::format("{}", fmt::join(list, ", "));
}

} // namespace parity::job
