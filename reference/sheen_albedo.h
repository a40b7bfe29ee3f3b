// The directional albedo of the sheen lobe, tabulated in double: what the sheen takes from the layers below it.
#pragma once

#include <vector>

namespace parity::reference {

// E(NoV): the integral of D_Charlie V_Charlie NoL over light directions (shading/sheen.glsl), the share of light from
// that cosine which a white sheen sends out. Cubic interpolation (Lagrange, four points) in roughness and in the fourth
// root of NoV. Within 6e-5 of the integral for NoV in [0.002, 1] and 4e-4 below, relative where it exceeds 1
// (tests/reference). Deterministic; made in about 40 ms on 2 cores.
class SheenAlbedo {
public:
  SheenAlbedo();

  // sheenRoughness: perceptual, [0, 1], below 0.07 as at 0.07; NoV in [0, 1], below 1e-4 as at 1e-4. Not negative. It
  // exceeds 1 at grazing views of a smooth sheen, where the published shadowing term lets more light out than came in.
  double at(double sheenRoughness, double NoV) const;

  // The same as a share: at most 1.
  double shareAt(double sheenRoughness, double NoV) const;

private:
  std::vector<double> m_nodes; // row by row, a roughness each
};

} // namespace parity::reference
