// The reference path over a surface: material values from the device, integrals on the CPU, results cached by content.
#pragma once

#include <memory>
#include <vector>

#include "gpu/surface/material_pass.h"
#include "job/scene/prepared_scene.h"
#include "reference/shade.h"

namespace parity::job {

// A surface shaded by the reference, and how well.
struct ReferenceSurface {
  gpu::ShadedSurface shaded;
  std::vector<float> standardErrors;  // of the colour, absolute, the worst channel; in the surface's order
  std::vector<std::uint32_t> samples; // taken of the environment for each way of sampling; in the surface's order
  std::uint64_t sampledPoints = 0;    // that were not in closed form
  std::uint64_t lightSamples = 0;     // taken for those, for each way of sampling
};

class ReferencePath {
public:
  // `prepared` and settings must outlive it; `prepared` holds the panorama, if there is an environment.
  ReferencePath(Context& context, const PreparedScene& prepared, const Settings& settings,
                const gpu::SceneBuffers& buffers, const std::vector<gpu::BinKind>& binKinds,
                std::uint64_t expectedEntries, const gpu::Compilation& compilation);

  // stream: tells apart the surfaces that share pixels (samples, layers), so that their noise is independent.
  ReferenceSurface shade(const gpu::Surface& surface, const scenes::Camera& camera, std::uint32_t stream,
                         const reference::Progress& progress);

private:
  std::string keyOf(const std::vector<reference::SurfaceSample>& samples) const;
  std::vector<reference::ShadedSample> integrate(const std::vector<reference::SurfaceSample>& samples,
                                                 const reference::Progress& progress);

  Context& m_context;
  const PreparedScene& m_prepared;
  const Settings& m_settings;
  gpu::MaterialPass m_materials;
  std::size_t m_termCount;
  std::string m_lightKey;                                   // of environment, lights, occluders, surfaces and options
  std::unique_ptr<reference::EnvironmentSampler> m_sampler; // made on first use: a cached result needs none of these
  std::unique_ptr<reference::DirectionalAlbedo> m_albedo;
  std::unique_ptr<reference::SheenAlbedo> m_sheenAlbedo; // where something has a sheen
  std::unique_ptr<lighting::Visibility> m_visibility;
  std::unique_ptr<lighting::Visibility> m_behind;     // where something is looked through, and some casters are too
  std::unique_ptr<lighting::Visibility> m_bodies;     // where something is seen through one
  std::unique_ptr<lighting::SurfaceLight> m_surfaces; // these two where light bounces or passes through
  std::unique_ptr<lighting::Emitters> m_emitters;
};

// Gathers the error of a picture from those of its surfaces.
class ErrorBuilder {
public:
  ErrorBuilder(int width, int height, int samples);
  // One (tile, sample), as gpu::FrameBuilder takes it.
  void begin(const gpu::Tile& tile);
  void lay(const gpu::Surface& surface, const ReferenceSurface& shaded);
  void end();
  // One channel: standard error of the worst channel over the brightest channel of this colour; 0 where nothing is
  // seen.
  base::Image take(const base::Image& color) const;
  // One channel: samples taken of the environment for each way of sampling.
  const base::Image& samples() const { return m_taken; }

private:
  int m_samples;
  // Of the standard error: of a tile's sample, and summed. The scramblings of samples and layers are apart.
  std::vector<double> m_sample, m_squares;
  std::size_t m_firstPixel = 0; // of the tile
  base::Image m_error, m_taken;
};

} // namespace parity::job
