// The points of one texel that light is gathered at: those of its sub-texels that can be seen.
#pragma once

#include <array>
#include <cstdint>

#include "bake/light/gather.h"

namespace parity::bake {

inline constexpr int kFactor = 4; // sub-texels along a texel's side: a bit each of a 16-bit mask, row by row

struct TexelPoints {
  std::array<SurfacePoint, kFactor * kFactor> points;
  std::array<std::uint8_t, kFactor * kFactor> subTexel{}; // of each
  std::size_t count = 0;
};

// Those of the mask's sub-texels that have a surface.
TexelPoints pointsOf(const TexelGrid& grid, const Texel& texel, std::uint16_t mask = 0xffff);

// Which of the points can be seen from anywhere, as a mask of sub-texels. Not those within a closed object or under one
// that lies on the surface: there rays meet the backs of surfaces that have but one side, or end within `near` metres.
std::uint16_t findValid(const TexelPoints& points, const lighting::Visibility& visibility,
                        const lighting::SurfaceLight& surfaces, double near, std::uint32_t seed, std::uint64_t& rays);

} // namespace parity::bake
