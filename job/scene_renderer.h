// Renders views of a prepared scene by every path over the very same surfaces.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/permutation.h"
#include "highend/renderer.h"
#include "job/prepared_scene.h"
#include "job/view_builder.h"
#include "mobile/renderer.h"

namespace parity::job {

class SceneRenderer {
public:
  // views: how many will be rendered, for the choice of permutations. budget: the scene's share of them in its run.
  // `prepared` must outlive the renderer; onLastRead: of an image of its scene (gpu/textures.h).
  SceneRenderer(Context& context, const PreparedScene& prepared, const Paths& paths, std::size_t views,
                const gpu::PermutationBudget& budget = {}, gpu::ImageDone onLastRead = {});

  // progress: of the reference path, which alone takes long.
  ViewFrames render(const scenes::Camera& camera, const Progress& progress = {});

  // Gives the frames of the view that was rendered last, by this camera, their terms, and these materials' their
  // termVariants, by shading it once more: the colours stay as they are. For runs without settings.terms.
  void addTerms(ViewFrames& frames, const scenes::Camera& camera, const std::vector<std::size_t>& materials);

  // For runs that ask for what mobile's dropped lights do (settings.droppedLights), where it may drop any: how many
  // samples the view that was rendered last shows of each instance. Else empty.
  const std::vector<std::uint64_t>& seenSamples() const { return m_seenSamples; }
  // That view again, by the high-end path with one of the prepared scene's lights out: the picture's colour. Only where
  // there are seenSamples.
  base::Image renderWithout(std::size_t light, const scenes::Camera& camera);

  // What the mobile path leaves out.
  std::vector<std::string> notes() const;
  // What the pictures so far leave out, in every path.
  std::vector<std::string> warnings() const;
  // What has been done so far, the scene's preparation included; and why the rest was not needed.
  Work work() const;          // without addTerms
  Work workWithTerms() const; // with it
  NoNeed reasons() const;

  // The shaders of the two paths so far, without those of addTerms.
  std::vector<compare::PermutationResult> permutations() const;

private:
  std::unique_ptr<highend::Renderer> makeHighend(bool terms, std::size_t views);
  std::unique_ptr<mobile::Renderer> makeMobile(bool terms, std::size_t views);
  void uploadBaked(const bake::BakedLight& baked, const Paths& paths);
  gpu::VisibleLayers rasterise(const scenes::Camera& camera, const gpu::Tile& tile, const glm::vec2& sample);
  gpu::Surface resolve(const gpu::VisibleLayers& visible, std::size_t layer, const scenes::Camera& camera);
  // By every path, laid over what is in `view` already.
  void shade(const gpu::Surface& surface, const scenes::Camera& camera, std::uint32_t stream,
             const reference::Progress& progress, ViewBuilder& view);
  // What pictures are composed of once more.
  struct Composition {
    std::function<void(const gpu::Tile&)> begin;
    std::function<void(const gpu::Surface&)> lay; // shades it into the pictures
    std::function<void()> end;
  };
  // Composes the surfaces of the view that was rendered last: those that were kept, else rasterised again.
  void layAgain(const scenes::Camera& camera, Work& work, const Composition& composition);
  mobile::Inputs mobileInputs(bool terms, std::size_t views);
  gpu::FrameBuilder makeFrame(bool terms) const;
  void countSurface(const gpu::Surface& surface, Work& work) const;
  void requireTextures(const gpu::VisibleLayers& visible);

  Context& m_context;
  const PreparedScene& m_prepared;
  std::size_t m_views;
  gpu::PermutationBudget m_budget;
  Work m_work, m_again; // by render and by addTerms
  gpu::SceneBuffers m_buffers;
  std::optional<gpu::Textures> m_mobileTextures; // the mobile path's own; none: those of m_buffers
  gpu::SurfacePass m_surfacePass;
  std::vector<gpu::Surface> m_kept; // all of the last view, where it may be shaded again: a picture in one part
  bool m_mayDropLights = false;     // and the run wants to know what they do
  std::vector<std::uint64_t> m_seenSamples;
  std::uint64_t m_cutPixels = 0; // of all views, with more blended layers than are shown
  // Each path reads its own kind.
  std::optional<gpu::EnvironmentMaps> m_environment, m_mobileEnvironment;
  std::optional<gpu::ShadowMaps> m_shadowMaps, m_mobileShadowMaps; // of all lights; of mobile's one sun and one spot
  std::optional<gpu::BakedMaps> m_baked, m_mobileBaked;            // likewise; the captures are the environments
  // Those with terms, and that whose lights are switched, are made when first needed.
  std::unique_ptr<highend::Renderer> m_highend, m_highendTerms, m_highendSwitched;
  std::unique_ptr<mobile::Renderer> m_mobile, m_mobileTerms;
  // Where its textures are compressed, and the run compares: with those of the scene.
  std::unique_ptr<mobile::Renderer> m_mobileOfOriginals;
  std::optional<ReferencePath> m_reference;
};

} // namespace parity::job
