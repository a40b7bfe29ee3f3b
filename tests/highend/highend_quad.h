// One quad, shaded by the high-end path.
#pragma once

#include "support/path_quad.h"

#include <algorithm>

#include "highend/renderer.h"

namespace parity::highend {

// Lambert, single scattering, N = V = R: without an environment no table is read.
inline const Options kPlain{
    .model = {.diffuse = DiffuseLobe::lambert}, .compensation = Compensation::none, .offSpecular = OffSpecular::none};

// A table with the same A, B and average everywhere.
inline base::Image constantLut(float a, float b, float average = 0.5f) {
  base::Image lut(2, 2, 4);
  for (int i = 0; i < 4; ++i) {
    const float texel[] = {a, b, average, 1};
    std::copy_n(texel, 4, lut.pixels.data() + 4 * i);
  }
  return lut;
}

class HighendTest : public tests::DeviceTest {
protected:
  tests::ShadedPoint shade(const scenes::Scene& scene, Inputs inputs, const Options& options = {}) {
    inputs.terms = true;
    inputs.compilation.store = &pipelines();
    return tests::shadeQuad(device(), scene, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, inputs, options);
    });
  }
};

} // namespace parity::highend
