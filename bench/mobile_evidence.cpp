// How close each mobile preset is to the high-end path, material by material, and what it costs: all scenes under three
// environments, with and without a sun. build/mobile_evidence [FOLDER] writes mobile-parity.md and mobile-parity.png
// there (default: docs).
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/file.h"
#include "base/image/image_io.h"
#include "bench/parity_table.h"
#include "compare/flip/flip.h"
#include "compare/flip/magma.h"
#include "compare/metrics/measure_swaps.h"
#include "job/scene/scene_renderer.h"
#include "job/view/displayed.h"
#include "job/view/material_swaps.h"
#include "mobile/options.h"
#include "scenes/builtin/builtin.h"
#include "scenes/view.h"

namespace {

using namespace parity;
using bench::kPresetCount;

constexpr int kErrorSize = 256, kTimeSize = 512, kTimeRounds = 5, kPictureSize = 192;

// A garden whose sun is in the map, lamps at night, softboxes: more maps say little more, and take as much longer.
constexpr std::array kEnvironments = {"chinese_garden_1k", "st_peters_square_night_1k", "studio_small_05_1k"};

// Real assets where they are, else built-in ones alone.
struct Inputs {
  std::vector<std::string> scenes, environments;
};
Inputs findInputs() {
  const char* variable = std::getenv("PARITY_SHARED");
  const std::filesystem::path assets = std::filesystem::path(variable ? variable : "../shared") / "assets";
  Inputs inputs;
  for (const std::string& name : scenes::builtinSceneNames()) inputs.scenes.push_back("builtin:" + name);
  if (!std::filesystem::exists(assets)) {
    inputs.environments = {"builtin:studio", "builtin:sky", "builtin:night"};
    return inputs;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(assets)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb") inputs.scenes.push_back(entry.path().string());
    if (extension == ".hdr" && std::ranges::find(kEnvironments, entry.path().stem()) != kEnvironments.end())
      inputs.environments.push_back(entry.path().string());
  }
  std::sort(inputs.scenes.begin(), inputs.scenes.end());
  std::sort(inputs.environments.begin(), inputs.environments.end());
  return inputs;
}

std::string shortName(const std::string& file) {
  return file.starts_with("builtin:") ? file : std::filesystem::path(file).stem().string();
}

job::Settings settingsOf(const std::string& preset, int size) {
  job::Settings s;
  s.width = s.height = size;
  s.of<mobile::Options>() = mobile::presetByName(preset);
  s.cacheFolder = base::defaultCacheFolder();
  return s;
}

// A renderer with all that it refers to.
struct Bench {
  job::Context context;
  job::SceneRenderer renderer;
  scenes::Camera camera;
  Bench(const job::PreparedScene& prepared, const job::Settings& settings, const job::PathChoice& paths)
      : context(settings), renderer(context, prepared, context.settings(), paths, 1),
        camera(scenes::makeCamera(prepared.scene, {}, 1)) {}
};

job::SceneRequest requestOf(const std::string& scene, const std::string& environment, bool sun) {
  job::SceneRequest request;
  request.scene = scene;
  request.settings.scene.environment = environment;
  if (sun) request.settings.scene.sun = scenes::SunRequest{30, 50, 4};
  request.views = {{}};
  return request;
}

bool leavesSunOut(const job::SceneRenderer& renderer) {
  const std::vector<std::string> notes = renderer.notes();
  return std::any_of(notes.begin(), notes.end(),
                     [](const std::string& note) { return note.find("directional") != std::string::npos; });
}

// One row of the contact sheet: the high-end path, each preset, each preset's FLIP map.
using Strip = std::vector<base::Image8>;

Strip compareScene(const job::PreparedScene& prepared, const std::string& scene, const std::string& environment,
                   bool sun, bench::ParityTable& table) {
  job::Displayed highend;
  std::vector<bench::MaterialFlip> rows;
  Strip strip, maps;
  for (std::size_t p = 0; p < kPresetCount; ++p) {
    Bench bench(prepared, settingsOf(bench::kPresets[p], kErrorSize), {.chosen = job::allPaths()});
    const job::ViewFrames frames = bench.renderer.render(bench.camera);
    const job::Displayed test = job::displayImage(frames.paths[1].frame.color, bench.context.display(), 0);
    if (p == 0) {
      highend = job::displayImage(frames.first().frame.color, bench.context.display(), 0);
      strip.push_back(highend.pixels);
    }
    std::vector<compare::Swap> swaps;
    for (std::size_t m = 0; m < frames.coverage.size(); ++m) {
      const base::PixelList& list = frames.coverage[m];
      if (list.pixels.empty()) continue;
      swaps.push_back(job::displaySwap(bench.context, list, frames.paths[1].swap[m], 0, 0, &test));
      if (p == 0)
        rows.push_back(
            {shortName(scene), list.name, shortName(environment), sun, leavesSunOut(bench.renderer), {}, {}});
    }
    const std::vector<compare::Figures> figures =
        compare::measureSwaps(job::referenceOf(highend, frames.first().frame.color), swaps,
                              {.statistics = {"flip.mean"}})
            .figures;
    for (std::size_t m = 0; m < rows.size(); ++m) {
      rows[m].flip[p] = figures[m].find("flip.mean").value();
      rows[m].nonFinite[p] = figures[m].nonFinite;
    }
    strip.push_back(test.pixels);
    maps.push_back(job::quantize(compare::magmaImage(compare::flipMap(highend.pixels, test.pixels))));
  }
  table.materials.insert(table.materials.end(), rows.begin(), rows.end());
  strip.insert(strip.end(), maps.begin(), maps.end());
  return strip;
}

double stageMs(const base::Timings& timings, const std::string& stage) {
  for (const auto& [name, timeMs] : timings.stages())
    if (name == stage) return timeMs;
  return 0;
}

// Device time of shading alone, interleaved in random order so that drift cancels; the median. And what is counted.
bench::SceneCost costsOf(const job::PreparedScene& prepared, const std::string& scene) {
  bench::SceneCost result;
  result.scene = shortName(scene);
  std::vector<std::unique_ptr<Bench>> benches;
  for (std::size_t p = 0; p <= kPresetCount; ++p) { // the last is the high-end path
    job::Settings settings = settingsOf(bench::kPresets[std::min(p, kPresetCount - 1)], kTimeSize);
    settings.of<mobile::Options>().precision = mobile::Precision::fp32;
    settings.costs = true;
    const bool highend = p == kPresetCount;
    benches.push_back(
        std::make_unique<Bench>(prepared, settings, job::PathChoice{.chosen = {job::allPaths()[highend ? 0 : 1]}}));
  }
  std::vector<double> last(benches.size(), 0);
  std::vector<std::vector<double>> times(benches.size());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < benches.size(); ++i) order.push_back(i);
  std::mt19937 random(1);
  for (int round = 0; round <= kTimeRounds; ++round) {
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t i : order) {
      benches[i]->renderer.render(benches[i]->camera);
      const double now =
          stageMs(benches[i]->context.timings(), i == kPresetCount ? "device: shade highend" : "device: shade mobile");
      if (round > 0) times[i].push_back(now - last[i]); // the first one compiles
      last[i] = now;
    }
  }
  for (std::size_t i = 0; i < benches.size(); ++i) {
    const std::vector<report::PathCost> costs = report::costsByPath(benches[i]->renderer.permutations());
    result.paths[i] = {bench::medianOf(times[i]), costs.at(0).operations, costs.at(0).fetches, costs.at(0).samplers};
  }
  return result;
}

