// A control variate for light times lobe: the lobe made linear, block by block, whose integral is known.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "reference/environment_sampler.h"
#include "reference/four_directions.h"
#include "reference/product_sampler.h"

namespace parity::reference {

// In every undivided block of a product sampler that lies above the horizon and where the lobe is not too steep, the
// lobe's value is replaced by a constant plus a linear function of the direction, fitted to the two-point Gauss nodes
// along row and column. The integral of that times the panorama's radiance is a sum over the blocks' moments, without
// noise; what is left to be sampled is small wherever the lobe is smooth (control variates: Owen, "Monte Carlo theory,
// methods and examples", section 8.9).
class LinearControl {
public:
  // What each of four directions (the panorama's frame, above the horizon) adds per unit of radiance and steradian,
  // each channel; roughly is enough.
  using Lobe = std::function<std::array<Float4, 3>(const FourDirections& directions)>;
  LinearControl(const EnvironmentSampler& environment, const ProductSampler& product, const glm::dvec3& normal,
                const Lobe& lobe);

  // Of the control over the whole panorama.
  const glm::dvec3& integral() const { return m_integral; }
  // Of every node, what share of its light it is expected to leave to be sampled, roughly.
  const std::vector<double>& remainders() const { return m_remainders; }
  // The control in a direction of the block of this node of the product's tree.
  glm::dvec3 at(std::uint32_t node, const glm::dvec3& direction) const {
    const Fit& fit = m_fits[m_fitOf[node]];
    return fit.constant + fit.slope * direction;
  }

private:
  struct Fit {
    glm::dvec3 constant{0.0};
    glm::dmat3 slope{0.0}; // columns: by the coordinate of the direction
  };
  std::vector<Fit> m_fits;            // the first is 0
  std::vector<std::uint32_t> m_fitOf; // of each node
  std::vector<double> m_remainders;   // the same
  glm::dvec3 m_integral{0.0};
};

} // namespace parity::reference
