// Quads with baked light of hand-made texels, shaded by a path's renderer, pixel by pixel.
#pragma once

#include "support/path_quad.h"

#include <cstring>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/packing.hpp>

#include "gpu/surface/baked_maps.h"
#include "scenes/gltf/lightmap_uvs.h"

namespace parity::tests {

struct HostPages {
  vk::Format format{};
  std::uint32_t width = 0, height = 0, count = 0;
  std::vector<std::byte> bytes;
  gpu::BakedPages view() const { return {format, width, height, count, bytes}; }
};

template <typename T> void append(std::vector<std::byte>& bytes, const T& value) {
  const std::span<const std::byte> more = std::as_bytes(std::span{&value, 1});
  bytes.insert(bytes.end(), more.begin(), more.end());
}

// side x side texels above, as many below. texelOf: (page, lower, x, y) -> RGBA.
template <typename TexelOf>
HostPages makeLightmapPages(vk::Format format, std::uint32_t side, std::uint32_t count, const TexelOf& texelOf) {
  HostPages pages{format, side, 2 * side, count, {}};
  for (std::uint32_t page = 0; page < count; ++page)
    for (std::uint32_t y = 0; y < 2 * side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        const glm::vec4 texel = texelOf(page, y >= side, x, y % side);
        if (format == vk::Format::eR16G16B16A16Sfloat)
          append(pages.bytes, glm::packHalf4x16(texel));
        else
          append(pages.bytes, glm::packUnorm4x8(texel));
      }
  return pages;
}

// R8, valueOf: (page) -> code.
template <typename CodeOf> HostPages makeShadowPages(std::uint32_t side, std::uint32_t count, const CodeOf& codeOf) {
  HostPages pages{vk::Format::eR8Unorm, side, side, count, {}};
  for (std::uint32_t page = 0; page < count; ++page)
    for (std::uint32_t i = 0; i < side * side; ++i) append(pages.bytes, static_cast<std::uint8_t>(codeOf(page)));
  return pages;
}

// makeQuad's corners in the order of its indices: u to the right, v up, over all of a page.
inline std::vector<glm::vec2> quadCorners() { return {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}; }

// One quad over the whole picture, in a page of its own.
inline scenes::LightmapUvs wholePage() { return {quadCorners(), {{.page = 0}}}; }

// Two quads beside each other, the left and the right half of the picture, of two materials.
inline scenes::Scene makeTwoQuads() {
  scenes::Scene scene = makeQuadScene();
  scene.meshes = {makeQuad(0), makeQuad(1)};
  scene.materials.resize(2, scene.materials[0]);
  scene.instances.clear();
  for (const std::uint32_t k : {0u, 1u})
    scene.instances.push_back({k, glm::scale(translation(k == 0 ? -0.5f : 0.5f, 0, 0), {0.5f, 1, 1}), "half"});
  return scene;
}

struct ShadedPixel {
  glm::vec3 color{0.f}, position{0.f};
  std::uint32_t instance = 0;
  std::array<glm::vec3, shading::kTermCount> terms{};
  glm::vec3 operator[](shading::Term t) const { return terms[static_cast<std::size_t>(t)]; }
  glm::vec3 sum() const {
    glm::vec3 all(0);
    for (const glm::vec3& term : terms) all += term;
    return all;
  }
};

inline constexpr std::uint32_t kBakedSide = 8; // pixels of the picture

// The plane z = 0 from (-1,-1) to (1,1), seen along -Z: V = +Z at every pixel. In the order of the surface's entries.
template <typename MakeRenderer>
std::vector<ShadedPixel> shadeQuads(const gpu::Device& device, const scenes::Scene& scene,
                                    const scenes::LightmapUvs* lightmap, const MakeRenderer& makeRenderer) {
  const scenes::Camera camera = makeFrontCamera(1, 3, true);
  const gpu::SceneBuffers buffers(device, scene, gpu::SpecularAa::off, {}, lightmap);
  const gpu::SurfacePass pass(device, buffers, kBakedSide, kBakedSide);
  const std::vector<gpu::Surface> layers = pass.render(camera, {0, kBakedSide}, glm::vec2(0.5f));
  const gpu::Surface& surface = layers.front();
  EXPECT_EQ(surface.size(), std::size_t{kBakedSide} * kBakedSide);
  auto renderer = makeRenderer(buffers, pass.binKinds());
  const gpu::ShadedSurface shaded = renderer.shade(surface, camera);
  std::vector<ShadedPixel> pixels(surface.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i].color = glm::vec3(shaded.color[i]);
    const auto x = static_cast<float>(surface.pixels[i] % kBakedSide),
               y = static_cast<float>(surface.pixels[i] / kBakedSide);
    pixels[i].position = {(x + 0.5f) / kBakedSide * 2 - 1, 1 - (y + 0.5f) / kBakedSide * 2, 0};
    pixels[i].instance = surface.instances[i];
    for (std::size_t t = 0; t < shaded.terms.size(); ++t) pixels[i].terms[t] = glm::vec3(shaded.terms[t][i]);
  }
  return pixels;
}

// Cubes of one texel a face; copies of each `layers` times in turn. facesOf: (cube, face) -> radiance.
template <typename RadianceOf> gpu::EnvironmentMaps makeCubes(const gpu::Device& device, std::uint32_t count,
                                                              std::uint32_t layers, const RadianceOf& radianceOf) {
  gpu::EnvironmentMaps maps = makeConstantEnvironment(device, 0);
  std::vector<glm::vec4> texels;
  for (std::uint32_t cube = 0; cube < count; ++cube)
    for (std::uint32_t layer = 0; layer < layers; ++layer)
      for (std::uint32_t face = 0; face < 6; ++face) texels.emplace_back(radianceOf(cube, face), 1);
  const std::span<const std::byte> mip = std::as_bytes(std::span{texels});
  maps.cube =
      gpu::DeviceImage(device, {.format = vk::Format::eR32G32B32A32Sfloat, .cube = true, .arraySize = count * layers},
                       std::span{&mip, 1});
  return maps;
}

// The face of a cube that a direction hits.
inline std::uint32_t faceOf(const glm::dvec3& d) {
  const glm::dvec3 a = glm::abs(d);
  if (a.x >= a.y && a.x >= a.z) return d.x < 0 ? 1 : 0;
  if (a.y >= a.z) return d.y < 0 ? 3 : 2;
  return d.z < 0 ? 5 : 4;
}

// Flat normal maps of one texel, and the normal that it decodes to in makeQuad's frame.
inline glm::dvec3 leanByNormalMap(scenes::Scene& scene, std::uint8_t x, std::uint8_t y, std::uint8_t z) {
  scenes::TextureImage normal{"normal", base::Image8(1, 1, 4, 255)};
  normal.pixels.pixels = {x, y, z, 255};
  scene.images = {normal};
  for (scenes::Material& material : scene.materials) material.normalTexture.image = 0;
  return glm::normalize(glm::dvec3(x, y, z) / 255.0 * 2.0 - 1.0);
}

} // namespace parity::tests
