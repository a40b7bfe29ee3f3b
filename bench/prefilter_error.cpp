// Error of the prefiltered environment against its cost, as Markdown: docs/environments.md.
// Usage: prefilter_error [ENVIRONMENT...]: files or builtin:NAME; default: $PARITY_SHARED/assets/env/*.hdr and two
// built-in ones.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>

#include "lighting/environment/sun_extraction.h"
#include "scenes/load.h"
#include "support/prefilter_truth.h"

namespace {

using namespace parity;

const std::vector<double> kRoughnesses = {0.02, 0.04, 0.06, 0.08, 0.1, 0.125, 0.15, 0.175,
                                          0.2,  0.25, 0.3,  0.4,  0.5, 0.6,   0.7,  0.8};
constexpr std::size_t kSmooth = 8; // of these are below 0.2
constexpr int kDirections = 100;

struct Map {
  scenes::Environment environment;
  std::vector<std::vector<glm::dvec3>> truth;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::vector<std::string> defaultFiles() {
  std::vector<std::string> files;
  const char* shared = std::getenv("PARITY_SHARED");
  const std::filesystem::path folder =
      std::filesystem::path(PARITY_SOURCE_DIR) / (shared ? shared : "../shared") / "assets/env";
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".hdr") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  files.insert(files.end(), {"builtin:sky", "builtin:studio"});
  return files;
}

void printRow(const std::string& name, const std::vector<double>& values) {
  std::printf("| %s |", name.c_str());
  for (const double value : values) std::printf(" %.2f |", 100 * value);
  std::printf(" %.2f |\n", 100 * median(values));
  std::fflush(stdout);
}

class Bench {
public:
  explicit Bench(const std::vector<std::string>& files) : m_directions(tests::makeDirections(kDirections)) {
    for (const std::string& file : files) {
      std::vector<std::string> warnings;
      scenes::Environment left = scenes::loadEnvironment(file, 0, warnings);
      lighting::SunExtraction extraction = lighting::extractSuns(left);
      if (!extraction.suns.empty()) m_left.push_back(makeMap(std::move(left)));
      m_maps.push_back(makeMap(std::move(extraction.environment)));
    }
  }

  void printMaps() const {
    std::printf("| relative RMSE, %% |");
    for (const double roughness : kRoughnesses) std::printf(" %.2f |", roughness);
    std::printf(" median |\n|---|");
    for (std::size_t i = 0; i <= kRoughnesses.size(); ++i) std::printf("---|");
    std::printf("\n");
    std::vector<double> smooth, rough;
    for (const Map& map : m_maps) {
      const std::vector<double> errors = measure(map, lighting::kFinePrefilter, &tests::PrefilterReader::read);
      smooth.insert(smooth.end(), errors.begin(), errors.begin() + kSmooth);
      rough.insert(rough.end(), errors.begin() + kSmooth, errors.end());
      printRow(map.environment.name, errors);
    }
    for (const Map& map : m_left)
      printRow(map.environment.name + ", sun left in",
               measure(map, lighting::kFinePrefilter, &tests::PrefilterReader::read));
    for (const Map& map : m_maps)
      printRow(map.environment.name + ", captures", measure(map, {}, &tests::PrefilterReader::read));
    for (const Map& map : m_maps)
      printRow(map.environment.name + ", mobile",
               measure(map, {.levels = lighting::PrefilterLevels::first}, &tests::PrefilterReader::readTrilinear));
    std::printf("\nMedian over the maps without suns and roughnesses: %.2f %% below .2, %.2f %% from there on.\n\n",
                100 * median(smooth), 100 * median(rough));
  }

  void printSettings() const {
    std::printf(
        "| faces | samples | footprint, log2 | median, %% | worst, %% | CPU time, s |\n|---|---|---|---|---|---|\n");
    const lighting::PrefilterOptions chosen = lighting::kFinePrefilter;
    printSetting(chosen);
    for (const int count : {64, 256}) {
      lighting::PrefilterOptions options = chosen;
      options.sampleCount = count;
      printSetting(options);
    }
    for (const double footprint : {-0.3, 0.3, 0.6}) {
      lighting::PrefilterOptions options = chosen;
      options.footprintLog2 = footprint;
      printSetting(options);
    }
    lighting::PrefilterOptions small = chosen;
    small.faceSize = 128;
    printSetting(small);
  }

private:
  using Read = glm::dvec3 (tests::PrefilterReader::*)(const glm::dvec3&, double) const;

  Map makeMap(scenes::Environment environment) const {
    Map map{std::move(environment), {}};
    map.truth = tests::integrateLobes(map.environment, m_directions, kRoughnesses);
    return map;
  }

  std::vector<double> measure(const Map& map, const lighting::PrefilterOptions& options, Read read) const {
    const lighting::PanoramaCells cells = lighting::makePanoramaCells(map.environment);
    const tests::PrefilterReader reader(lighting::makeEnvironmentLight(map.environment, options),
                                        options.levels == lighting::PrefilterLevels::fine ? &cells : nullptr);
    return tests::relativeRmse(map.truth, m_directions, kRoughnesses, std::bind_front(read, &reader));
  }

  void printSetting(const lighting::PrefilterOptions& options) const {
    std::vector<double> all;
    double seconds = 1e30; // of all threads; the least of the maps
    for (const Map& map : m_maps) {
      const std::clock_t begin = std::clock();
      const lighting::EnvironmentLight light = lighting::makeEnvironmentLight(map.environment, options);
      seconds = std::min(seconds, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
      const lighting::PanoramaCells cells = lighting::makePanoramaCells(map.environment);
      const tests::PrefilterReader reader(light, &cells);
      const std::vector<double> errors = tests::relativeRmse(map.truth, m_directions, kRoughnesses,
                                                             std::bind_front(&tests::PrefilterReader::read, &reader));
      all.insert(all.end(), errors.begin(), errors.end());
    }
    std::printf("| %d | %d | %.1f | %.2f | %.1f | %.2f |\n", options.faceSize, options.sampleCount,
                options.footprintLog2, 100 * median(all), 100 * *std::max_element(all.begin(), all.end()), seconds);
    std::fflush(stdout);
  }

  std::vector<glm::dvec3> m_directions;
  std::vector<Map> m_maps, m_left; // without their suns; as they were, where they had any
};

} // namespace

int main(int argc, char** argv) {
  try {
    const Bench bench(argc > 1 ? std::vector<std::string>(argv + 1, argv + argc) : defaultFiles());
    bench.printMaps();
    bench.printSettings();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 4;
  }
}
