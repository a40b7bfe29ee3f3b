// Renders views of a prepared scene by every path over the very same surfaces.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/frame.h"
#include "compare/permutation.h"
#include "gpu/frame_builder.h"
#include "highend/renderer.h"
#include "job/prepared_scene.h"
#include "job/reference_path.h"
#include "mobile/renderer.h"

namespace parity::job {

struct ViewFrames {
  base::Frame highend, mobile, reference; // empty where not asked for
  base::Image referenceError;             // relative standard error of each pixel (job/reference_path.h)
  base::Image referenceTaken;             // samples of each pixel, of the environment, for each way of sampling
  double referenceSamples = 0;            // taken of the environment, a point and way of sampling
  std::vector<base::PixelList> coverage;  // a list per material; empty unless highend and mobile are asked for
  base::Image mobileBeforeTarget;         // mobile's colour as if nothing were stored; empty like coverage
};

class SceneRenderer {
public:
  // views: how many will be rendered, for the choice of permutations. budget: the scene's share of them in its run.
  // `prepared` must outlive the renderer.
  SceneRenderer(Context& context, const PreparedScene& prepared, const Paths& paths, std::size_t views,
                const gpu::PermutationBudget& budget = {});

  // progress: of the reference path, which alone takes long.
  ViewFrames render(const scenes::Camera& camera, const Progress& progress = {});

  // Gives the frames of the view that was rendered last, by this camera, their terms, by shading it once more: the
  // colours stay as they are. For runs without settings.terms.
  void addTerms(ViewFrames& frames, const scenes::Camera& camera);

  // What the mobile path leaves out.
  std::vector<std::string> notes() const;
  // What has been done so far, the scene's preparation included; and why the rest was not needed.
  Work work() const;          // without addTerms
  Work workWithTerms() const; // with it
  NoNeed reasons() const;

  // The shaders of the two paths so far, without those of addTerms.
  std::vector<compare::PermutationResult> permutations() const;

private:
  std::unique_ptr<highend::Renderer> makeHighend(bool terms, std::size_t views);
  std::unique_ptr<mobile::Renderer> makeMobile(bool terms, std::size_t views) const;
  struct Layers {
    gpu::Surface opaque, blended;
  };
  Layers rasterise(const scenes::Camera& camera, const gpu::Tile& tile, const glm::vec2& sample);
  void countSurfaces(const gpu::Surface& opaque, const gpu::Surface& blended);

  Context& m_context;
  const PreparedScene& m_prepared;
  gpu::PermutationBudget m_budget;
  Work m_work, m_again; // by render and by addTerms
  gpu::SceneBuffers m_buffers;
  gpu::SurfacePass m_surfacePass;
  std::optional<Layers> m_kept; // of the last view, where addTerms may need them: a picture in one part
  // Each path reads its own kind.
  std::optional<gpu::EnvironmentMaps> m_environment, m_mobileEnvironment;
  std::unique_ptr<highend::Renderer> m_highend, m_highendTerms; // those with terms are made when first needed
  std::unique_ptr<mobile::Renderer> m_mobile, m_mobileTerms;
  std::optional<ReferencePath> m_reference;
};

} // namespace parity::job
