#include "reference/view_albedo.h"

#include <algorithm>

namespace parity::reference {

ViewAlbedo integrateView(const StretchedLobe& lobe, const glm::dvec3& view,
                         const std::function<glm::dvec3(double VoH)>& fresnel) {
  // Fibonacci's numbers. Of round lobes the table has E; the mean of F, which is flatter, needs fewer points.
  const bool isRound = lobe.alphaT == lobe.alphaB;
  const int points = isRound ? 377 : 987, step = isRound ? 233 : 610;
  // f cos / pdf = D V NoL over D times this.
  const double weight = 1 / (lobe.pdfOverD(view) * points);
  ViewAlbedo sum;
  for (int i = 0; i < points; ++i) {
    const double y = (i + 0.5) / points, x = (i * step % points + 0.25) / points;
    const glm::dvec3 h = lobe.sampleHalf(view, {x, y * y * (3 - 2 * y)});
    const double VoH = glm::dot(view, h);
    const glm::dvec3 light = 2 * VoH * h - view;
    if (!(VoH > 0 && light.z > 0)) continue;
    const double share = weight * 6 * y * (1 - y) * lobe.V(view, light) * light.z;
    sum.E += share;
    sum.reflected += share * fresnel(std::min(VoH, 1.0));
  }
  return sum;
}

} // namespace parity::reference
