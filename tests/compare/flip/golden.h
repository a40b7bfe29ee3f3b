// Golden FLIP maps: comparison, and what a failed one leaves behind.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "base/image/image.h"
#include "base/image/pfm.h"

namespace parity::test {

inline std::filesystem::path goldenFolder() {
  return std::filesystem::path(PARITY_SOURCE_DIR) / "tests" / "compare" / "flip" / "golden";
}

inline std::filesystem::path testOutput() { return std::filesystem::path(PARITY_BINARY_DIR) / "test-output"; }

// Passes where no pixel of `actual` is further than `tolerance` from the golden map `name`.pfm. Otherwise leaves
// name.{actual,expected,difference}.pfm in `folder` and prints the command that would update the golden. (The maps come
// from the reference tool: update one only if that tool's output has changed.)
inline ::testing::AssertionResult matchesGolden(const base::Image& actual, const std::string& name, double tolerance,
                                                const std::filesystem::path& folder = testOutput()) {
  const std::filesystem::path golden = goldenFolder() / (name + ".pfm");
  const base::Image expected = base::readPfm(golden); // throws, and so fails, where it is missing
  if (actual.width != expected.width || actual.height != expected.height || actual.channels != expected.channels)
    return ::testing::AssertionFailure() << name << ": the golden is " << expected.width << " x " << expected.height
                                         << ", the map " << actual.width << " x " << actual.height;
  base::Image difference = expected;
  double worst = 0;
  int over = 0;
  std::size_t worstAt = 0;
  for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
    difference.pixels[i] = actual.pixels[i] - expected.pixels[i];
    const double error = std::fabs(static_cast<double>(actual.pixels[i]) - static_cast<double>(expected.pixels[i]));
    if (!(error <= tolerance)) ++over; // NaN is over
    if (!(error <= worst)) {
      worst = error;
      worstAt = i;
    }
  }
  ::testing::Test::RecordProperty(name + ".worst", std::to_string(worst));
  if (over == 0) return ::testing::AssertionSuccess() << "worst " << worst;

  std::filesystem::create_directories(folder);
  const auto fileOf = [&](const char* kind) { return folder / (name + "." + kind + ".pfm"); };
  base::writePfm(fileOf("actual"), actual);
  base::writePfm(fileOf("expected"), expected);
  base::writePfm(fileOf("difference"), difference);
  const auto width = static_cast<std::size_t>(expected.width);
  return ::testing::AssertionFailure() << name << ": " << over << " pixels differ by more than " << tolerance
                                       << ", the worst by " << worst << " at x " << worstAt % width << ", y "
                                       << worstAt / width << "\nSee " << fileOf("*").string()
                                       << "\nTo update the golden: cp " << fileOf("actual").string() << " "
                                       << golden.string();
}

} // namespace parity::test
