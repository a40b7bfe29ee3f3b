// What an engine's picture of the calibration scene says of the engine: where its pixels lie, its tone curve, how wide
// its filter is, and how its environment is turned.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/image/image.h"
#include "external/encoding.h"
#include "external/registration.h"

namespace parity::external {

struct CurveFit {
  Transfer transfer = Transfer::srgb;
  double error = 0; // root of the mean square difference of the 17 greys, in steps of 255
};

struct Calibration {
  Placement placement;               // at the size of the calibration picture
  double residual = 0;               // pixels that the marks are off after that: root of the mean square
  int quarterTurns = 0;              // the picture is turned by so many right angles, counter-clockwise
  std::vector<CurveFit> curves;      // all known ones, the best first
  std::optional<FittedCurve> fitted; // nothing: its greys are no curve
  // Light by which the coloured marks are off by the fitted curve, at most, of a channel: where it is not near 0 the
  // engine's curve mixes channels.
  double mixing = 0;
  double filterWidth = 0; // pixels of a box that would blur an edge as much; 0: one sample, at the pixel's middle
  struct Turn {
    bool isMirrored = false;
    double yawDeg = 0;   // about +Y; as Environment::rotationDeg has it
    double angleDeg = 0; // of the whole turn, about any axis
    double errorDeg = 0; // of the spots after it: root of the mean square
    int spots = 0;       // that were found
  };
  std::optional<Turn> environment; // nothing: too few spots are seen
};

// values: from 0 to 1 as they are in the file, finite, 3 channels; square. Throws Error (exit 3, not comparable)
// "file: reason" where the marks are not found: it is another picture.
Calibration calibrate(const base::Image& values, const std::filesystem::path& file);

// A picture whose greys are further off than that from each known curve has none of them; in steps of 255.
inline constexpr double kMostCurveError = 3;
// What a curve for each channel may leave of the marks' colours.
inline constexpr double kMostMixing = 0.02;
// The widest filter that is compared, and by how much it may differ from ours in silence; pixels.
inline constexpr double kWidestFilter = 2.5, kSameFilter = 0.25;

// Whether, and how well, the fitted curve serves: a sentence.
std::string describeFit(const Calibration& calibration);

// Line by line in words: what was found, and what is not as it should be.
std::vector<std::string> describe(const Calibration& calibration);

} // namespace parity::external