// Every strip a row, each picture scaled down by whole pixels.
void writeSheet(const std::filesystem::path& file, const std::vector<Strip>& strips) {
  constexpr int kStep = kErrorSize / kPictureSize > 1 ? kErrorSize / kPictureSize : 1;
  const int side = kErrorSize / kStep, columns = static_cast<int>(strips.front().size());
  base::Image8 sheet(side * columns, side * static_cast<int>(strips.size()), 3);
  for (std::size_t row = 0; row < strips.size(); ++row)
    for (int column = 0; column < columns; ++column)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          std::copy_n(strips[row][static_cast<std::size_t>(column)].at(x * kStep, y * kStep), 3,
                      sheet.at(column * side + x, static_cast<int>(row) * side + y));
  base::writeImage8(file, sheet);
}

} // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "docs";
  const Inputs inputs = findInputs();
  bench::ParityTable table;
  table.environments = inputs.environments.size();
  std::vector<Strip> strips;
  const std::vector<std::string> shown = {"builtin:materials", "WaterBottle", "MetalRoughSpheresNoTextures", "ToyCar"};
  for (const std::string& scene : inputs.scenes) {
    for (const std::string& environment : inputs.environments)
      for (const bool sun : {false, true}) {
        job::Context context(settingsOf("ue4-2020", kErrorSize));
        const job::PreparedScene prepared =
            job::prepareScene(context, requestOf(scene, environment, sun), {.chosen = job::allPaths()});
        Strip strip = compareScene(prepared, scene, environment, sun, table);
        const bool last = environment == inputs.environments.back() && sun;
        if (last && std::find(shown.begin(), shown.end(), shortName(scene)) != shown.end())
          strips.push_back(std::move(strip));
        if (last) table.costs.push_back(costsOf(prepared, scene));
      }
    fmt::print(stderr, "{}\n", shortName(scene));
    base::writeText(folder / "mobile-parity.md",
                    bench::toMarkdown(table)); // a long run that is broken off leaves what it has
  }
  writeSheet(folder / "mobile-parity.png", strips);
  return 0;
}
