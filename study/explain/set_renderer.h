// Renders a view by sets of switches and measures each material of it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/metrics/measure_swaps.h"
#include "job/context.h"
#include "job/scene/scene_on_device.h"
#include "job/view/displayed.h"
#include "job/view/view_surfaces.h"
#include "study/explain/explanation.h"

namespace parity::explain {

class SetRenderer {
public:
  // scene: of `prepared`. settings: the first path's, and the picture's size. paths: the two.
  // All must outlive it.
  SetRenderer(job::Context& context, const job::PreparedScene& prepared, job::SceneOnDevice& scene,
              const job::Settings& settings, const job::PathChoice& paths, const scenes::Camera& camera);

  const std::vector<base::PixelList>& coverage() const { return m_coverage; } // a list for each material of the scene

  // Whether the light of both is shaded alike, and only stored in other formats.
  bool onlyStores(const job::Settings& a, const job::Settings& b) const;

  enum class Program { wide, specialised };
  // Mean FLIP of each of these materials, by the second path with these settings.
  std::vector<double> flip(const job::Settings& settings, Program program, const std::vector<std::size_t>& materials);
  // The same, pixel by pixel, in the order of each material's list.
  std::vector<std::vector<float>> flipMaps(const job::Settings& settings, const std::vector<std::size_t>& materials);
  // An intermediate of that path ("Roughness") by its first channel: a picture; nothing where the path has none of that
  // name.
  std::optional<base::Image> intermediate(const job::Settings& settings, const std::string& name);
  // What a pixel of each material costs by a program made for its class alone.
  std::vector<Cost> costs(const job::Settings& settings, const std::vector<std::size_t>& materials);

private:
  std::unique_ptr<paths::Renderer> makeRenderer(const job::Settings& settings, Program program,
                                                std::uint32_t intermediate = 0);
  compare::SwapMeasurement measure(const job::Settings& settings, Program program,
                                   const std::vector<std::size_t>& materials, bool maps);

  job::Context& m_context;
  const job::PreparedScene& m_prepared;
  const paths::Path& m_path;
  job::SceneOnDevice& m_scene;
  job::ViewSurfaces m_surfaces;
  std::vector<job::ViewSurfaces::Shaded> m_reference;
  std::vector<base::PixelList> m_coverage;
  job::Displayed m_displayed; // the first path's picture
  base::Image m_light;        // the same as exposed
  // The last set that was shaded: others that only store it otherwise are not shaded again.
  std::string m_shadedKey;
  std::vector<job::ViewSurfaces::Shaded> m_shaded;
};

} // namespace parity::explain
