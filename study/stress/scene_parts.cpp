#include "study/stress/scene_parts.h"

#include <cstring>

#include <fmt/format.h>

namespace parity::stress::parts {

std::vector<std::string> requireZero(const PathFrame& path, const std::vector<Term>& terms) {
  std::vector<std::string> wrong;
  for (const Term term : terms)
    if (const float most = greatest(termOf(path, term)); most > 0)
      wrong.push_back(
          fmt::format("{}: {} is {:.4g}, not 0", path.path, shading::kTermNames[static_cast<std::size_t>(term)], most));
  return wrong;
}

std::vector<std::string> requireWithinHalf(const SceneFrames& frames) {
  std::vector<std::string> wrong;
  for (const PathFrame& path : frames.paths)
    if (const float most = greatest(path.frame.color); !path.preset.empty() && most > 65504)
      wrong.push_back(fmt::format("{}: {:.6g} is more than a half target can hold", path.path, most));
  return wrong;
}

std::vector<std::string> requireSame(const SceneFrames& frames, const SceneFrames* twin, const std::string& as) {
  std::vector<std::string> wrong;
  for (std::size_t p = 0; twin && p < frames.paths.size(); ++p) {
    const std::vector<float>&a = frames.paths[p].frame.color.pixels, &b = twin->paths[p].frame.color.pixels;
    if (a.size() != b.size() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) != 0)
      wrong.push_back(fmt::format("{}: differs from the picture of {}", frames.paths[p].path, as));
  }
  return wrong;
}

} // namespace parity::stress::parts
