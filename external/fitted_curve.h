// The tone curve of an engine, read from the greys of its picture of the calibration scene: one for each channel.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "external/calibration_scene.h"
#include "external/transfer.h"

namespace parity::external {

class FittedCurve {
public:
  // seen: the picture's value of each grey of the ramp, from 0 to 1. Nothing where they are no curve: some grey is
  // darker than the one before it by more than rounding to 8 bits explains, or fewer than four differ.
  static std::optional<FittedCurve> fit(const std::array<Rgb, kRampSteps>& seen);

  // Light from 0 to 1. Between the greys a monotone cubic (Fritsch and Butland 1984) over the ramp's even steps.
  Rgb light(const Rgb& value) const;
  // Whether some channel is as bright as the ramp's white: the picture tells no more than "at least this much light".
  bool isClipped(const Rgb& value) const;

private:
  struct Node {
    double value = 0; // of the picture
    double step = 0;  // of the ramp, from 0 to 1
    double slope = 0; // of the step over the value
  };
  static double stepAt(const std::vector<Node>& nodes, double value);
  std::array<std::vector<Node>, 3> m_channels; // values grow
};

} // namespace parity::external
