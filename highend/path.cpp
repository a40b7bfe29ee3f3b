#include "highend/path.h"

#include <cstring>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "base/hash.h"
#include "highend/environment_upload.h"
#include "highend/knobs.h"
#include "highend/programs.h"
#include "highend/renderer.h"
#include "highend/sheen_table.h"
#include "highend/table_brdf.h"

namespace parity::highend {

namespace {

base::Image makeOrRecallLut(const Options& options, const paths::Services& services) {
  const base::Stopwatch watch(services.timings, "environment BRDF table");
  const auto& [geometryTerm, fresnel, diffuse] = options.model;
  const std::string key =
      "lut-" +
      base::Hasher().add(services.buildId).addValue(geometryTerm).addValue(fresnel).addValue(options.lutSize).hex();
  base::Image lut(options.lutSize, options.lutSize, 4);
  const std::size_t bytes = lut.pixels.size() * sizeof(float);
  if (const auto cached = services.cache.find(key); cached && cached->size() == bytes) {
    std::memcpy(lut.pixels.data(), cached->data(), bytes);
    return lut;
  }
  lut = makeEnvBrdfLut(geometryTerm, fresnel, options.lutSize);
  services.cache.store(key, std::as_bytes(std::span{lut.pixels}));
  return lut;
}

base::Image makeOrRecallSheenTable(int size, const paths::Services& services) {
  const base::Stopwatch watch(services.timings, "sheen table");
  const std::string key = "sheen-" + base::Hasher().add(services.buildId).addValue(size).hex();
  base::Image table(size, size, 1);
  const std::size_t bytes = table.pixels.size() * sizeof(float);
  if (const auto cached = services.cache.find(key); cached && cached->size() == bytes) {
    std::memcpy(table.pixels.data(), cached->data(), bytes);
    return table;
  }
  table = makeSheenTable(size);
  services.cache.store(key, std::as_bytes(std::span{table.pixels}));
  return table;
}

bool needsSheenTable(const paths::Inputs& inputs) {
  return (inputs.buffers.lobes() & (gpu::kFeatureCoat | gpu::kFeatureSheen)) != 0;
}

// Tables in the run's store. What makes them refers to nothing but the run's services.
struct Table {
  std::string name;
  std::function<base::Image()> make;
};

Table lutOf(const Options& options, const paths::Services& services) {
  return {fmt::format("environment BRDF table {} {} {}", static_cast<int>(options.model.geometryTerm),
                      static_cast<int>(options.model.fresnel), options.lutSize),
          [options, services] { return makeOrRecallLut(options, services); }};
}

Table sheenTableOf(const Options& options, const paths::Services& services) {
  return {fmt::format("sheen table {}", options.lutSize),
          [size = options.lutSize, services] { return makeOrRecallSheenTable(size, services); }};
}

lighting::PrefilterOptions prefilterOf(const Options& options) {
  lighting::PrefilterOptions prefilter = lighting::kFinePrefilter;
  prefilter.sampleCount = options.prefilterSamples;
  prefilter.faceSize = options.prefilterSize;
  return prefilter;
}

const gpu::EnvironmentMaps* environmentOf(const paths::Inputs& inputs) {
  const base::Stopwatch watch(inputs.services.timings, "upload");
  if (inputs.baked && !inputs.baked->captures.empty())
    return inputs.store.get("highend captures", [&] {
      return uploadCaptures(inputs.device, paths::cubesOf(*inputs.baked), *inputs.baked->captures.front().light);
    });
  const lighting::EnvironmentLight* const light = inputs.light.environment.get();
  if (!light) return nullptr;
  return inputs.store.get(fmt::format("highend environment {}", static_cast<const void*>(light)), [&] {
    return uploadEnvironment(inputs.device, *light, inputs.light.cells.get(),
                             (inputs.buffers.lobes() & gpu::kFeatureSheen) != 0);
  });
}

const gpu::BakedMaps* bakedOf(const paths::Inputs& inputs) {
  if (!inputs.baked) return nullptr;
  const base::Stopwatch watch(inputs.services.timings, "upload");
  return inputs.store.get("highend lightmap", [&] { return uploadBaked(inputs.device, *inputs.baked); });
}

gpu::ShadowMaps* shadowsOf(const paths::Inputs& inputs) {
  if (!inputs.asksForShadows || !inputs.isLit) return nullptr;
  const base::Stopwatch watch(inputs.services.timings, "shadow maps");
  return inputs.store.get("highend shadow maps", [&] {
    return gpu::ShadowMaps(inputs.device, inputs.buffers, inputs.light.lights, inputs.shadowMaps);
  });
}

class HighendPath final : public paths::Path {
public:
  const std::string& name() const override {
    static const std::string name = "highend";
    return name;
  }
  const std::string& title() const override {
    static const std::string title = "high-end";
    return title;
  }
  const base::KnobTable<paths::Options>& knobs() const override {
    static const base::KnobTable<paths::Options> table = paths::knobsOf(highend::knobs());
    return table;
  }
  const paths::PresetHost* presetHost() const override { return &highend::presetHost(); }
  std::string folderKnob() const override { return "highend-preset"; }
  paths::LightNeeds lightNeeds(const paths::Options& options) const override {
    return {.prefilter = prefilterOf(options.of<Options>()), .cells = true};
  }
  const std::vector<paths::Intermediate>& intermediates() const override { return views(); }
  bool hidesLobes() const override { return true; }
  std::uint32_t droppedLobes(const scenes::Material&, const paths::Options&) const override { return 0; }
  bool leavesOutLights() const override { return true; }
  const shading::SurfaceModel* surfaceModel(const paths::Options& options) const override {
    return &options.of<Options>().model;
  }
  std::unique_ptr<paths::EnvBrdf> environmentBrdf(const paths::Options& options) const override {
    const Options& own = options.of<Options>();
    if (own.own && own.own->defines("presetEnvironmentBrdf")) return nullptr; // only its shader knows it
    return std::make_unique<TableBrdf>(own);
  }
  std::vector<std::string> environmentBrdfKnobs() const override {
    return {"geometry-term", "fresnel", "compensation", "lut-size"};
  }

