// Pictures of the light of lights, made whole.
#pragma once

#include <span>
#include <vector>

#include "gpu/surface/shaded_plane.h"

namespace parity::gpu {

// The terms that are not of lights alone (shading/terms.h), without black ones. terms: in the order of shading::Term;
// planes of linear RGB. They must outlive the result.
std::vector<const ShadedPlane*> otherTerms(std::span<const ShadedPlane> terms);

// The picture with these terms added in their order. Shaders add them in the same one: without fog and lobes the sums
// have the bits of a shader that adds all terms. others: as long as the picture. The fourth values, opacities, stay
// those of the picture.
ShadedPlane withOtherTerms(const ShadedPlane& picture, std::span<const ShadedPlane* const> others);

} // namespace parity::gpu
