#include "job/scene_times.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <span>

#include "base/hash.h"
#include "job/knobs.h"
#include "scenes/names.h"

namespace parity::job {
namespace {

// The same file from whatever folder the program is started.
std::string wholePath(const std::string& file) {
  std::error_code none;
  return file.empty() || scenes::isBuiltin(file) ? file : std::filesystem::weakly_canonical(file, none).string();
}

std::string keyOf(const SceneRequest& request) {
  base::Hasher hasher;
  hasher.add(wholePath(request.scene)).addValue(static_cast<std::uint64_t>(request.views.size()));
  for (const auto& row : knobs().rows())
    if (row.knob.ofScene)
      hasher.add(row.knob.id).add(row.path ? wholePath(row.path(request.settings)) : row.text(request.settings));
  return "time-" + hasher.hex();
}

} // namespace

void keepSceneTime(const base::Cache& cache, const SceneRequest& request, double seconds) {
  if (cache.enabled()) cache.store(keyOf(request), std::as_bytes(std::span{&seconds, 1}));
}

std::optional<double> findSceneTime(const base::Cache& cache, const SceneRequest& request) {
  if (!cache.enabled()) return std::nullopt;
  const auto bytes = cache.find(keyOf(request));
  double seconds = 0;
  if (!bytes || bytes->size() != sizeof seconds) return std::nullopt;
  std::memcpy(&seconds, bytes->data(), sizeof seconds);
  if (!std::isfinite(seconds) || seconds < 0) return std::nullopt;
  return seconds;
}

SceneTimes estimateTimes(const base::Cache& cache, const std::vector<SceneRequest>& requests) {
  std::vector<std::optional<double>> found;
  std::vector<double> known;
  for (const SceneRequest& request : requests) {
    found.push_back(findSceneTime(cache, request));
    if (found.back()) known.push_back(*found.back());
  }
  SceneTimes times{.seconds = {}, .known = known.size()};
  if (known.empty()) return times;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::ranges::nth_element(known, middle);
  for (const std::optional<double>& seconds : found) times.seconds.push_back(seconds.value_or(*middle));
  return times;
}

} // namespace parity::job
