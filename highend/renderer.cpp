#include "highend/renderer.h"

#include <algorithm>
#include <cassert>

#include "base/error.h"
#include "highend_shaders/highend.comp.h"

namespace parity::highend {

namespace {

gpu::DeviceImage uploadLut(const gpu::Device& device, const base::Image& lut) {
  assert(lut.channels == 2);
  constexpr auto kFormat = vk::Format::eR32G32Sfloat;
  if (!device.filtersLinearly(kFormat))
    throw base::Error(base::ExitCode::failed, device.report().name, "environment BRDF table",
                      "the device cannot filter 32-bit float textures");
  const gpu::DeviceImage::Shape shape{.format = kFormat,
                                      .width = static_cast<std::uint32_t>(lut.width),
                                      .height = static_cast<std::uint32_t>(lut.height)};
  const std::span<const std::byte> mip = std::as_bytes(std::span{lut.pixels});
  return gpu::DeviceImage(device, shape, std::span{&mip, 1});
}

} // namespace

Renderer::Renderer(const gpu::Device& device, const gpu::SceneBuffers& scene, const std::vector<gpu::BinKind>& binKinds,
                   const Inputs& inputs, const Options& options) {
  gpu::PathProgram program;
  program.name = "highend";
  program.spirv = kHighendComp;
  std::vector<scenes::Light> lights = inputs.lights;
  std::stable_partition(lights.begin(), lights.end(),
                        [](const scenes::Light& l) { return l.kind == scenes::LightKind::directional; });
  for (const scenes::Light& light : lights) {
    program.lights.push_back(gpu::packLight(light));
    ++(light.kind == scenes::LightKind::directional ? program.directionalCount : program.localCount);
  }
  if (needsLut(inputs, options)) {
    assert(inputs.lut != nullptr);
    m_lut = uploadLut(device, *inputs.lut);
    program.pathTexture = &m_lut;
  }
  program.environment = inputs.environment;
  program.constants = {options.geometryTerm == GeometryTerm::heightCorrelated ? gpu::kGeometryHeightCorrelated
                                                                              : gpu::kGeometrySchlickSmith,
                       options.compensate ? 1u : 0u};
  program.terms = inputs.terms;
  program.expectedPixels = inputs.expectedPixels;
  m_pass = std::make_unique<gpu::ShadingPass>(device, scene, binKinds, std::move(program));
}

} // namespace parity::highend
