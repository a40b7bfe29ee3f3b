// What an engine's picture of the calibration scene says of the engine: where its pixels lie, its tone curve, how wide
// its filter is, and how its environment is turned.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/image/image.h"
#include "external/registration.h"
#include "external/transfer.h"

namespace parity::external {

struct CurveFit {
  Transfer transfer = Transfer::srgb;
  double error = 0; // root of the mean square difference of the 17 greys, in steps of 255
};

struct Calibration {
  Placement placement;          // at the size of the calibration picture
  double residual = 0;          // pixels that the marks are off after that: root of the mean square
  int quarterTurns = 0;         // the picture is turned by so many right angles, counter-clockwise
  std::vector<CurveFit> curves; // all known ones, the best first
  double filterWidth = 0;       // pixels of a box that would blur an edge as much; 0: one sample, at the pixel's middle
  struct Turn {
    bool isMirrored = false;
    double yawDeg = 0;   // about +Y; as Environment::rotationDeg has it
    double angleDeg = 0; // of the whole turn, about any axis
    double errorDeg = 0; // of the spots after it: root of the mean square
    int spots = 0;       // that were found
  };
  std::optional<Turn> environment; // nothing: too few spots are seen
};

// values: from 0 to 1 as they are in the file, 3 channels; square. Throws Error (exit 3, not comparable) "file: reason"
// where the marks are not found: it is another picture.
Calibration calibrate(const base::Image& values, const std::filesystem::path& file);

// Where the picture's values lie above a tenth of the known best curve's error: none of the known ones.
inline constexpr double kMostCurveError = 3;

// Line by line in words: what was found, and what is not as it should be.
std::vector<std::string> describe(const Calibration& calibration);

} // namespace parity::external
