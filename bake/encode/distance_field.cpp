#include "bake/encode/distance_field.h"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "bake/encode/distance_field_fit.h"
#include "bake/encode/distance_transform.h"
#include "bake/encode/mask_blur.h"
#include "base/error.h"
#include "base/parallel.h"

namespace parity::bake {

namespace {

// Bilinear reading at a chart's sub-texels reaches one texel beyond those that it touches.
constexpr int kMargin = 1;

void requireSense(const DistanceFieldOptions& options) {
  if (!(options.range > 0 && options.penumbra > 0 && options.penumbra <= 2 * options.range && options.range <= 1e4) ||
      options.sweeps < 0)
    throw base::fileError(
        "distance field", "options",
        fmt::format("range {}, penumbra {}, {} sweeps: the penumbra must be at most twice the range, and all "
                    "must be above 0",
                    options.range, options.penumbra, options.sweeps));
}

base::BasicImage<std::int32_t> distancesTo(const ChartMask& chart, std::uint8_t sight) {
  base::Image8 sources(chart.sight.width, chart.sight.height, 1);
  for (std::size_t i = 0; i < sources.pixels.size(); ++i) sources.pixels[i] = chart.sight.pixels[i] == sight;
  return squaredDistances(sources);
}

// The known sub-texel nearest to an unknown one, within two texels; itself where there is none.
glm::ivec2 findNearestKnown(const ChartMask& chart, const glm::ivec2& from) {
  const int reach = 2 * chart.factor;
  glm::ivec2 nearest = from;
  int least = std::numeric_limits<int>::max();
  for (int y = std::max(from.y - reach, 0); y <= std::min(from.y + reach, chart.sight.height - 1); ++y)
    for (int x = std::max(from.x - reach, 0); x <= std::min(from.x + reach, chart.sight.width - 1); ++x) {
      const int square = (x - from.x) * (x - from.x) + (y - from.y) * (y - from.y);
      if (*chart.sight.at(x, y) == kUnknown || square >= least) continue;
      least = square;
      nearest = {x, y};
    }
  return nearest;
}

// Signed distances to the edge at the middles of texels, in texels; infinite without one. What is unknown goes on with
// what is nearest to it.
std::vector<double> signedDistances(const ChartMask& chart) {
  const auto toLit = distancesTo(chart, kLit), toShadow = distancesTo(chart, kShadowed);
  const auto at = [&](glm::ivec2 p) {
    if (*chart.sight.at(p.x, p.y) == kUnknown) p = findNearestKnown(chart, p);
    const auto read = [&](const auto& image) {
      const std::int32_t square = *image.at(p.x, p.y);
      return square == kNoSource ? std::numeric_limits<double>::infinity() : std::sqrt(static_cast<double>(square));
    };
    const double lit = read(toLit), shadow = read(toShadow);
    return lit < shadow ? shadow - 0.5 : 0.5 - lit;
  };
  std::vector<double> distances;
  const int factor = chart.factor, first = (factor - 1) / 2, second = factor / 2; // the same where the factor is odd
  for (int y = 0; y < chart.height(); ++y)
    for (int x = 0; x < chart.width(); ++x) {
      const glm::ivec2 corner(x * factor, y * factor);
      double sum = 0;
      for (const int row : {first, second})
        for (const int column : {first, second}) sum += at(corner + glm::ivec2(column, row));
      distances.push_back(sum / 4 / factor);
    }
  return distances;
}

// A chart's own texels and the margin around.
struct ChartField {
  int texelX = 0, texelY = 0;
  base::Image8 codes;
  std::vector<int> known; // sub-texels of each texel

  // How good the chart's right to a texel is: by its sub-texels within, else by those within the eight around.
  std::pair<int, int> claimOf(int x, int y) const {
    int around = 0;
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, codes.height - 1); ++row)
      for (int column = std::max(x - 1, 0); column <= std::min(x + 1, codes.width - 1); ++column)
        around += known[static_cast<std::size_t>(row) * codes.width + column];
    return {known[static_cast<std::size_t>(y) * codes.width + x], around};
  }
};

