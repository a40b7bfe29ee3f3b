#include "compare/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"

namespace parity::compare {
namespace {

bool allFinite(const float* values, int count) {
  return std::all_of(values, values + count, [](float v) { return std::isfinite(v); });
}

} // namespace

NonFinite countNonFinite(const base::Image& image) {
  NonFinite found;
  for (int y = 0; y < image.height; ++y) {
    const float* row = image.at(0, y);
    const int values = image.width * image.channels;
    // x * 0 is 0 unless x is not finite: one sum per row says whether any is.
    float sum = 0;
    for (int i = 0; i < values; ++i) sum += row[i] * 0.f;
    if (sum == 0.f) continue;
    for (int x = 0; x < image.width; ++x) {
      if (allFinite(image.at(x, y), image.channels)) continue;
      if (found.count++ == 0) found.x = x, found.y = y;
    }
  }
  return found;
}

void requireFinite(const base::Image& image, const char* name) {
  const NonFinite found = countNonFinite(image);
  if (found.count == 0) return;
  throw base::Error(base::ExitCode::failed, name, "x " + std::to_string(found.x) + ", y " + std::to_string(found.y),
                    std::to_string(found.count) + (found.count == 1 ? " pixel is" : " pixels are") +
                        " NaN or infinite, this is the first");
}

double psnrOfMse(double mse) { return mse > 0 ? -10 * std::log10(mse) : std::numeric_limits<double>::infinity(); }

} // namespace parity::compare
