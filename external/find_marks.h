// Where the marks of the calibration scene lie in an engine's picture of it.
#pragma once

#include <cstddef>

#include "base/image/image.h"
#include "external/registration.h"

namespace parity::external {

struct FoundMarks {
  std::size_t count = 0; // of marks() that are where the placement says; below 2 the rest says nothing
  Placement placement{}; // of the picture, by least squares
  int quarterTurns = 0;  // the picture is turned by so many right angles, counter-clockwise
  double residual = 0;   // pixels that the marks are off after that: root of the mean square
};

// values: as they are in the file, 3 channels, square.
FoundMarks findMarks(const base::Image& values);

} // namespace parity::external
