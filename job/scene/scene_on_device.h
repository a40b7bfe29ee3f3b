// A prepared scene on the device, and renderers of it by any path: what views, bakes and studies are rendered from.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "gpu/surface/surface_pass.h"
#include "job/scene/prepared_scene.h"

namespace parity::job {

class SceneOnDevice {
public:
  // settings: the scene's, or others to render it by. `prepared` and they must outlive it; onLastRead: of an image of
  // its scene (gpu/surface/textures.h).
  SceneOnDevice(Context& context, const PreparedScene& prepared, const Settings& settings, const PathChoice& paths,
                gpu::ImageDone onLastRead = {});

  struct RendererWish {
    bool terms = false;
    std::size_t leftOut = 0;       // pictures that lack a light each, in place of the terms
    bool lightsAlone = false;      // of those: paths::Inputs::lightsAlone
    bool wide = false;             // one program for many options, where the path has such
    bool originalTextures = false; // although the path compresses them
    std::uint32_t intermediate = 0;
    std::uint32_t hiddenFeatures = 0; // lobes to leave out
    std::uint64_t expectedPixels = 0;
    gpu::PermutationBudget budget{};
    std::shared_ptr<gpu::PermutationPlan> plan = nullptr; // of another renderer of the path, to need the same shaders
    bool planWritesTerms = false;                         // that renderer has terms
    const paths::Light* light = nullptr;                  // in place of the scene's: to compile by, not to shade
  };
  // options: the path's own, and those of other paths. What renderers share is uploaded once. They must not outlive
  // this.
  std::unique_ptr<paths::Renderer> makeRenderer(const paths::Path& path, const paths::Options& options,
                                                const RendererWish& wish);

  const gpu::SceneBuffers& buffers() const { return m_buffers; }
  const gpu::SurfacePass& surfacePass() const { return m_surfacePass; }
  // Whether the path has textures of its own with these options: compressed ones.
  bool hasOwnTextures(const paths::Path& path, const paths::Options& options) const;
  // Uploads what shading these layers will read, for all renderers at once.
  void requireTextures(const gpu::VisibleLayers& visible);
  // Images that have been uploaded in blocks.
  std::uint64_t compressedImages() const;

private:
  const gpu::Textures* texturesIn(base::TextureBlock block);
  const paths::Light& lightFor(const paths::Path& path, const paths::Options& options);

  Context& m_context;
  const PreparedScene& m_prepared;
  const Settings& m_settings;
  bool m_sharesTextures; // someone reads the scene's as they are
  gpu::ImageDone m_onLastRead;
  gpu::SceneBuffers m_buffers;
  gpu::SurfacePass m_surfacePass;
  std::map<base::TextureBlock, gpu::Textures> m_compressed;
  paths::Store m_store; // of all renderers
};

} // namespace parity::job
