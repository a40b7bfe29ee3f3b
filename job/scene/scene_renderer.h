// Renders views of a prepared scene by every path over the very same surfaces.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "job/scene/scene_on_device.h"
#include "job/view/view_builder.h"
#include "report/permutation.h"

namespace parity::job {

class SceneRenderer {
public:
  // views: how many will be rendered, for the choice of permutations. budget: the scene's share of them in its run.
  // settings, `prepared` and onLastRead: as of SceneOnDevice.
  SceneRenderer(Context& context, const PreparedScene& prepared, const Settings& settings, const PathChoice& paths,
                std::size_t views, const gpu::PermutationBudget& budget = {}, gpu::ImageDone onLastRead = {});
  // Of beginScene, by the settings of `prepared`: finishes its light. Until that is ready it compiles what the first
  // view needs, if that is a picture in one part: one part of several does not tell what all need. Throws as
  // finishLight.
  SceneRenderer(Context& context, PreparedScene& prepared, const scenes::Camera& firstView, const PathChoice& paths,
                std::size_t views, const gpu::PermutationBudget& budget, gpu::ImageDone onLastRead);

  // progress: of the truth, which alone takes long.
  ViewFrames render(const scenes::Camera& camera, const Progress& progress = {});

  // Gives the frames of the view that was rendered last, by this camera, their terms, and these materials' the
  // termVariants of the path at that place: from what render has kept, else by shading it once more. The colours stay
  // as they are. For runs without settings.terms.
  void addTerms(ViewFrames& frames, std::size_t path, const scenes::Camera& camera,
                const std::vector<std::size_t>& materials);

  // For runs that ask for what a path's dropped lights do (settings.droppedLights), where it may drop any: how many
  // samples the view that was rendered last shows of each instance. Else empty.
  const std::vector<std::uint64_t>& seenSamples() const { return m_seenSamples; }
  // That view again, by the first path, without each of these lights of the prepared scene. Gives `take` the place
  // among them and the picture's colour, in their order; few pictures are there at the same time. Only where there are
  // seenSamples.
  void renderWithout(std::span<const std::size_t> lights, const scenes::Camera& camera,
                     const std::function<void(std::size_t, const base::Image&)>& take);

  // Compiles the shaders that renderWithout will need for so many lights; for a picture in several parts none. Another
  // thread may call it while nothing else uses the device.
  void compileWithout(std::size_t lights, const scenes::Camera& camera);

  // That view again, by the first path without these lobes (of gpu::kFeatureLobes). Only where it
  // hidesLobes.
  base::Image renderWithoutLobes(std::uint32_t features, const scenes::Camera& camera);

  const PathChoice& paths() const { return m_choice; }
  const paths::Renderer& renderer(std::size_t path) const { return *m_paths[path].plain; }

  // What the paths leave out, by their names.
  std::vector<std::string> notes() const;
  // What the pictures so far leave out, in every path.
  std::vector<std::string> warnings() const;
  // What has been done so far, the scene's preparation included; and why the rest was not needed.
  Work work() const;          // without addTerms
  Work workWithTerms() const; // with it
  NoNeed reasons() const;

  // The shaders of the paths so far, without those of addTerms.
  std::vector<report::PermutationResult> permutations() const;

private:
  using Layers = std::vector<std::vector<gpu::Bin>>; // the bins of each
  static Layers layersOf(const gpu::VisibleLayers& visible);
  struct PathState {
    const paths::Path* path = nullptr;
    std::unique_ptr<paths::Renderer> plain;       // with terms where m_shadesTerms
    std::unique_ptr<paths::Renderer> ofOriginals; // where it has textures of its own, and the run compares
    // Made when first needed. withoutOne: a light less, by the shaders of `plain`; withoutSome: several pictures at
    // once, each without a light, by shaders of its own; lightsAlone: the same, of the light of lights alone.
    std::unique_ptr<paths::Renderer> withTerms, withoutOne, withoutSome, lightsAlone;
    std::map<std::uint32_t, std::unique_ptr<paths::Renderer>> without; // the same, without some lobes
    std::optional<gpu::Backdrop> backdrop; // of the last view, where the path reads one; the path's renderers share it

