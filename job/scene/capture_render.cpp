#include "job/scene/capture_render.h"

#include <algorithm>

#include "job/scene/scene_renderer.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/cube_sampler.h"
#include "lighting/environment/equirect.h"

namespace parity::job {

namespace {

Settings settingsOf(const Settings& run, const CaptureOptions& options) {
  Settings settings = run;
  settings.width = settings.height = options.filter.faceSize;
  settings.samples = options.samples;
  settings.background = glm::vec3(0); // the environment is added to what is not covered
  settings.coverage = true;
  settings.terms = settings.costs = settings.truth = false;
  settings.attribution = Attribution::none;
  settings.droppedLights = 0;
  return settings;
}

// The panorama's radiance, six faces of size^2; black without one.
std::vector<glm::vec4> makeSurroundings(const PreparedScene& prepared, int size) {
  if (prepared.panorama) return lighting::resampleEquirect(*prepared.panorama, size); // in its colour already
  return std::vector<glm::vec4>(lighting::texelIndex(lighting::kCubeFaces, 0, 0, size), glm::vec4(0, 0, 0, 1));
}

// How much of each pixel the scene covers, 0..1.
std::vector<float> coveredShares(const ViewFrames& frames) {
  std::vector<float> covered(frames.first().frame.color.pixelCount(), 0.f);
  for (const base::PixelList& list : frames.coverage)
    for (std::size_t i = 0; i < list.pixels.size(); ++i)
      covered[list.pixels[i]] += list.weights.empty() ? 1.f : list.weights[i];
  return covered;
}

} // namespace

scenes::Camera makeFaceCamera(const glm::vec3& position, int face, const scenes::Bounds& bounds) {
  const glm::dvec3 forward = lighting::directionOf({face, 0, 0});
  const glm::dvec3 right = forward - lighting::directionOf({face, 1, 0}); // against s: the picture is flipped
  const glm::dvec3 up = forward - lighting::directionOf({face, 0, 1});
  scenes::Camera camera;
  camera.name = "capture";
  camera.toWorld = glm::mat4(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(-forward, 0), glm::vec4(position, 1));
  camera.fovYDeg = 90;
  const glm::vec3 reach = glm::max(glm::abs(bounds.lower - position), glm::abs(bounds.upper - position));
  camera.zFar = std::max(1.01f * glm::length(reach), 1e-3f);
  camera.zNear = 1e-3f * camera.zFar;
  return camera;
}

std::vector<lighting::EnvironmentLight>
renderCaptures(const PreparedScene& prepared, std::span<const glm::vec3> positions, const CaptureOptions& options) {
  const int size = options.filter.faceSize;
  const Settings own = settingsOf(prepared.settings, options);
  Context context(own);
  SceneRenderer renderer(context, prepared, own, {.chosen = {allPaths().front()}},
                         positions.size() * lighting::kCubeFaces);
  const std::vector<glm::vec4> surroundings = makeSurroundings(prepared, size);
  const scenes::Bounds bounds = prepared.scene.bounds();

  std::vector<lighting::EnvironmentLight> captures;
  for (const glm::vec3& position : positions) {
    std::vector<glm::vec4> cube = surroundings;
    for (int face = 0; face < lighting::kCubeFaces; ++face) {
      const ViewFrames frames = renderer.render(makeFaceCamera(position, face, bounds));
      const std::vector<float> covered = coveredShares(frames);
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const int column = size - 1 - x;
          const float* color = frames.first().frame.color.at(column, y);
          const float share = std::min(covered[static_cast<std::size_t>(y) * size + column], 1.f);
          glm::vec4& texel = cube[lighting::texelIndex(face, x, y, size)];
          texel = glm::vec4(glm::vec3(color[0], color[1], color[2]) + (1 - share) * glm::vec3(texel), 1.f);
        }
    }
    captures.push_back(lighting::makeEnvironmentLight(std::move(cube), options.filter));
  }
  return captures;
}

} // namespace parity::job