ChartField makeChartField(const ChartMask& chart, const DistanceFieldOptions& options) {
  ChartField field{chart.texelX, chart.texelY, base::Image8(chart.width(), chart.height(), 1), {}};
  const std::vector<double> distances = signedDistances(chart);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double d = std::clamp(encodeDistance(distances[i], options), 0.0, 1.0);
    field.codes.pixels[i] = static_cast<std::uint8_t>(255 * d + 0.5);
  }
  field.known.assign(distances.size(), 0);
  bool isLit = false, isShadowed = false;
  for (int y = 0; y < chart.sight.height; ++y)
    for (int x = 0; x < chart.sight.width; ++x) {
      const std::uint8_t sight = *chart.sight.at(x, y);
      isLit |= sight == kLit;
      isShadowed |= sight == kShadowed;
      field.known[static_cast<std::size_t>(y / chart.factor) * field.codes.width + x / chart.factor] +=
          sight != kUnknown;
    }
  if (isLit && isShadowed && options.sweeps > 0)
    fitCodes(chart, blurMask(chart, options.penumbra), transitionScaleOf(options), options.sweeps, field.codes);
  return field;
}

} // namespace

DistanceField makeDistanceField(const SunMask& mask, const DistanceFieldOptions& options) {
  requireSense(options);
  const std::vector<MaskChart> charts = findCharts(mask);
  std::vector<ChartField> fields(charts.size());
  base::parallelFor(charts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) fields[i] = makeChartField(cutChart(mask, charts[i], kMargin), options);
  });

  DistanceField field{base::Image8(mask.width(), mask.height(), 1, 255), transitionScaleOf(options)};
  std::vector<std::pair<int, int>> claims(field.codes.pixels.size(), {0, 0}); // the best so far, of each texel
  for (const ChartField& chart : fields)
    for (int y = 0; y < chart.codes.height; ++y)
      for (int x = 0; x < chart.codes.width; ++x) {
        const int pageX = chart.texelX + x, pageY = chart.texelY + y;
        if (pageX < 0 || pageY < 0 || pageX >= mask.width() || pageY >= mask.height()) continue;
        std::pair<int, int>& best = claims[static_cast<std::size_t>(pageY) * mask.width() + pageX];
        const std::pair<int, int> claim = chart.claimOf(x, y);
        if (claim <= best) continue;
        best = claim;
        *field.codes.at(pageX, pageY) = *chart.codes.at(x, y);
      }
  return field;
}

DistanceFieldError measureDistanceField(const SunMask& mask, const DistanceField& field,
                                        const DistanceFieldOptions& options) {
  // Rows of a page in double, chart by chart in their order: the same for any number of threads.
  double inBand = 0, outside = 0, sharp = 0, shadow = 0, shown = 0;
  std::size_t band = 0, count = 0;
  const auto codeAt = [&](int x, int y) {
    return *field.codes.at(std::clamp(x, 0, field.codes.width - 1), std::clamp(y, 0, field.codes.height - 1)) / 255.0;
  };
  for (const MaskChart& chart : findCharts(mask)) {
    const ChartMask cut = cutChart(mask, chart, kMargin);
    const base::Image truth = blurMask(cut, options.penumbra);
    for (const MaskChart::Run& run : chart.runs)
      for (int x = run.x0; x < run.x1; ++x) {
        const BilinearTap u = bilinearTap(x, mask.factor), v = bilinearTap(run.y, mask.factor);
        const double upper = std::lerp(codeAt(u.lower, v.lower), codeAt(u.lower + 1, v.lower), u.upperWeight);
        const double lower = std::lerp(codeAt(u.lower, v.lower + 1), codeAt(u.lower + 1, v.lower + 1), u.upperWeight);
        const double visibility = decodeVisibility(std::lerp(upper, lower, v.upperWeight), field.transitionScale);
        const double expected = *truth.at(x - cut.texelX * mask.factor, run.y - cut.texelY * mask.factor);
        const double lit = *mask.sight.at(x, run.y) == kLit;
        const bool isBand = expected > 1e-6 && expected < 1 - 1e-6;
        (isBand ? inBand : outside) += std::abs(visibility - expected);
        if (isBand) sharp += std::abs(visibility - lit);
        band += isBand;
        ++count;
        shadow += 1 - lit;
        shown += 1 - visibility;
      }
  }
  const auto mean = [](double sum, std::size_t n) { return n > 0 ? sum / static_cast<double>(n) : 0; };
  DistanceFieldError error{mean(inBand, band), mean(outside, count - band), mean(sharp, band),
                           mean(static_cast<double>(band), count), 1};
  if (shadow > 0)
    error.shadowArea = shown / shadow;
  else if (shown > 0)
    error.shadowArea = std::numeric_limits<double>::infinity();
  return error;
}

} // namespace parity::bake
