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
  struct CostRequest {
    job::Settings settings;
    std::vector<std::size_t> materials;
  };
  // What a pixel of each material costs by a program made for its class alone: for each request, in the order of its
  // materials.
  std::vector<std::vector<Cost>> costs(const std::vector<CostRequest>& requests);
  // That path's picture as displayed, by specialised programs.
  base::Image8 picture(const job::Settings& settings);
  // Mean FLIP of each of these materials where the scene has others in their places, by both paths: of the same
  // textures and the same class (gpu::classify). The scene is as before afterwards.
  std::vector<double> flipOfAssets(const job::Settings& settings, Program program,
                                   const std::map<std::size_t, scenes::Material>& changed,
                                   const std::vector<std::size_t>& materials);
  // Texture coordinates of a material's pixels, of the set that the texture uses and by its transform: in the order of
  // the material's list, of the nearest layer that shows it. Nothing where the scene has no texture coordinates.
  std::vector<glm::vec2> texturePlaces(std::size_t material, const scenes::TextureSlot& texture) const;

private:
  using Shaded = std::vector<job::ViewSurfaces::Shaded>;
  // The first path's picture.
  struct Reference {
    Shaded shaded;
    job::Displayed displayed;
    base::Image light; // as exposed
  };
  Reference makeReference(const job::Settings& settings);
  std::unique_ptr<paths::Renderer> makeRenderer(const job::Settings& settings, Program program,
                                                std::uint32_t intermediate = 0);
  const Shaded& shade(const job::Settings& settings, Program program);
  compare::SwapMeasurement measure(const job::Settings& settings, const Reference& reference, const Shaded& shaded,
                                   const std::vector<std::size_t>& materials, bool maps);

  job::Context& m_context;
  const job::PreparedScene& m_prepared;
  const paths::Path &m_first, &m_path;
  job::SceneOnDevice& m_scene;
  job::ViewSurfaces m_surfaces;
  std::unique_ptr<paths::Renderer> m_firstRenderer;
  Reference m_reference;
  std::vector<base::PixelList> m_coverage;
  // The last set that was shaded: others that only store it otherwise are not shaded again.
  std::string m_shadedKey;
  Shaded m_shaded;
};

} // namespace parity::explain
