#include "job/bake_run.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bake/atlas/density.h"
#include "bake/encode/dilation.h"
#include "bake/encode/distance_field.h"
#include "bake/encode/half_encoding.h"
#include "bake/encode/lq_encoding.h"
#include "bake/encode/sun_pages.h"
#include "bake/light/capture_places.h"
#include "bake/stages.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/member_count.h"
#include "job/scene/baked_scene.h"
#include "job/scene/capture_render.h"

namespace parity::job {

namespace {

// Rings of texels beside the charts: what bilinear reading reaches, and a phone's blocks.
constexpr int kDilation = 4;
constexpr double kFloorPerCapture = 30;     // square metres
constexpr std::size_t kBytesPerTexel = 256; // of the lightmap's pages, all stages together (docs/limits.md)
// Shares of the whole, for progress.
constexpr double kIntegrated = 0.85, kEncoded = 0.9;

class Bake {
public:
  Bake(Context& context, const SceneRequest& request, const BakeOptions& options, const Progress& progress,
       const std::function<bool()>& isCancelled)
      : m_context(context), m_request(request), m_options(options), m_progress(progress), m_isCancelled(isCancelled) {}

  BakeResult run() {
    tell("loading", 0);
    PreparedScene prepared = prepareScene(m_context, m_request, {.chosen = {allPaths().front()}, .bakes = true});
    if (!prepared.isLit)
      throw base::fileError(m_request.scene, "", "every material is unlit, so there is nothing to bake");
    if (m_options.atlas.texelsPerMetre == 0)
      m_options.atlas.texelsPerMetre = bake::defaultTexelsPerMetre(prepared.scene);
    m_options.integrate.texelsPerMetre = m_options.atlas.texelsPerMetre;
    const bake::BakeLights lights = bakeLightsOf(prepared);
    BakeResult result;
    bake::BakedLight& light = result.light;
    result.notes = prepared.scene.warnings;
    light.scene = prepared.scene.name;
    light.settings = describe();
    light.astc = m_options.astc == base::AstcBlock::none      ? "none"
                 : m_options.astc == base::AstcBlock::astc4x4 ? "4x4"
                                                              : "6x6";
    light.localLights = m_options.localLights;
    light.hashes = bake::hashScene(prepared.scene, lights);

    const bake::Atlas atlas = makeAtlas(prepared.scene);
    requireRoom(atlas);
    result.notes.insert(result.notes.end(), atlas.notes.begin(), atlas.notes.end());
    light.pageSide = atlas.pageSide;
    light.uvs = atlas.uvs;
    {
      const bake::TexelGrid grid = makeGrid(prepared.scene, atlas);
      const bake::StaticLight found = integrate(prepared.scene, atlas, grid, lights, light.hashes);
      result.rays = found.rays;
      tell("encoding", kIntegrated);
      const base::Stopwatch watch(&m_context.timings(), "encode lightmaps");
      describeError(found, light.figures);
      encode(prepared.scene, atlas, grid, found, light);
      if (lights.sun) encodeSun(bake::makeSunMasks(atlas, grid, found), light);
    }
    addCaptures(std::move(prepared), light);
    tell("", 1);
    return result;
  }

private:
  void tell(const std::string& what, double done) const {
    if (m_isCancelled && m_isCancelled()) bake::throwCancelled(m_context.cache().enabled());
    if (m_progress) m_progress(what, done);
  }

  std::string describe() const {
    const bake::IntegrateOptions& i = m_options.integrate;
    return fmt::format("{} bounces, error {:g} %, at most {} samples, seed {}; {:.4g} texels a metre; local lights {}",
                       i.bounces, 100 * i.error, i.maxSamples, i.seed, i.texelsPerMetre,
                       m_options.localLights == bake::LocalLights::isStatic ? "static" : "stationary");
  }

  bake::Atlas makeAtlas(const scenes::Scene& scene) {
    const base::Stopwatch watch(&m_context.timings(), "lightmap uvs");
    return bake::makeAtlas(scene, m_options.atlas);
  }
  // Throws Error where the texels would take more than --max-memory.
  void requireRoom(const bake::Atlas& atlas) const {
    const std::size_t side = static_cast<std::size_t>(atlas.pageSide);
    const std::size_t bytes = side * side * static_cast<std::size_t>(atlas.pageCount) * kBytesPerTexel,
                      limit = m_request.settings.scene.load.maxMemoryBytes;
    if (bytes > limit)
      throw base::fileError(m_request.scene, "",
                            fmt::format("its lightmap of {} page{} of {}x{} texels needs about {} MiB; the limit is {} "
                                        "MiB (--max-memory); lower --texels-per-metre",
                                        atlas.pageCount, atlas.pageCount == 1 ? "" : "s", side, side, bytes >> 20,
                                        limit >> 20));
  }
  bake::TexelGrid makeGrid(const scenes::Scene& scene, const bake::Atlas& atlas) {
    const base::Stopwatch watch(&m_context.timings(), "lightmap texels");
    return {scene, atlas, 4};
  }

