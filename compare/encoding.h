// The stages `encoding` and `textures`: what the mobile path's render target, and the compression of its textures,
// alone make of its picture.
#pragma once

#include <optional>
#include <string>

#include "compare/figures.h"

namespace parity::compare {

// Of a material or a whole image. The reference is the mobile picture before its target, the test is that after it,
// both as displayed.
struct Encoding {
  std::string target; // "rgba8-gamma2"
  Figures figures;    // flip.mean, flip.p95, flip.max, bias.*
};

// Of a material or a whole image. The reference is the mobile picture with its textures as they are, the test is that
// with them compressed, both after the target and as displayed.
struct TextureCompression {
  std::string block; // "astc6x6"
  Figures figures;   // flip.mean, flip.p95, flip.max, bias.*
};

// Whether anything of it would show in a table: a mean FLIP of at least 0.0005, or one that is not known.
bool isNotable(const std::optional<Encoding>& encoding);

} // namespace parity::compare
