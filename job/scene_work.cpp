#include "job/scene_work.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "gpu/device/compiler_effort.h"
#include "job/scene_times.h"
#include "scenes/names.h"

namespace parity::job {
namespace {

struct Promise {
  std::string_view text;
  double seconds;
};
// As seven assets take on two cores (docs/benchmarks.md).
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

// The JSON of a .gltf, or of a .glb, where it comes first.
std::string beginningOf(const std::string& file) {
  std::string text(std::size_t{1} << 20, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return text;
}

std::vector<double> secondsOf(const base::Cache& cache, const std::vector<SceneRequest>& scenes) {
  if (SceneTimes times = estimateTimes(cache, scenes); times.known > 0) return std::move(times.seconds);
  std::vector<double> seconds;
  for (const SceneRequest& scene : scenes) seconds.push_back(promisedWork(scene));
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

std::vector<std::size_t> orderOfWork(const base::Cache& cache, const std::vector<SceneRequest>& requests) {
  const std::vector<double> seconds = secondsOf(cache, requests);
  std::map<std::pair<std::string, float>, std::size_t> firstUnder; // of each environment
  std::vector<std::size_t> first, order(requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const scenes::SceneSettings& s = requests[i].settings.scene;
    first.push_back(firstUnder.try_emplace({s.environment, s.environmentRotationDeg}, i).first->second);
  }
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) {
    const auto partsAfter = static_cast<int>((requests.size() - 1 - i) / kScenesInOrder); // the last part is whole
    return std::tuple(-partsAfter, first[i], -seconds[i]);
  };
  std::ranges::stable_sort(order, std::ranges::less(), rank);
  return order;
}

std::uint64_t samplesOfAScene(const std::vector<SceneRequest>& scenes) {
  std::uint64_t samples = 0;
  for (const SceneRequest& scene : scenes) {
    const Settings& s = scene.settings;
    samples += std::max<std::uint64_t>(scene.views.size(), 1) * static_cast<std::uint64_t>(s.width) *
               static_cast<std::uint64_t>(s.height) * static_cast<std::uint64_t>(s.samples);
  }
  return scenes.empty() ? 0 : samples / scenes.size();
}

void chooseCompilerEffort(const std::vector<SceneRequest>& scenes) {
  if (samplesOfAScene(scenes) <= kQuickCompilationSamples) gpu::askForQuickCompilation();
}

} // namespace parity::job
