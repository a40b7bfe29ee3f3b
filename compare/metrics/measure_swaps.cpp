#include "compare/metrics/measure_swaps.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>

#include "base/error.h"
#include "base/gathered.h"
#include "base/parallel.h"
#include "compare/metrics/measure_plan.h"
#include "compare/pooling/region.h"
#include "compare/pooling/region_list.h"

namespace parity::compare {
namespace {

// The pixels of a list, of the reference picture and of the swapped one, gathered.
class GatheredPair {
public:
  GatheredPair(const MetricInput& reference, const Swap& swap) {
    const std::vector<std::uint32_t>& pixels = swap.list->pixels;
    m_bytes = base::makeGathered<std::uint8_t>(pixels.size(), 3);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const std::uint32_t x = pixels[i] % static_cast<std::uint32_t>(reference.width()),
                          y = pixels[i] / static_cast<std::uint32_t>(reference.width());
      std::copy_n(reference.reference.bytes + static_cast<std::ptrdiff_t>(y) * reference.reference.stride + 3 * x, 3,
                  &m_bytes.pixels[3 * i]);
    }
    if (reference.referenceLinear) {
      m_linear = base::makeGathered<float>(pixels.size(), 3);
      for (std::size_t i = 0; i < pixels.size(); ++i)
        std::copy_n(&reference.referenceLinear->pixels[3 * std::size_t{pixels[i]}], 3, &m_linear.pixels[3 * i]);
    }
    m_places = {swap.list->name, std::vector<std::uint32_t>(pixels.size()), swap.list->weights};
    std::iota(m_places.pixels.begin(), m_places.pixels.end(), 0u);
    m_invalid = swap.nonFinite;
    for (std::size_t i = 0, n = 0; i < pixels.size() && n < reference.nonFinite.size();)
      if (pixels[i] == reference.nonFinite[n])
        m_invalid.push_back(static_cast<std::uint32_t>(i++));
      else
        pixels[i] < reference.nonFinite[n] ? ++i : ++n;
    m_input.emplace(ImagePair{m_bytes, swap.displayed, m_linear.empty() ? nullptr : &m_linear,
                              m_linear.empty() ? nullptr : &swap.linear, m_invalid});
    m_runs = runsOf(m_places, m_bytes.width, m_bytes.height);
  }
  GatheredPair(const GatheredPair&) = delete;
  GatheredPair& operator=(const GatheredPair&) = delete;

  const MetricInput& input() const { return *m_input; }
  const RegionRuns& region() const { return m_runs; }
  Rect box() const { return {0, 0, m_bytes.width, m_bytes.height}; }

private:
  base::Image8 m_bytes;
  base::Image m_linear;
  base::PixelList m_places;
  std::vector<std::uint32_t> m_invalid;
  std::optional<MetricInput> m_input;
  RegionRuns m_runs;
};

// Values of a metric whose windows see around the pixels: in the part of the pictures that they reach.
std::vector<double> measureInWindow(const Metric& metric, const MetricInput& reference, const Swap& swap,
                                    const GatheredPair& gathered, const MeasureRequest& request,
                                    std::span<const Statistic> wanted) {
  const base::PixelList* lists[] = {swap.list};
  const int margin = metric.reach == kReachesAll ? std::max(reference.width(), reference.height()) : metric.reach;
  const Rect part = boundsOf(lists, reference.width(), reference.height(), margin);
  base::Image8 images[2] = {base::Image8(part.width, part.height, 3), {}};
  for (int y = 0; y < part.height; ++y)
    std::copy_n(reference.reference.bytes + (part.y + y) * reference.reference.stride + 3 * part.x, 3 * part.width,
                images[0].at(0, y));
  images[1] = images[0];
  const auto placeIn = [&](std::uint32_t pixel) {
    const int x = static_cast<int>(pixel) % reference.width() - part.x,
              y = static_cast<int>(pixel) / reference.width() - part.y;
    return static_cast<std::uint32_t>(y * part.width + x);
  };
  base::PixelList list{swap.list->name, swap.list->pixels, swap.list->weights};
  for (std::size_t i = 0; i < list.pixels.size(); ++i) {
    list.pixels[i] = placeIn(list.pixels[i]);
    std::copy_n(&swap.displayed.pixels[3 * i], 3, &images[1].pixels[3 * std::size_t{list.pixels[i]}]);
  }
  std::vector<std::uint32_t> invalid;
  for (const std::uint32_t place : gathered.input().nonFinite) invalid.push_back(list.pixels[place]);
  const MetricInput input({images[0], images[1], nullptr, nullptr, invalid});
  MetricOptions options = request.options;
  const base::PixelList* moved[] = {&list};
  options.box = boundsOf(moved, part.width, part.height);
  return metric.pool(metric.makeMaps(input, options), runsOf(list, part.width, part.height), wanted);
}

} // namespace

