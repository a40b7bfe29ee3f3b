#include "reference/replicates.h"

namespace parity::reference {

Integral meanOf(const std::array<Sum, kReplicates>& sums, std::uint32_t points) {
  Integral result;
  for (const Sum& s : sums) {
    result.diffuse += s.diffuse;
    result.specular += s.specular;
  }
  const double scale = 1.0 / points;
  result.diffuse *= scale / kReplicates;
  result.specular *= scale / kReplicates;
  glm::dvec3 squares(0.0);
  for (const Sum& s : sums) {
    const glm::dvec3 d = (s.diffuse + s.specular) * scale - (result.diffuse + result.specular);
    squares += d * d;
  }
  result.standardError = glm::sqrt(squares / (kReplicates * (kReplicates - 1.0)));
  result.samples = static_cast<int>(points) * kReplicates;
  return result;
}

} // namespace parity::reference
