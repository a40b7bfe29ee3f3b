#include "compare/images/flip_pair.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/images/flip_checks.h"
#include "compare/images/flip_files.h"
#include "compare/images/flip_judge.h"
#include "compare/images/flip_memory.h"
#include "compare/metrics/measure.h"
#include "compare/metrics/metrics.h"
#include "compare/pooling/region.h"

namespace parity::compare {

namespace {

struct Pictures {
  PlainImage reference, test;
};

Pictures readPictures(const FlipRequest& request, const FilePair& files) {
  Pictures pictures;
  PlainImageOptions options = request.image;
  options.keepBytes = request.range != DynamicRange::hdr; // which needs light
  base::parallelInvoke({[&] { pictures.reference = readPlainImage(files.reference, options); },
                        [&] { pictures.test = readPlainImage(files.test, options); }});
  if (pictures.reference.bytes.empty() || pictures.test.bytes.empty()) {
    spreadBytes(pictures.reference);
    spreadBytes(pictures.test);
  }
  return pictures;
}

std::string describeNonFinite(const PlainImage& image) {
  NonFinite bad = countNonFinite(image.color);
  const char* where = "";
  if (bad.count == 0 && !image.alpha.empty()) {
    bad = countNonFinite(image.alpha);
    where = " in alpha";
  }
  if (bad.count == 0) return "";
  return fmt::format("{}: x {}, y {}: {} pixel{} NaN or infinite{}", image.file, bad.x, bad.y, bad.count,
                     bad.count == 1 ? " is" : "s are", where);
}

// The worst of it is an error; where the user wants to go on, a note.
void checkFinite(const FlipRequest& request, const Pictures& pictures, FlipPair& result) {
  std::string found;
  for (const PlainImage* image : {&pictures.reference, &pictures.test}) {
    if (image->integer) continue; // shares of a maximum
    const std::string text = describeNonFinite(*image);
    if (text.empty()) continue;
    if (request.worstNonFinite) result.notes.push_back(text + "; counted as the worst error");
    found += (found.empty() ? "" : "; ") + text;
  }
  if (!found.empty() && !request.worstNonFinite) throw base::Error(base::ExitCode::failed, found, "", "");
}

float largestOf(const base::Image& image) {
  float largest = 0;
  for (const float v : image.pixels)
    if (std::isfinite(v)) largest = std::max(largest, v);
  return largest;
}

// By content: both have to be able to hold more than white, and one does.
void chooseRange(const FlipRequest& request, const Pictures& pictures, FlipPair& result) {
  if (request.range != DynamicRange::automatic) {
    result.hdr = request.range == DynamicRange::hdr;
    result.rangeReason = "as requested";
    return;
  }
  for (const PlainImage* image : {&pictures.reference, &pictures.test})
    if (image->integer || image->encoded) {
      const char* which = image == &pictures.reference ? "reference" : "test";
      result.rangeReason = image->integer ? fmt::format("the {} holds {}-bit integers", which, image->bits)
                                          : fmt::format("the {} is read as display-encoded", which);
      return;
    }
  const float largest = std::max(largestOf(pictures.reference.color), largestOf(pictures.test.color));
  result.hdr = largest > 1;
  result.rangeReason = result.hdr ? fmt::format("floats up to {:.4g}", largest) : "floats, none above 1";
}

void describe(const Pictures& pictures, FlipPair& result) {
  const auto space = [](const PlainImage& image) { return image.colorSpace + ", " + image.colorReason; };
  result.referenceSpace = space(pictures.reference);
  result.testSpace = space(pictures.test);
  const std::string own[] = {describeChannels(pictures.reference), describeChannels(pictures.test)};
  result.channels = own[0] == own[1] ? own[0] : own[0] + " against " + own[1];
  for (const PlainImage* image : {&pictures.reference, &pictures.test})
    for (const std::string& note : image->notes) {
      const std::string line = image->file + ": " + note;
      if (std::find(result.notes.begin(), result.notes.end(), line) == result.notes.end()) result.notes.push_back(line);
    }
}

const char* flipOf(bool hdr) { return hdr ? "hdrflip" : "flip"; }

// What is measured of the colours: asked for, needed by limits, needed by files.
MeasureRequest measureRequest(const FlipRequest& request, const FlipPair& result,
                              const std::vector<BudgetCheck>& checks) {
  MeasureRequest measure;
  measure.metrics = request.metrics.empty() ? defaultFlipMetrics(result.hdr) : request.metrics;
  for (const BudgetCheck& check : checks) measure.statistics.push_back(check.statistic.name);
  if (request.budgets)
    for (const std::string& name : requiredStatistics(*request.budgets)) measure.statistics.push_back(name);
  measure.options = request.metric;
  const std::string flip = flipOf(result.hdr);
  const FlipOutputs& files = request.outputs;
  const auto isFlip = [&](const std::string& name) { return name == flip || name.starts_with(flip + "."); };
  // Its map is pooled and written; where nobody asks for any of it, FLIP is not computed.
  if (!files.map.empty() || !files.histogram.empty() || (result.hdr && !files.exposureMap.empty()) ||
      std::ranges::any_of(measure.metrics, isFlip) || std::ranges::any_of(measure.statistics, isFlip))
    measure.keepMaps = {flip};
  return measure;
}

// A metric of linear light has no meaning where the pictures are displayed ones.
void requireApplicable(const MeasureRequest& measure, const FlipPair& result) {
  if (result.hdr) return;
  std::vector<std::string> metrics = measure.metrics;
  for (const std::string& name : measure.statistics) metrics.push_back(requireStatistic(name, "limit").metric);
  for (const std::string& name : metrics)
    if (requireMetric(name, "--metrics").needsLinear)
      throw base::Error(base::ExitCode::notComparable,
                        result.files.reference.string() + ", " + result.files.test.string(), name,
                        fmt::format("does not apply to an LDR pair ({}); --hdr compares it as linear light all the "
                                    "same",
                                    result.rangeReason));
}

// The bytes that values of k / 255 stand for; none where there are others.
std::optional<base::Image8> asBytes(const base::Image& image) {
  base::Image8 bytes(image.width, image.height, image.channels);
  std::atomic<bool> isExact = true;
  base::parallelFor(static_cast<std::size_t>(image.height), 64, [&](std::size_t begin, std::size_t end) {
    const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
    for (std::size_t i = begin * row; i < end * row; ++i) {
      const float scaled = 255 * image.pixels[i];
      // As far as rounding goes; NaN is none.
      const int whole = scaled > -1 && scaled < 256 ? static_cast<int>(scaled + 0.5f) : -1;
      if (whole < 0 || whole > 255 || !(std::abs(scaled - static_cast<float>(whole)) < 1e-4f)) {
        isExact = false;
        return;
      }
      bytes.pixels[i] = static_cast<std::uint8_t>(whole);
    }
  });
  return isExact ? std::optional(std::move(bytes)) : std::nullopt;
}

// Of 8-bit pictures the bytes are kept alone: pictures' colours are empty then.
Measurement measureColors(Pictures& pictures, const std::vector<base::PixelList>& regions,
                          const MeasureRequest& request, bool hdr) {
  if (!pictures.reference.bytes.empty())
    return measureRegions({pictures.reference.bytes, pictures.test.bytes}, regions, request);
  base::Image display[2], linear[2]; // only what is not at hand
  std::optional<base::Image8> bytes[2];
  PlainImage* const images[] = {&pictures.reference, &pictures.test};
  const base::Image* light[2];
  PixelView shown[2];
  for (int i = 0; i < 2; ++i) {
    PlainImage& image = *images[i];
    const bool isShown = image.encoded && image.integer; // floats may lie outside [0,1]
    if (!isShown) display[i] = toDisplay(image);
    shown[i] = isShown ? image.color : display[i];
    if (hdr && image.encoded) linear[i] = toLinear(image);
    light[i] = image.encoded ? &linear[i] : &image.color;
  }
  const auto hasBytes = [](const PlainImage* image) { return image->encoded && image->integer && image->bits <= 8; };
  if (!hdr && std::ranges::all_of(images, hasBytes))
    for (int i = 0; i < 2; ++i) bytes[i] = asBytes(images[i]->color);
  if (bytes[0] && bytes[1])
    for (int i = 0; i < 2; ++i) {
      images[i]->color = {};
      shown[i] = *bytes[i];
    }
  ImagePair pair{shown[0], shown[1]};
  if (hdr) pair.referenceLinear = light[0], pair.testLinear = light[1];
  return measureRegions(pair, regions, request);
}

base::Image spreadGrey(const base::Image& grey) {
  base::Image rgb(grey.width, grey.height, 3);
  for (std::size_t p = 0; p < grey.pixels.size(); ++p) std::fill_n(rgb.pixels.data() + 3 * p, 3, grey.pixels[p]);
  return rgb;
}

// Alpha as a grey picture, shown as it is stored: the metrics of displayed images say how far the two are apart.
std::vector<Figures> measureAlpha(const Pictures& pictures, const std::vector<base::PixelList>& regions,
                                  MeasureRequest request) {
  const base::Image reference = spreadGrey(pictures.reference.alpha), test = spreadGrey(pictures.test.alpha);
  for (std::string& name : request.metrics)
    if (name == "hdrflip") name = "flip";
  for (std::string& name : request.statistics) name = figureOfAlpha(name);
  request.keepMaps.clear();
  return measureRegions({reference, test}, regions, request).regions;
}

// HDR-FLIP's options have no part in an LDR pair, which may surprise.
void noteUnusedOptions(const FlipRequest& request, FlipPair& result) {
  if (!result.hdr && !request.outputs.exposureMap.empty())
    result.notes.emplace_back("no exposure map, because the pair is LDR");
  if (!result.hdr && !request.hdrOptions.empty())
    result.notes.push_back(
        fmt::format("{}: no effect on an LDR pair; --hdr compares it as HDR", fmt::join(request.hdrOptions, ", ")));
}

// Where a file of the pair could not be written, none of its rows may read as a pass.
void writeFiles(const FlipRequest& request, const FlipImages& images, FlipPair& result) {
  try {
    writeFlipFiles(request, images, result);
  } catch (const base::Error& error) {
    for (FlipRow& row : result.rows)
      if (row.verdict < Verdict::fail) row.verdict = Verdict::error, row.reason = error.what();
    throw;
  }
}

} // namespace

void compareFiles(const FlipRequest& request, FlipPair& result) {
  if (!result.files.missing.empty()) throw base::Error(base::ExitCode::failed, result.files.missing, "", "");
  requireFlipMemory(request, result.files);
  Pictures pictures = readPictures(request, result.files);
  requireComparable(pictures.reference, pictures.test, request.image);
  result.width = pictures.reference.width();
  result.height = pictures.reference.height();
  describe(pictures, result);
  checkFinite(request, pictures, result);
  chooseRange(request, pictures, result);
  noteUnusedOptions(request, result);
  const auto isZero = [](const auto& pixels) { return std::ranges::all_of(pixels, [](auto v) { return v == 0; }); };
  result.identical = pictures.reference.bytes == pictures.test.bytes &&
                     pictures.reference.color == pictures.test.color && pictures.reference.alpha == pictures.test.alpha;
  result.black = result.identical && isZero(pictures.test.bytes.pixels) && isZero(pictures.test.color.pixels);
  result.invisible = pictures.reference.invisible && pictures.test.invisible;
  result.partial = isPartial(pictures.reference, request.image) || isPartial(pictures.test, request.image);

  const MaskRegions regions = findRegions(request.mask, result.width, result.height);
  result.where = regions.where;
  result.notes.insert(result.notes.end(), regions.notes.begin(), regions.notes.end());
  const std::vector<BudgetCheck> checks = makeChecks(request.thresholds, result.hdr);
  MeasureRequest measure = measureRequest(request, result, checks);
  requireApplicable(measure, result);
  std::vector<const base::PixelList*> lists;
  for (const base::PixelList& region : regions.lists) lists.push_back(&region);
  const Rect box = boundsOf(lists, result.width, result.height);
  const bool whole = box == Rect{0, 0, result.width, result.height};
  if (!whole) measure.options.box = box;

  const Measurement colors = measureColors(pictures, regions.lists, measure, result.hdr);
  std::vector<Figures> figures = colors.regions;
  for (const std::string& note : colors.notes) result.notes.push_back(note);
  if (!pictures.reference.alpha.empty())
    for (Figures& region : measureAlpha(pictures, regions.lists, measure)) figures.push_back(std::move(region));
  pictures = {}; // the maps are large enough
  for (std::size_t i = 0; i < figures.size(); ++i) {
    FlipRow row;
    const bool isAlpha = i >= colors.regions.size();
    row.name = regions.lists[i % colors.regions.size()].name;
    if (isAlpha) row.name = row.name == "image" ? "alpha" : "alpha, " + row.name;
    row.figures = std::move(figures[i]);
    row.whole = request.mask.file.empty();
    judgeRow(row, request, isAlpha ? checksOfAlpha(checks) : checks, result.files.name);
    result.rows.push_back(std::move(row));
  }
  const std::string flip = flipOf(result.hdr);
  const base::Image* map = colors.findMap(flip);
  if (map && regions.where.empty()) result.pooling = poolMap(*map);
  settlePair(result);
  if (map) writeFiles(request, {*map, colors.findMap(flip, 1), regions.lists}, result);
}

} // namespace parity::compare
