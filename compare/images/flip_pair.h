// One pair of pictures through parity flip.
#pragma once

#include "compare/images/flip_run.h"

namespace parity::compare {

// Reads, checks, measures, judges and writes what request.outputs asks for. Throws Error for whatever keeps the pair
// from being compared, with the exit code of docs/design.md 8a; `result` says what was found out until then.
void compareFiles(const FlipRequest& request, FlipPair& result);

} // namespace parity::compare