    void giveBackdrop(paths::Renderer& renderer) const { renderer.setBackdrop(backdrop ? &*backdrop : nullptr); }
  };
  std::unique_ptr<paths::Renderer> makeRenderer(const paths::Path& path, SceneOnDevice::RendererWish wish,
                                                std::size_t views);
  std::unique_ptr<paths::Renderer> makeRenderer(const paths::Path& path, const paths::Options& options,
                                                SceneOnDevice::RendererWish wish, std::size_t views);
  // All but its renderers; `prepared` may lack its light.
  struct WithoutLight {};
  SceneRenderer(WithoutLight, Context& context, const PreparedScene& prepared, const Settings& settings,
                const PathChoice& paths, std::size_t views, const gpu::PermutationBudget& budget,
                gpu::ImageDone onLastRead);
  void makeRenderers();
  void compileAhead(const scenes::Camera& camera);
  bool mayDropLights() const;
  bool mayDropLobes() const;
  gpu::VisibleLayers rasterise(const scenes::Camera& camera, const gpu::Tile& tile, const glm::vec2& sample);
  // What lies behind surfaces that light passes through, by the paths that read it.
  void renderBackdrops(const scenes::Camera& camera);
  gpu::Surface resolve(const gpu::VisibleLayers& visible, std::size_t layer, const scenes::Camera& camera);
  // By every path, laid over what is in `view` already. Returns what each path, without the what-ifs, made of it.
  std::vector<gpu::ShadedSurface> shade(const gpu::Surface& surface, const scenes::Camera& camera, std::uint32_t stream,
                                        const reference::Progress& progress, ViewBuilder& view);
  // A layer of the last view. shaded: what each path made of it, with terms; empty where they are not kept.
  struct KeptLayer {
    gpu::Surface surface;
    std::vector<gpu::ShadedSurface> shaded;
  };
  // What pictures are composed of once more.
  struct Composition {
    std::function<void(const gpu::Tile&, std::size_t layers)> begin;
    std::function<void(const KeptLayer&)> lay; // shades it into the pictures
    std::function<void()> end;
  };
  // Composes the surfaces of the view that was rendered last: those that were kept, else rasterised again.
  void layAgain(const scenes::Camera& camera, Work& work, const Composition& composition);
  // Whether shading so many lights once for all pictures saves more than compiling the shaders for it takes.
  bool paysAtOnce(std::size_t lights) const;
  struct Without {
    paths::Renderer& renderer;
    std::size_t most = 0;     // lights that it leaves out at once
    bool lightsAlone = false; // its pictures lack the other terms
  };
  Without rendererWithout(std::size_t lights); // the first path's, for so many
  bool keepsTerms() const;                     // of the last view, by all paths
  gpu::FrameBuilder makeFrame() const;         // without terms
  void countSurface(const gpu::Surface& surface, Work& work) const;

  Context& m_context;
  const PreparedScene& m_prepared;
  const Settings& m_settings;
  const PathChoice m_choice;
  std::size_t m_views;
  gpu::PermutationBudget m_budget;
  Work m_work, m_again;                 // by render and by addTerms
  std::vector<paths::Light> m_standIns; // what compileAhead lit by; must not end before m_scene
  SceneOnDevice m_scene;
  std::vector<std::shared_ptr<gpu::PermutationPlan>> m_plans; // the paths' by compileAhead; empty where it did not run
  bool m_mayAddTerms = false;                                 // to views with materials over their budgets
  bool m_shadesTerms = false;    // the plain renderers write them: the settings ask for them, or addTerms may
  bool m_mayDropLobes = false;   // and the run wants to know what they are worth
  std::vector<KeptLayer> m_kept; // all of the last view, where it may be shaded again: a picture in one part
  bool m_mayDropLights = false;  // and the run wants to know what they do
  std::vector<std::uint64_t> m_seenSamples;
  // What the first part of all views shows behind surfaces that light passes through, and in all of its layers.
  Layers m_firstLayers;
  std::uint64_t m_cutPixels = 0;    // of all views, with more blended layers than are shown
  std::vector<PathState> m_paths;   // as chosen
  std::vector<PathState> m_whatIfs; // as in the settings
  std::optional<ReferencePath> m_truth;
};

} // namespace parity::job
