// A pane of glass before a wall, and what a path's renderer shows through it.
#pragma once

#include "support/path_quad.h"

#include "base/image/image.h"
#include "gpu/surface/backdrop.h"

namespace parity::tests {

inline constexpr std::uint32_t kLookSize = 64; // of the picture's sides

// The pane lies at z = 0 and fills a picture of half height 1. The wall is this far behind; its left half is red, its
// right half blue, both emissive.
inline scenes::Scene makePaneBeforeWall(float roughness, float distance, float thickness = 0) {
  scenes::Scene scene = makeQuadScene();
  scenes::Material& glass = scene.materials[0];
  glass.baseColor = glm::vec4(1);
  glass.metallic = 0;
  glass.roughness = roughness;
  glass.transmission = 1;
  glass.thickness = thickness;
  for (const glm::vec3& color : {glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)}) {
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    scenes::Material& wall = scene.materials.emplace_back();
    wall.name = material == 1 ? "red" : "blue";
    wall.baseColor = glm::vec4(0, 0, 0, 1);
    wall.metallic = 0;
    wall.specular = 0;
    wall.emissive = color;
    scene.meshes.push_back(makeQuad(material));
    scene.instances.push_back({material, translation(material == 1 ? -1.f : 1.f, 0, -distance), wall.name});
  }
  return scene;
}

struct LookedThrough {
  base::Image image;          // the term transmission of every pixel; black where nothing is
  bool readsBackdrop = false; // as the renderer says
};

// makeRenderer: (const gpu::SceneBuffers&, const
// std::vector<gpu::BinKind>&) -> a renderer that writes terms.
template <typename MakeRenderer> LookedThrough lookThrough(const gpu::Device& device, const scenes::Scene& scene,
                                                           const scenes::Camera& camera,
                                                           const MakeRenderer& makeRenderer, bool withBackdrop = true) {
  const gpu::SceneBuffers buffers(device, scene, gpu::SpecularAa::off);
  const gpu::SurfacePass pass(device, buffers, kLookSize, kLookSize);
  auto renderer = makeRenderer(buffers, pass.binKinds());
  gpu::BackdropBuilder builder(kLookSize, kLookSize, 1);
  const gpu::Tile tile{0, kLookSize};
  const gpu::Surface behind = pass.resolve(pass.rasteriseBehind(camera, tile, glm::vec2(0.5f)), 0, camera);
  builder.lay(behind, camera, renderer.shade(behind, camera).color);
  const gpu::Backdrop backdrop = builder.take(device);
  if (withBackdrop) renderer.setBackdrop(&backdrop);
  const gpu::Surface surface = pass.resolve(pass.rasterise(camera, tile, glm::vec2(0.5f)), 0, camera);
  const gpu::ShadedSurface shaded = renderer.shade(surface, camera);
  LookedThrough seen{base::Image(kLookSize, kLookSize, 3), renderer.readsBackdrop()};
  for (std::size_t i = 0; i < surface.size(); ++i)
    for (int c = 0; c < 3; ++c)
      seen.image.pixels[3 * surface.pixels[i] + c] =
          shaded.terms[static_cast<std::size_t>(shading::Term::transmission)][i][c];
  return seen;
}

} // namespace parity::tests
