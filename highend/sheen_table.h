// The directional albedo of the sheen's lobe, as a table.
#pragma once

#include "base/image/image.h"

namespace parity::highend {

// A size x size image of one channel: the directional albedo of D_Charlie V_Charlie (shading/sheen.glsl), in [0, 1].
// x -> NoV, y -> sheenRoughness, as makeEnvBrdfLut has them. Below the smallest roughness of sheenAlpha its value
// there. Beside grazing views of smooth sheen the albedo itself exceeds 1, which the table cuts off. By quadrature;
// within 1e-3 of its limit over NoV >= .02. Bit-identical for any number of threads.
base::Image makeSheenTable(int size);

} // namespace parity::highend
