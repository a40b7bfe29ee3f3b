#include "job/scene_work.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/log.h"
#include "gpu/device/compiler_effort.h"
#include "job/scene_times.h"
#include "scenes/names.h"

namespace parity::job {
namespace {

struct Promise {
  std::string_view text;
  double seconds;
};
// From seven assets on two cores (docs/benchmarks.md, many scenes).
constexpr double kLobe = 0.6, kLights = 0.6, kTexture = 0.1;
constexpr std::array<Promise, 12> kPromises = {{{"KHR_materials_clearcoat", kLobe},
                                                {"KHR_materials_sheen", kLobe},
                                                {"KHR_materials_anisotropy", kLobe},
                                                {"KHR_materials_iridescence", kLobe},
                                                {"KHR_materials_transmission", kLobe},
                                                {"KHR_materials_diffuse_transmission", kLobe},
                                                {"KHR_lights_punctual", kLights},
                                                {"\"baseColorTexture\"", kTexture},
                                                {"\"metallicRoughnessTexture\"", kTexture},
                                                {"\"normalTexture\"", kTexture},
                                                {"\"occlusionTexture\"", kTexture},
                                                {"\"emissiveTexture\"", kTexture}}};

// A MiB of it at most: most of the JSON of a .gltf, and of a .glb, where it comes first. Opening a pipe would wait.
std::string beginningOf(const std::string& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return {};
  std::string text(std::size_t{1} << 20, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return text;
}

// Of these places.
std::vector<double> secondsOf(const base::Cache& cache, const std::vector<SceneRequest>& scenes,
                              const std::vector<std::size_t>& places) {
  std::vector<double> seconds;
  std::vector<bool> isKnown;
  double known = 0, promised = 0; // of the known ones
  for (const std::size_t i : places) {
    const std::optional<double> time = findSceneTime(cache, scenes[i]);
    seconds.push_back(promisedWork(scenes[i]));
    isKnown.push_back(time.has_value());
    if (!time) continue;
    known += *time;
    promised += seconds.back();
    seconds.back() = *time;
  }
  for (std::size_t i = 0; i < seconds.size(); ++i)
    if (!isKnown[i] && known > 0) seconds[i] *= known / promised;
  return seconds;
}

} // namespace

double promisedWork(const SceneRequest& scene) {
  double seconds = 1;
  if (scenes::isBuiltin(scene.scene)) return seconds;
  const std::string text = beginningOf(scene.scene);
  for (const Promise& promise : kPromises)
    if (text.find(promise.text) != std::string::npos) seconds += promise.seconds;
  return seconds;
}

std::vector<std::size_t> orderOfBlock(const base::Cache& cache, const std::vector<SceneRequest>& requests,
                                      std::size_t begin) {
  const std::size_t left = requests.size() - begin, size = left == 0 ? 0 : (left - 1) % kScenesInBlock + 1;
  std::vector<std::size_t> places(size), order(size), result;
  std::iota(places.begin(), places.end(), begin);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::vector<double> seconds = secondsOf(cache, requests, places);
  std::map<std::pair<std::string, float>, std::size_t> firstUnder; // of each environment
  std::vector<std::size_t> first;
  for (const std::size_t i : places) {
    const scenes::SceneSettings& s = requests[i].settings.scene;
    first.push_back(firstUnder.try_emplace({s.environment, s.environmentRotationDeg}, i).first->second);
  }
  std::ranges::stable_sort(order, std::ranges::less(),
                           [&](std::size_t i) { return std::tuple(first[i], -seconds[i]); });
  for (const std::size_t i : order) result.push_back(places[i]);
  return result;
}

std::uint64_t samplesOfAScene(const std::vector<SceneRequest>& scenes) {
  std::uint64_t samples = 0;
  for (const SceneRequest& scene : scenes) {
    const Settings& s = scene.settings;
    const std::size_t views = scene.partOf ? scene.partOf->views : scene.views.size();
    samples += std::max<std::uint64_t>(views, 1) * static_cast<std::uint64_t>(s.width) *
               static_cast<std::uint64_t>(s.height) * static_cast<std::uint64_t>(s.samples);
  }
  return scenes.empty() ? 0 : samples / scenes.size();
}

void chooseCompilerEffort(const std::vector<SceneRequest>& scenes) {
  if (samplesOfAScene(scenes) > kQuickCompilationSamples) return;
  base::logDetail("the pictures are small: GALLIVM_PERF=nopt, unless the environment says otherwise");
  gpu::askForQuickCompilation();
}

} // namespace parity::job
