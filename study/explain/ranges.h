// Where on a material its error lies: by what the shader has there.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/frame.h"
#include "base/image/image.h"
#include "study/explain/explanation.h"

namespace parity::explain {

// The shares of ten equal ranges of [0, 1] that hold pixels of the list. values: a picture whose first channel is the
// quantity (what is beyond counts at the end). errors: of each pixel of the list.
std::vector<RangeShare> sharesOf(const std::string& quantity, const base::PixelList& list, const base::Image& values,
                                 std::span<const float> errors);

// The part below or above some value, of any one quantity, with at least half of the error on as few pixels as
// possible: at most half as large a share of them. Its pixels and error; nothing where there is no such part.
std::optional<RangeShare> worstPart(const std::vector<RangeShare>& shares);

} // namespace parity::explain
