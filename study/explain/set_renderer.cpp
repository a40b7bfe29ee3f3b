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

std::vector<double> meansOf(const compare::SwapMeasurement& measured) {
  std::vector<double> means;
  for (const compare::Figures& figures : measured.figures) means.push_back(figures.find("flip.mean").value_or(0));
  return means;
}

} // namespace

SetRenderer::SetRenderer(job::Context& context, const job::PreparedScene& prepared, job::SceneOnDevice& scene,
                         const job::Settings& settings, const job::PathChoice& paths, const scenes::Camera& camera)
    : m_context(context), m_prepared(prepared), m_first(*paths.chosen[0]), m_path(*paths.chosen[1]), m_scene(scene),
      m_surfaces(context.device(), scene, settings, camera),
      m_firstRenderer(m_scene.makeRenderer(m_first, settings.options, {.expectedPixels = kManyPixels})),
      m_reference(makeReference(settings)), m_coverage(m_surfaces.coverage(m_reference.shaded)) {}

SetRenderer::Reference SetRenderer::makeReference(const job::Settings& settings) {
  Reference reference;
  reference.shaded = m_surfaces.shade(*m_firstRenderer);
  const base::Image picture = m_surfaces.compose(
      reference.shaded, m_first.target(settings.options, m_context.deviceReport(), settings.exposureEv));
  reference.displayed = job::displayImage(picture, m_context.display(), settings.exposureEv);
  reference.light = job::expose(picture, settings.exposureEv);
  return reference;
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

const SetRenderer::Shaded& SetRenderer::shade(const job::Settings& settings, Program program) {
  const char* const by = program == Program::wide ? "wide " : "specialised ";
  if (std::string key = by + shadingKey(settings, m_path); key != m_shadedKey) {
    m_shaded = m_surfaces.shade(*makeRenderer(settings, program));
    m_shadedKey = std::move(key);
  }
  return m_shaded;
}

compare::SwapMeasurement SetRenderer::measure(const job::Settings& settings, const Reference& reference,
                                              const Shaded& shaded, const std::vector<std::size_t>& materials,
                                              bool maps) {
  const std::optional<gpu::TargetCodec> target =
      m_path.target(settings.options, m_context.deviceReport(), settings.exposureEv);
  const base::Image picture = m_surfaces.compose(shaded, target);
  const std::vector<gpu::SwappedPixels> swapped =
      m_surfaces.swap(reference.shaded, shaded, target, picture, m_coverage);
  const job::Displayed shown = job::displayImage(picture, m_context.display(), settings.exposureEv);
  std::vector<compare::Swap> swaps(materials.size());
  base::parallelFor(swaps.size(), 1, [&](std::size_t i, std::size_t) {
    const std::size_t m = materials[i];
    swaps[i] = job::displaySwap(m_context, m_coverage[m], swapped[m], 0, settings.exposureEv, &shown);
  });
  compare::MeasureRequest request;
  request.statistics = {"flip.mean"};
  if (maps) request.keepMaps = {"flip"};
  return compare::measureSwaps(job::referenceOf(reference.displayed, reference.light), swaps, request);
}

std::vector<double> SetRenderer::flip(const job::Settings& settings, Program program,
                                      const std::vector<std::size_t>& materials) {
  return meansOf(measure(settings, m_reference, shade(settings, program), materials, false));
}

std::vector<std::vector<float>> SetRenderer::flipMaps(const job::Settings& settings,
                                                      const std::vector<std::size_t>& materials) {
  return measure(settings, m_reference, shade(settings, Program::wide), materials, true).flip;
}

base::Image8 SetRenderer::picture(const job::Settings& settings) {
  const base::Image picture =
      m_surfaces.compose(shade(settings, Program::specialised),
                         m_path.target(settings.options, m_context.deviceReport(), settings.exposureEv));
  return job::displayImage(picture, m_context.display(), settings.exposureEv).pixels;
}

std::vector<double> SetRenderer::flipOfAssets(const job::Settings& settings, Program program,
                                              const std::map<std::size_t, scenes::Material>& changed,
                                              const std::vector<std::size_t>& materials) {
  for (const auto& [index, material] : changed) m_scene.buffers().setFactors(index, material);
  const Reference reference = makeReference(settings);
  const Shaded shaded = m_surfaces.shade(*makeRenderer(settings, program));
  for (const auto& [index, material] : changed) m_scene.buffers().setFactors(index, m_prepared.scene.materials[index]);
  return meansOf(measure(settings, reference, shaded, materials, false));
}

std::vector<glm::vec2> SetRenderer::texturePlaces(std::size_t material, const scenes::TextureSlot& texture) const {
  if ((m_scene.buffers().vertexData() & gpu::kVertexUvs) == 0) return {};
  const auto& t = texture.uvTransform;
  const std::vector<std::uint32_t>& materialOf = m_scene.buffers().materialOfInstance();
  std::map<std::uint32_t, glm::vec2> places; // by pixel
  for (const job::ViewSurfaces::Part& part : m_surfaces.parts())
    for (const gpu::Surface& layer : part.layers) {
      const std::vector<glm::vec4> uvs = layer.uv.downloadAs<glm::vec4>(layer.size());
      for (std::size_t i = 0; i < layer.size(); ++i) {
        if (materialOf[layer.instances[i]] != material) continue;
        const glm::vec2 uv = texture.texCoord == 1 ? glm::vec2(uvs[i].z, uvs[i].w) : glm::vec2(uvs[i]);
        places[layer.pixels[i]] = {t[0] * uv.x + t[1] * uv.y + t[2], t[3] * uv.x + t[4] * uv.y + t[5]};
      }
    }
  std::vector<glm::vec2> inOrder;
  for (const std::uint32_t pixel : m_coverage[material].pixels) inOrder.push_back(places[pixel]);
  return inOrder;
}

std::optional<base::Image> SetRenderer::intermediate(const job::Settings& settings, const std::string& name) {
  const std::optional<std::uint32_t> place = paths::placeOf(m_path.intermediates(), name);
  if (!place) return std::nullopt;
  return m_surfaces.compose(m_surfaces.shade(*makeRenderer(settings, Program::wide, *place)), std::nullopt);
}

std::vector<std::vector<Cost>> SetRenderer::costs(const std::vector<CostRequest>& requests) {
  using Specialised = std::pair<const std::uint32_t*, std::vector<std::uint32_t>>; // SPIR-V, constants
  std::map<Specialised, Cost> counted;
  std::map<const std::uint32_t*, gpu::Spirv> modules;
  std::vector<std::vector<Specialised>> programs;
  for (const CostRequest& request : requests) {
    const auto renderer = makeRenderer(request.settings, Program::specialised);
    const gpu::ShadingPass& pass = renderer->pass();
    modules[pass.spirv().data()] = pass.spirv();
    std::vector<Specialised>& of = programs.emplace_back();
    for (const std::size_t m : request.materials) {
      of.emplace_back(pass.spirv().data(), pass.exactConstants(gpu::classify(m_prepared.scene.materials[m])));
      counted[of.back()];
    }
  }
  // All at once: most sets have one or two programs.
  std::vector<std::pair<const Specialised*, Cost*>> all;
  for (auto& [program, cost] : counted) all.emplace_back(&program, &cost);
  base::parallelFor(all.size(), 1, [&](std::size_t i, std::size_t) {
    const auto& [program, cost] = all[i];
    const report::PermutationCost permutation = job::costOf(m_context, modules.at(program->first), program->second);
    *cost = {static_cast<std::int64_t>(permutation.operations()), static_cast<std::int64_t>(permutation.fetches)};
  });
  std::vector<std::vector<Cost>> costs;
  for (const std::vector<Specialised>& of : programs) {
    std::vector<Cost>& each = costs.emplace_back();
    for (const Specialised& program : of) each.push_back(counted.at(program));
  }
  return costs;
}

} // namespace parity::explain
