// Scenes whose irradiance is known, and baking them.
#pragma once

#include "bake/light/integrate.h"
#include "support/matte_scenes.h"

namespace parity::bake::tests {

using namespace parity::tests;

// A scene's atlas, texels and light together.
struct Baked {
  Atlas atlas;
  TexelGrid grid;
  StaticLight light;

  Baked(const scenes::Scene& scene, const BakeLights& lights, IntegrateOptions options = {}, double texelsPerMetre = 8,
        const Control& control = {})
      : atlas(makeAtlas(scene, {.texelsPerMetre = texelsPerMetre})), grid(scene, atlas, 4),
        light(integrate(scene, atlas, grid, lights, withDensity(options, texelsPerMetre), control)) {}

  // Of texels whose sub-texels are all there: what direct and gathered light make of them.
  template <typename Body> void forWhole(const Body& body) const {
    for (std::size_t i = 0; i < grid.texels().size(); ++i)
      if (light.valid[i] == 0xffff) {
        const Texel& t = grid.texels()[i];
        const auto a = grid.at(t.page, 4 * t.x + 1, 4 * t.y + 1), b = grid.at(t.page, 4 * t.x + 2, 4 * t.y + 2);
        SurfacePoint middle = *a;
        middle.position = 0.5f * (a->position + b->position);
        body(middle, light.direct[i], light.gathered[i]);
      }
  }

private:
  static IntegrateOptions withDensity(IntegrateOptions options, double texelsPerMetre) {
    options.texelsPerMetre = texelsPerMetre;
    return options;
  }
};

} // namespace parity::bake::tests
