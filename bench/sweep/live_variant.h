// A setting ready to be shaded, with all that it refers to.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "compare/permutation.h"
#include "highend/renderer.h"
#include "mobile/renderer.h"
#include "sweep/surfaces.h"
#include "sweep/variants.h"

namespace parity::sweep {

// While it lives, the device's times go to other timings than usual.
class DeviceTimings {
public:
  DeviceTimings(gpu::Device& device, base::Timings& timings, base::Timings& usual) : m_device(device), m_usual(usual) {
    m_device.setTimings(&timings);
  }
  ~DeviceTimings() { m_device.setTimings(&m_usual); }
  DeviceTimings(const DeviceTimings&) = delete;
  DeviceTimings& operator=(const DeviceTimings&) = delete;

private:
  gpu::Device& m_device;
  base::Timings& m_usual;
};

// What settings share: tables and prefiltered environments, each made once.
class Shared {
public:
  // Both must outlive it.
  Shared(job::Context& context, const job::PreparedScene& prepared) : m_context(context), m_prepared(prepared) {}

  // Null where the scene has no environment.
  const gpu::EnvironmentMaps* highendEnvironment(const lighting::PrefilterOptions& options);
  const gpu::EnvironmentMaps* mobileEnvironment(mobile::CaptureEncoding encoding);
  const base::Image& lut(const highend::Options& options, int size);
  // Of the lights of each path; null where the run has no shadows there. buffers: of the scene, whichever time.
  gpu::ShadowMaps* highendShadows(const gpu::SceneBuffers& buffers);
  gpu::ShadowMaps* mobileShadows(const gpu::SceneBuffers& buffers, const mobile::Options& options);
  // The scene's textures in such blocks, those that the surfaces show uploaded; null for none.
  const gpu::Textures* mobileTextures(const Surfaces& surfaces, base::TextureBlock block);
  // Does again what a setting of the stage preparation prepares, and forgets it.
  void prepareAgain(const Variant& v) const;

  job::Context& context() const { return m_context; }
  const job::PreparedScene& prepared() const { return m_prepared; }

private:
  job::Context& m_context;
  const job::PreparedScene& m_prepared;
  std::map<std::pair<int, int>, gpu::EnvironmentMaps> m_highend; // by samples and face size
  std::map<mobile::CaptureEncoding, gpu::EnvironmentMaps> m_mobile;
  std::map<base::TextureBlock, std::unique_ptr<const gpu::Textures>> m_textures;
  std::optional<gpu::ShadowMaps> m_highendShadows;
  std::map<std::vector<gpu::ShadowKey>, gpu::ShadowMaps> m_mobileShadows; // by the lights that have them
  std::map<std::tuple<highend::GeometryTerm, highend::FresnelCurve, int>, base::Image> m_luts;
};

class LiveVariant {
public:
  LiveVariant(const Variant& variant, const Surfaces& surfaces, Shared& shared);

  const Variant& variant() const { return m_variant; }
  std::vector<Surfaces::Shaded> shade() const {
    return m_highend ? m_surfaces.shade(*m_highend) : m_surfaces.shade(*m_mobile);
  }
  // The picture of what shade() gave.
  base::Image compose(const std::vector<Surfaces::Shaded>& shaded) const;
  // Counted; of one that has shaded.
  compare::PathCost cost() const;

private:
  Variant m_variant;
  const Surfaces& m_surfaces;
  Shared& m_shared;
  std::optional<highend::Renderer> m_highend; // or
  std::optional<mobile::Renderer> m_mobile;
};

} // namespace parity::sweep
