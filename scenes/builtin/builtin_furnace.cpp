// builtin:furnace: what a white environment shows is how much energy a path loses or makes up.
#include <fmt/format.h>

#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"

namespace parity::scenes {

// Eleven spheres of F0 = 1, roughness 0 to 1 by tenths, each with its own material "roughness 0.3", in rows of four,
// seen from +Z. Radius 0.45 on a grid of 1: no discs overlap. With V constant, a disc's mean is the integral of
// E(N) 2N dN: the hemispherical albedo (docs/shading.md 5). 128 x 64 quads: the silhouette is within 0.03 % of the
// circle, and normals are interpolated between exact ones.
Scene makeFurnaceScene() {
  constexpr int kColumns = 4, kCount = 11;
  SceneBuilder builder("furnace");
  const Mesh sphere = makeSphere(0.45, 128, 64);
  for (int i = 0; i < kCount; ++i) {
    const float roughness = static_cast<float>(i) / 10.f;
    builder.add(sphere, metal(fmt::format("roughness {:.1f}", roughness), glm::vec3(1.f), roughness),
                glm::vec3(static_cast<float>(i % kColumns) - 1.5f, 1.f - static_cast<float>(i / kColumns), 0.f));
  }
  Camera camera;
  camera.orthographic = true;
  camera.halfHeight = 2.05f;
  camera.toWorld[3] = glm::vec4(0, 0, 3, 1);
  camera.zNear = 1;
  camera.zFar = 5;
  builder.setCamera(camera);
  return builder.finish(makeWhite());
}

} // namespace parity::scenes
