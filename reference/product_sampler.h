// Directions by what they contribute to one point: light times lobe.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "reference/four_stretched.h"
#include "reference/light_pyramid.h"
#include "reference/sheen_lobe.h"

namespace parity::reference {

// What a point does with light, roughly: it decides where samples go, not what they count. Axes and view are of the
// panorama's own frame.
struct ProductLobe {
  glm::dvec3 normal{0.0, 1.0, 0.0}, view{0.0, 1.0, 0.0}; // unit; dot product positive
  double alpha = 1;
  double F0 = 0, F90 = 0;           // luminances; both 0: no GGX lobe
  double lambert = 0;               // reflectance of what is spread by the cosine
  const SheenLobe* sheen = nullptr; // null: none
  // Of an anisotropic lobe, in place of alpha.
  std::optional<StretchedAxes> stretched = std::nullopt;
  // Of a film: Fresnel's reflectance; empty: Schlick's from F0 to F90.
  std::function<double(double VoH)> luminanceOfFilm = nullptr;
};

// Sampling of a panorama by the product of its light and a lobe (after Clarberg et al. 2005, "Wavelet Importance
// Sampling", who multiply wavelets, and Clarberg and Akenine-Moller 2008): the panorama is divided into blocks, small
// where the lobe is bright and steep, each of which gets its light times the lobe at its middle, the lobe being widened
// by the block's size so that none is overlooked. A point of the unit square is warped down the tree of blocks - rows,
// then columns - and from a block to a cell by the light alone, so points that are stratified stay so. Where the lobe
// has any light at all, the density is above 0.
class ProductSampler {
public:
  struct Sample {
    int x = 0, y = 0;       // cell
    std::uint32_t node = 0; // its undivided block's
    glm::dvec3 direction{0.0};
  };

  // The pyramid must outlive it. besides: what the point shows of other light, as a luminance over the integral of the
  // panorama's: the more there is, the coarser the blocks.
  ProductSampler(const LightPyramid& light, const ProductLobe& lobe, double besides = 0);

  // Multiplies what the undivided blocks are expected to give: for what is left to be sampled of each. factors: of
  // every node, above 0; those of divided blocks are not read.
  void scale(const std::vector<double>& factors);

  // No light is above the horizon: there is nothing to sample.
  bool isBlack() const { return !(m_total > 0); }
  // u in (0, 1)^2.
  Sample sample(const glm::dvec2& u) const;
  // Of the undivided block that a place (EnvironmentSampler::placeOf) is in.
  std::uint32_t nodeOf(const glm::dvec2& place) const;
  // The density of sample() there over that of the light alone. node: of an undivided block.
  double gain(std::uint32_t node) const;

  // The tree, the whole first.
  struct Node {
    PanoramaBlock block;
    double weight = 0;       // estimate of the light reflected; of a parent: the sum
    double steepness = 0;    // spread of the block's half vectors over the lobe's width there
    bool isLarge = false;    // so that the lobe at its middle says little
    LightShares shares;      // of a parent
    std::uint32_t below = 0; // first of its four children; 0: none
  };
  const std::vector<Node>& nodes() const { return m_nodes; }
  // What a node's weight is to be measured by: the sum of all, and what there is besides.
  double shown() const { return m_nodes.front().weight + m_besides; }

private:
  void sumUp();
  void addFour(const std::array<PanoramaBlock, 4>& blocks, const ProductLobe& lobe);

  const LightPyramid& m_light;
  std::vector<Node> m_nodes;
  double m_total = 0, m_besides = 0;
};

} // namespace parity::reference
