// The stage `encoding`: what the mobile path's render target alone makes of its picture.
#pragma once

#include <optional>
#include <string>

#include "compare/figures.h"

namespace parity::compare {

// Of a material or a whole image. The reference is the mobile picture before its target, the test is that after it,
// both as displayed.
struct Encoding {
  std::string target;    // "rgba8-gamma2"
  RegionFigures figures; // flip.mean, flip.p95, flip.max, bias.*
};

// Whether anything of it would show in a table: a mean FLIP of at least 0.0005, or one that is not known.
bool isNotable(const std::optional<Encoding>& encoding);

// "stored in rgba8-gamma2: FLIP 0.031 on average, 0.052 p95, 0.071 at most; 0.3 EV darker": the interior's, or of all
// pixels where `whole` or where there is no interior. Empty where there are none.
std::string describeEncoding(const std::optional<Encoding>& encoding, bool whole);

} // namespace parity::compare