  // Not in the key: the texels a metre of the integration, which are the atlas'.
  static_assert(base::memberCount<bake::AtlasOptions>() == 3 && base::memberCount<bake::IntegrateOptions>() == 5,
                "a new member goes into the key, or is named here with the reason why not");
  bake::StaticLight integrate(const scenes::Scene& scene, const bake::Atlas& atlas, const bake::TexelGrid& grid,
                              const bake::BakeLights& lights, const bake::SceneHashes& hashes) {
    const base::Stopwatch watch(&m_context.timings(), "integrate light");
    const bake::IntegrateOptions& i = m_options.integrate;
    base::Hasher key;
    key.add(m_context.buildId()).add(hashes.geometry).add(hashes.materials).add(hashes.lights).add(hashes.sky);
    key.addValue(m_options.atlas.texelsPerMetre)
        .addValue(m_options.atlas.maxPageSide)
        .addValue(m_options.atlas.padding);
    key.addValue(i.bounces).addValue(i.error).addValue(i.maxSamples).addValue(i.seed);
    const bake::Control control{
        .progress = [&](const std::string& what, double done) { tell(what, done * kIntegrated); },
        .isCancelled = m_isCancelled,
        .cache = m_context.cache().enabled() ? &m_context.cache() : nullptr,
        .key = key.hex()};
    return bake::integrate(scene, atlas, grid, lights, i, control);
  }

  void describeError(const bake::StaticLight& light, bake::BakeFigures& figures) const {
    figures.texels = light.error.size();
    std::vector<float> errors;
    double samples = 0;
    for (std::size_t i = 0; i < light.error.size(); ++i) {
      samples += light.samples[i];
      if (light.valid[i] != 0) errors.push_back(light.error[i]);
    }
    if (errors.empty()) return;
    std::ranges::sort(errors);
    figures.samplesPerTexel = samples / static_cast<double>(errors.size());
    figures.errorMedian = errors[errors.size() / 2];
    figures.errorWorst = errors.back();
    const auto within =
        std::ranges::upper_bound(errors, static_cast<float>(m_options.integrate.error)) - errors.begin();
    figures.shareWithinError = static_cast<double>(within) / static_cast<double>(errors.size());
  }

  static std::vector<bake::LightmapPage> dilated(std::vector<bake::IntegratedPage> integrated) {
    std::vector<bake::LightmapPage> pages;
    for (bake::IntegratedPage& page : integrated) {
      bake::dilate(page.page, kDilation, page.invalid);
      pages.push_back(std::move(page.page));
    }
    return pages;
  }

  void encode(const scenes::Scene& scene, const bake::Atlas& atlas, const bake::TexelGrid& grid,
              const bake::StaticLight& found, bake::BakedLight& light) const {
    const std::vector<bake::LightmapPage> pages = dilated(bake::makePages(scene, atlas, grid, found, true));
    for (const bake::LightmapPage& page : pages) light.sources.push_back(sourceOf(page));
    bake::LqLightmap lq = bake::encodeLq(pages, scene.instances.size(), {.block = m_options.astc});
    light.lqPages = std::move(lq.pages);
    for (const bake::LqScales& s : lq.instances)
      light.lqScales.insert(light.lqScales.end(), {s.colorScale, s.colorAdd, s.directionScale, s.directionAdd});
    light.figures.quantizedError = lq.figures.quantized.rms;
    light.figures.storedError = lq.figures.stored.rms;
    light.figures.colorDb = std::min(lq.figures.colorDb, bake::kNoLossDb);
    light.figures.directionDb = std::min(lq.figures.directionDb, bake::kNoLossDb);
    const auto encodeAll = [&](const std::vector<bake::LightmapPage>& all) {
      for (const bake::LightmapPage& page : all) light.halfPages.push_back(bake::encodeHalves(page));
    };
    if (m_options.localLights == bake::LocalLights::isStatic)
      encodeAll(pages);
    else
      encodeAll(dilated(bake::makePages(scene, atlas, grid, found, false)));
  }

