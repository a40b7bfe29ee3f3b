// One quad shaded by a path's renderer: every pixel sees the same surface, so one entry tells all.
#pragma once

#include "support/device.h"
#include "support/small_scenes.h"

#include "gpu/surface/shading_pass.h"
#include "shading/terms.h"

namespace parity::tests {

// A cube of one texel a face, of one radiance.
inline gpu::DeviceImage makeConstantCube(const gpu::Device& device, float radiance) {
  const std::vector<glm::vec4> texels(6, glm::vec4(radiance, radiance, radiance, 1));
  const std::span<const std::byte> mip = std::as_bytes(std::span{texels});
  return gpu::DeviceImage(device, {.format = vk::Format::eR32G32B32A32Sfloat, .cube = true}, std::span{&mip, 1});
}

// An environment of constant radiance and its irradiance, as SH (irradiance pi L: band 0 alone), with a tint and as a
// cube (both over pi).
inline gpu::EnvironmentMaps makeConstantEnvironment(const gpu::Device& device, float radiance) {
  gpu::EnvironmentMaps maps{makeConstantCube(device, radiance),
                            vk::raii::Sampler(device.handle(), vk::SamplerCreateInfo()),
                            {},
                            makeConstantCube(device, radiance),
                            {}};
  // E(n) = pi L = c0 * 0.282095
  maps.sh[0] = glm::vec4(3.14159265358979 * radiance / 0.282094791773878);
  maps.tintedSky[0] = glm::vec4(radiance);
  return maps;
}

// One that is red towards +X and black elsewhere, one texel a face.
inline gpu::EnvironmentMaps makeRedTowardsX(const gpu::Device& device) {
  gpu::EnvironmentMaps maps = makeConstantEnvironment(device, 0);
  std::vector<glm::vec4> texels(6, glm::vec4(0, 0, 0, 1));
  texels[0].x = 1; // the first face is +X
  const std::span<const std::byte> mip = std::as_bytes(std::span{texels});
  maps.cube = gpu::DeviceImage(device, {.format = vk::Format::eR32G32B32A32Sfloat, .cube = true}, std::span{&mip, 1});
  return maps;
}

struct ShadedPoint {
  glm::vec3 color{0.f};
  float opacity = 0;
  std::array<glm::vec3, shading::kTermCount> terms{};
  glm::vec3 operator[](shading::Term t) const { return terms[static_cast<std::size_t>(t)]; }
};

// makeRenderer: (const gpu::SceneBuffers&, const std::vector<gpu::BinKind>&) -> a renderer with shade(surface, camera).
// The camera is orthographic along -Z: V = +Z at every pixel.
template <typename MakeRenderer> ShadedPoint shadeQuad(const gpu::Device& device, const scenes::Scene& scene,
                                                       const MakeRenderer& makeRenderer,
                                                       gpu::SpecularAa specularAa = gpu::SpecularAa::off) {
  constexpr std::uint32_t kSize = 8;
  const scenes::Camera camera = makeFrontCamera(1, 3, true);
  const gpu::SceneBuffers buffers(device, scene, specularAa);
  const gpu::SurfacePass pass(device, buffers, kSize, kSize);
  const std::vector<gpu::Surface> layers = pass.render(camera, {0, kSize}, glm::vec2(0.5f));
  const gpu::Surface& surface = layers.back();
  EXPECT_EQ(surface.size(), std::size_t{kSize} * kSize);
  const auto renderer = makeRenderer(buffers, pass.binKinds());
  const gpu::ShadedSurface shaded = renderer.shade(surface, camera);
  ShadedPoint point;
  point.color = glm::vec3(shaded.color[0]);
  point.opacity = shaded.color[0].w;
  for (std::size_t t = 0; t < shaded.terms.size(); ++t) point.terms[t] = glm::vec3(shaded.terms[t][0]);
  return point;
}

// A quad whose shading normal leans by this angle from V towards +X, so that NoV = cos(angle).
inline scenes::Scene makeLeaningQuad(float angle) {
  scenes::Scene scene = makeQuadScene();
  scene.meshes[0].normals.assign(4, glm::vec3(std::sin(angle), 0, std::cos(angle)));
  scene.meshes[0].tangents.clear();
  return scene;
}

// Of a light in this direction at makeLeaningQuad(angle), seen along +Z.
struct QuadCosines {
  double NoV, NoL, NoH, VoH;
  QuadCosines(float angle, const glm::dvec3& towards) {
    const glm::dvec3 N(std::sin(angle), 0, std::cos(angle)), V(0, 0, 1);
    const glm::dvec3 L = glm::normalize(towards), H = glm::normalize(V + L);
    NoV = glm::dot(N, V), NoL = glm::dot(N, L), NoH = glm::dot(N, H), VoH = glm::dot(V, H);
  }
};

inline scenes::Light makeDirectional(const glm::vec3& towards, const glm::vec3& color) {
  scenes::Light light;
  light.kind = scenes::LightKind::directional;
  light.direction = -glm::normalize(towards);
  light.color = color;
  return light;
}

inline void expectNear(const glm::vec3& actual, const glm::vec3& expected, float relative, const char* what) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(actual[c], expected[c], relative * std::abs(expected[c]) + 1e-7f) << what << ", channel " << c;
}

} // namespace parity::tests
