#include "study/explain/set_renderer.h"

#include <array>

#include "base/parallel.h"
#include "job/knobs.h"
#include "job/scene/permutation_costs.h"
#include "job/view/material_swaps.h"

namespace parity::explain {

namespace {

// As if each were shaded often: every class of materials gets its own program where programs are specialised.
constexpr std::uint64_t kManyPixels = std::uint64_t{1} << 40;

// What the shaded light depends on: every knob but those that only store it.
std::string shadingKey(const job::Settings& settings, const paths::Path& path) {
  std::string key = std::to_string(static_cast<int>(path.textureBlock(settings.options)));
  for (const base::KnobRow<job::Settings>& row : job::knobs().rows())
    if (row.knob.stage != base::KnobStage::storage) key += "\n" + row.knob.id + " " + row.text(settings);
  return key;
}

} // namespace

SetRenderer::SetRenderer(job::Context& context, const job::PreparedScene& prepared, job::SceneOnDevice& scene,
                         const job::Settings& settings, const job::PathChoice& paths, const scenes::Camera& camera)
    : m_context(context), m_prepared(prepared), m_path(*paths.chosen[1]), m_scene(scene),
      m_surfaces(context.device(), scene, settings, camera) {
  const paths::Path& first = *paths.chosen[0];
  const auto renderer = m_scene.makeRenderer(first, settings.options, {.expectedPixels = kManyPixels});
  m_reference = m_surfaces.shade(*renderer);
  m_coverage = m_surfaces.coverage(m_reference);
  const base::Image picture =
      m_surfaces.compose(m_reference, first.target(settings.options, context.deviceReport(), settings.exposureEv));
  m_displayed = job::displayImage(picture, context.display(), settings.exposureEv);
  m_light = job::expose(picture, settings.exposureEv);
}

bool SetRenderer::onlyStores(const job::Settings& a, const job::Settings& b) const {
  return shadingKey(a, m_path) == shadingKey(b, m_path);
}

std::unique_ptr<paths::Renderer> SetRenderer::makeRenderer(const job::Settings& settings, Program program,
                                                           std::uint32_t intermediate) {
  job::SceneOnDevice::RendererWish wish{.intermediate = intermediate, .expectedPixels = kManyPixels};
  if (program == Program::wide) {
    wish.wide = true;
    wish.budget.own = 1;
  }
  return m_scene.makeRenderer(m_path, settings.options, wish);
}

compare::SwapMeasurement SetRenderer::measure(const job::Settings& settings, Program program,
                                              const std::vector<std::size_t>& materials, bool maps) {
  const char* const by = program == Program::wide ? "wide " : "specialised ";
  if (std::string key = by + shadingKey(settings, m_path); key != m_shadedKey) {
    m_shaded = m_surfaces.shade(*makeRenderer(settings, program));
    m_shadedKey = std::move(key);
  }
  const std::optional<gpu::TargetCodec> target =
      m_path.target(settings.options, m_context.deviceReport(), settings.exposureEv);
  const base::Image picture = m_surfaces.compose(m_shaded, target);
  const std::vector<gpu::SwappedPixels> swapped = m_surfaces.swap(m_reference, m_shaded, target, picture, m_coverage);
  const job::Displayed shown = job::displayImage(picture, m_context.display(), settings.exposureEv);
  std::vector<compare::Swap> swaps(materials.size());
  base::parallelFor(swaps.size(), 1, [&](std::size_t i, std::size_t) {
    const std::size_t m = materials[i];
    swaps[i] = job::displaySwap(m_context, m_coverage[m], swapped[m], 0, settings.exposureEv, &shown);
  });
  compare::MeasureRequest request;
  request.statistics = {"flip.mean"};
  if (maps) request.keepMaps = {"flip"};
  return compare::measureSwaps(job::referenceOf(m_displayed, m_light), swaps, request);
}

std::vector<double> SetRenderer::flip(const job::Settings& settings, Program program,
                                      const std::vector<std::size_t>& materials) {
  std::vector<double> means;
  for (const compare::Figures& figures : measure(settings, program, materials, false).figures)
    means.push_back(figures.find("flip.mean").value_or(0));
  return means;
}

std::vector<std::vector<float>> SetRenderer::flipMaps(const job::Settings& settings,
                                                      const std::vector<std::size_t>& materials) {
  return measure(settings, Program::wide, materials, true).flip;
}

std::optional<base::Image> SetRenderer::intermediate(const job::Settings& settings, const std::string& name) {
  const std::optional<std::uint32_t> place = paths::placeOf(m_path.intermediates(), name);
  if (!place) return std::nullopt;
  return m_surfaces.compose(m_surfaces.shade(*makeRenderer(settings, Program::wide, *place)), std::nullopt);
}

std::vector<Cost> SetRenderer::costs(const job::Settings& settings, const std::vector<std::size_t>& materials) {
  const auto renderer = makeRenderer(settings, Program::specialised);
  const gpu::ShadingPass& pass = renderer->pass();
  std::vector<std::vector<std::uint32_t>> constants;
  for (const std::size_t m : materials)
    constants.push_back(pass.exactConstants(gpu::classify(m_prepared.scene.materials[m])));
  std::vector<std::vector<std::uint32_t>> distinct = constants;
  std::ranges::sort(distinct);
  const auto repeated = std::ranges::unique(distinct);
  distinct.erase(repeated.begin(), repeated.end());
  std::vector<Cost> counted(distinct.size());
  base::parallelFor(distinct.size(), 1, [&](std::size_t i, std::size_t) {
    const report::PermutationCost cost = job::costOf(m_context, pass.spirv(), distinct[i]);
    counted[i] = {static_cast<std::int64_t>(cost.operations()), static_cast<std::int64_t>(cost.fetches)};
  });
  std::vector<Cost> costs;
  for (const std::vector<std::uint32_t>& each : constants)
    costs.push_back(counted[static_cast<std::size_t>(std::ranges::lower_bound(distinct, each) - distinct.begin())]);
  return costs;
}

} // namespace parity::explain