SwapMeasurement measureSwaps(const SwapReference& reference, std::span<const Swap> swaps,
                             const MeasureRequest& request) {
  const std::vector<MeasurePlan> plans = makeMeasurePlans(request, reference.linear != nullptr);
  const MetricInput base(
      {reference.displayed, reference.displayed, reference.linear, reference.linear, reference.nonFinite});
  if (!base.reference.bytes)
    throw base::Error(base::ExitCode::notComparable, "swapped pictures", "", "need displayed images of 8 bits");
  for (const Swap& swap : swaps) requireWellFormed(*swap.list, base.pixelCount());
  SwapMeasurement out;
  out.figures.resize(swaps.size());
  std::vector<std::unique_ptr<GatheredPair>> gathered(swaps.size());
  base::parallelFor(swaps.size(), 1, [&](std::size_t s, std::size_t) {
    if (!swaps[s].list->pixels.empty()) gathered[s] = std::make_unique<GatheredPair>(base, swaps[s]);
  });

  // Metrics that share work among swaps come first, for all swaps at once.
  std::vector<SwapPixels> pixels;
  for (std::size_t s = 0; s < swaps.size(); ++s)
    pixels.push_back({swaps[s].list->pixels, gathered[s] ? &gathered[s]->input() : nullptr});
  std::vector<std::vector<std::vector<float>>> shared(plans.size());
  for (std::size_t p = 0; p < plans.size(); ++p)
    if (plans[p].metric->makeSwapMaps) shared[p] = plans[p].metric->makeSwapMaps(base, pixels, request.options);

  base::parallelFor(swaps.size(), 1, [&](std::size_t s, std::size_t) {
    if (!gathered[s] || gathered[s]->region().pixels == 0) return;
    const GatheredPair& pair = *gathered[s];
    Figures& figures = out.figures[s];
    MetricOptions options = request.options;
    options.box.reset();
    const MeanRows* const light = &lightRows();
    const std::span<const RegionRuns> region(&pair.region(), 1);
    fillLight(pair.input(), region, meansOf({&light, 1}, pair.input(), region), {&figures, 1});
    MetricMaps maps;
    std::string mapsName;
    for (std::size_t p = 0; p < plans.size(); ++p) {
      const MeasurePlan& plan = plans[p];
      if (plan.statistics.empty()) continue;
      std::vector<double> values;
      if (plan.metric->makeSwapMaps) {
        MetricMaps own;
        base::Image& plane = own.planes.emplace_back(base::makeGathered<float>(shared[p][s].size(), 1));
        std::ranges::copy(shared[p][s], plane.pixels.begin());
        values = plan.metric->pool(own, pair.region(), plan.statistics);
      } else if (plan.metric->reach != 0) {
        values = measureInWindow(*plan.metric, base, swaps[s], pair, request, plan.statistics);
      } else {
        if (mapsName.empty() || mapsName != plan.metric->mapsName) maps = plan.metric->makeMaps(pair.input(), options);
        mapsName = plan.metric->mapsName;
        values = plan.metric->pool(maps, pair.region(), plan.statistics);
      }
      for (std::size_t i = 0; i < values.size(); ++i) figures.values.push_back({plan.statistics[i].name, values[i]});
    }
  });
  for (std::size_t p = 0; p < plans.size(); ++p)
    if (plans[p].keepMap && plans[p].metric->name == "flip") out.flip = std::move(shared[p]);
  return out;
}

} // namespace parity::compare
