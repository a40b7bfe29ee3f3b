#include "study/explain/worst_stage.h"

#include <algorithm>
#include <cmath>

#include "base/text/glob.h"
#include "job/context.h"
#include "job/knobs.h"
#include "scenes/scene_info.h"
#include "scenes/view.h"
#include "study/explain/set_renderer.h"

namespace parity::explain {

namespace {

job::SceneRequest at(job::SceneRequest request, int size, float rotation) {
  if (size > 0) {
    // A search looks at many skies: these are filtered in a tenth of the time. What is found is rendered as it was
    // asked for.
    request.settings = job::withKnobs(request.settings,
                                      {{"prefilter-size", {{"64"}, "worst"}}, {"prefilter-samples", {{"8"}, "worst"}}});
    const float scale =
        static_cast<float>(size) / static_cast<float>(std::max(request.settings.width, request.settings.height));
    request.settings.width =
        std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(request.settings.width))));
    request.settings.height =
        std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(request.settings.height))));
  }
  request.settings.scene.environmentRotationDeg += rotation;
  return request;
}

job::PathChoice comparedPaths(const job::Settings& settings) {
  job::PathChoice choice = job::pathsOf(settings);
  choice.truth = false;
  return choice;
}

} // namespace

Stage::Stage(job::Context& context, job::SceneRequest request, int size, float rotation)
    : m_context(context), m_request(at(std::move(request), size, rotation)), m_paths(comparedPaths(m_request.settings)),
      m_prepared(job::prepareScene(context, m_request, m_paths)) {
  const scenes::ViewRequest& view = m_request.views.front();
  scenes::ViewRequest fitted = view;
  fitted.orbit = glm::vec3(30, 70, 0);
  const scenes::Camera camera = scenes::makeCamera(m_prepared.scene, fitted, aspect());
  const glm::vec3 target = view.target.value_or(m_prepared.scene.bounds().center());
  m_radius = glm::length(glm::vec3(camera.toWorld[3]) - target);
}

std::size_t Stage::triangles() const { return scenes::describeScene(m_prepared.scene).triangles; }

Outcome Stage::look(const glm::vec3& orbit, const std::optional<glm::vec2>& sun, std::uint64_t least) {
  scenes::ViewRequest view = m_request.views.front();
  view.camera.clear();
  view.orbit = orbit;
  return look(view, sun, least);
}

Outcome Stage::look(const scenes::ViewRequest& view, const std::optional<glm::vec2>& sun, std::uint64_t least) {
  if (sun) turnSun(*sun);
  // Shadow maps are those of one sun.
  if (!m_scene || (sun && m_prepared.settings.shadows))
    m_scene = std::make_unique<job::SceneOnDevice>(m_context, m_prepared, m_prepared.settings, m_paths);
  SetRenderer renderer(m_context, m_prepared, *m_scene, m_prepared.settings, m_paths,
                       scenes::makeCamera(m_prepared.scene, view, aspect()));
  std::vector<std::size_t> materials;
  for (std::size_t m = 0; m < renderer.coverage().size(); ++m)
    if (renderer.coverage()[m].pixels.size() >= least && isChosen(m_prepared.scene.materials[m].name))
      materials.push_back(m);
  Outcome worst;
  if (materials.empty()) return worst;
  const std::vector<double> flip = renderer.flip(m_prepared.settings, SetRenderer::Program::specialised, materials);
  for (std::size_t i = 0; i < flip.size(); ++i)
    if (flip[i] > worst.flip || worst.pixels == 0)
      worst = {m_prepared.scene.materials[materials[i]].name, flip[i], renderer.coverage()[materials[i]].pixels.size()};
  return worst;
}

float Stage::aspect() const {
  return static_cast<float>(m_request.settings.width) / static_cast<float>(m_request.settings.height);
}

bool Stage::isChosen(const std::string& material) const {
  const std::vector<std::string>& globs = m_request.settings.materials;
  return globs.empty() ||
         std::ranges::any_of(globs, [&](const auto& glob) { return base::matchesGlob(glob, material); });
}

// --sun is the light behind those of the scene.
void Stage::turnSun(const glm::vec2& sun) {
  scenes::SunRequest request = *m_request.settings.scene.sun;
  request.azimuthDeg = sun.x, request.elevationDeg = sun.y;
  scenes::Light light = scenes::makeSun(request);
  light.specularScale *= m_request.settings.scene.lightScales.sunSpecularScale;
  const std::size_t place = m_prepared.scene.lights.size();
  m_prepared.lights.at(place) = light;
  for (auto& [name, own] : m_prepared.lightOfPath) own.lights.at(place) = light;
}

} // namespace parity::explain