  std::unique_ptr<paths::Renderer> makeRenderer(const paths::Inputs& inputs,
                                                const paths::Options& options) const override {
    const Options& own = options.of<Options>();
    Inputs mine{.environment = environmentOf(inputs),
                .lut = nullptr,
                .sheenTable = nullptr,
                .transmits = (inputs.buffers.lobes() & gpu::kFeatureTransmission) != 0,
                .lights = inputs.light.lights,
                .shadows = shadowsOf(inputs),
                .baked = bakedOf(inputs),
                .terms = inputs.terms,
                .leftOut = inputs.leftOut,
                .lightsAlone = inputs.lightsAlone,
                .hiddenFeatures = inputs.hiddenFeatures,
                .view = inputs.intermediate,
                .compilation = inputs.compilation,
                .expectedPixels = inputs.expectedPixels};
    // A renderer that only compiles is given empty tables while those of its path are being made.
    base::Image emptyLut, emptySheenTable;
    const auto tableOf = [&](const Table& table, int channels, base::Image& empty) -> const base::Image* {
      if (!inputs.onlyCompiles) return inputs.services.store.get(table.name, table.make);
      inputs.services.store.begin(table.name, table.make);
      empty = base::Image(own.lutSize, own.lutSize, channels);
      return &empty;
    };
    if (needsSheenTable(inputs)) mine.sheenTable = tableOf(sheenTableOf(own, inputs.services), 1, emptySheenTable);
    if (Renderer::needsLut(mine, own)) mine.lut = tableOf(lutOf(own, inputs.services), 4, emptyLut);
    return std::make_unique<Renderer>(inputs.device, inputs.buffers, inputs.binKinds, mine, own);
  }

  std::vector<KnobSet> knobSets() const override {
    std::vector<KnobSet> sets = {
        {"Karis 2013 (no off-specular read, no compensation)",
         "environment",
         {{"off-specular", "none"}, {"compensation", "none"}}},
        {"Karis 2013 and Turquin 2019", "environment", {{"off-specular", "none"}, {"compensation", "turquin"}}}};
    for (const auto& folder : paths::readPresetFolders(name()))
      sets.push_back({folder->text(), "", {{"highend-preset", folder->reference()}}});
    return sets;
  }
  void prepareAgain(const std::string& knob, const paths::Options& options,
                    const scenes::Environment& environment) const override {
    const Options& own = options.of<Options>();
    if (knob == "lut-size")
      makeEnvBrdfLut(own.model.geometryTerm, own.model.fresnel, own.lutSize);
    else
      lighting::makeEnvironmentLight(environment, prefilterOf(own));
  }
};

} // namespace

const paths::Path& path() {
  static const HighendPath path;
  return path;
}

} // namespace parity::highend