  // Irradiance, SH, normal.
  static base::Image sourceOf(const bake::LightmapPage& page) {
    base::Image image(page.irradiance.width, page.irradiance.height, 10);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
      float* texel = image.pixels.data() + 10 * i;
      std::copy_n(page.irradiance.pixels.data() + 3 * i, 3, texel);
      std::copy_n(page.sh.pixels.data() + 4 * i, 4, texel + 3);
      std::copy_n(page.normal.pixels.data() + 3 * i, 3, texel + 7);
    }
    return image;
  }

  static void encodeSun(const std::vector<bake::SunMask>& masks, bake::BakedLight& light) {
    const bake::DistanceFieldOptions options;
    for (const bake::SunMask& mask : masks) {
      light.sunMask.push_back(bake::makeVisibilityMask(mask));
      const bake::DistanceField field = bake::makeDistanceField(mask, options);
      light.transitionScale = static_cast<float>(field.transitionScale);
      light.sunField.push_back(field.codes);
    }
  }

  int captureCount(const scenes::Scene& scene) const {
    if (m_options.captures >= 0) return m_options.captures;
    const scenes::Bounds bounds = scene.bounds();
    const double floor = static_cast<double>(bounds.upper.x - bounds.lower.x) * (bounds.upper.z - bounds.lower.z);
    return static_cast<int>(std::clamp(std::round(floor / kFloorPerCapture), 1.0, 4.0));
  }

  std::vector<bake::CapturePlace> findPlaces(const scenes::Scene& scene) const {
    const int count = captureCount(scene);
    if (m_request.captures.empty() && count == 0) return {};
    const lighting::Visibility visibility(scene);
    if (m_request.captures.empty()) return bake::findCapturePlaces(scene, visibility, count);
    std::vector<bake::CapturePlace> places;
    for (const glm::vec3& position : m_request.captures)
      places.push_back(bake::placeCapture(scene, visibility, position));
    return places;
  }

  // Twice: what is seen reflected in a capture are those of the first time, which reflect nothing but the sun.
  void addCaptures(PreparedScene prepared, bake::BakedLight& light) {
    const base::Stopwatch watch(&m_context.timings(), "environment captures");
    const std::vector<bake::CapturePlace> places = findPlaces(prepared.scene);
    std::vector<glm::vec3> positions;
    for (const bake::CapturePlace& place : places) positions.push_back(place.position);
    for (scenes::LightmapUvs::Place& place : light.uvs.places)
      place.capture = nearest(prepared.scene, positions, &place - light.uvs.places.data());
    // What may differ from one rendering to the next is left to that: fog, scales of light. Local lights that are not
    // in the high-end lightmap cast shadows.
    prepared.scene.fog.reset();
    prepared.scene.lightScales = {};
    prepared.settings.shadows = m_options.localLights == bake::LocalLights::isStationary;
    const std::vector<scenes::Light> lights = prepared.lights;
    for (int pass = 0; pass < 2 && !places.empty(); ++pass) {
      tell(pass == 0 ? "captures" : "captures of captures", kEncoded + 0.05 * pass);
      prepared.lights = lights;
      takeBaked(prepared, {.chosen = {allPaths().front()}}, std::make_shared<const bake::BakedLight>(light));
      const std::vector<lighting::EnvironmentLight> seen =
          renderCaptures(prepared, positions, {.filter = {.faceSize = m_options.captureSize}, .samples = 4});
      light.captures.clear();
      for (std::size_t k = 0; k < places.size(); ++k)
        light.captures.push_back({places[k].position, places[k].boxLower, places[k].boxUpper, places[k].radius,
                                  std::make_shared<const lighting::EnvironmentLight>(seen[k])});
    }
  }

  // The capture nearest to the middle of an object's bounds.
  static std::uint32_t nearest(const scenes::Scene& scene, const std::vector<glm::vec3>& positions,
                               std::ptrdiff_t instance) {
    if (positions.size() < 2) return 0;
    const glm::vec3 middle = scene.boundsOf(static_cast<std::size_t>(instance)).center();
    const auto distance = [&](const glm::vec3& p) { return glm::distance(p, middle); };
    return static_cast<std::uint32_t>(std::ranges::min_element(positions, {}, distance) - positions.begin());
  }

  Context& m_context;
  const SceneRequest& m_request;
  BakeOptions m_options;
  const Progress& m_progress;
  const std::function<bool()>& m_isCancelled;
};

} // namespace

BakeResult bakeScene(Context& context, const SceneRequest& request, const BakeOptions& options,
                     const Progress& progress, const std::function<bool()>& isCancelled) {
  return Bake(context, request, options, progress, isCancelled).run();
}

} // namespace parity::job
