#include "job/flip_pair.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/flip_hdr.h"
#include "compare/measure.h"
#include "compare/metrics.h"
#include "compare/region.h"
#include "compare/wording.h"
#include "job/flip_files.h"

namespace parity::job {

namespace {

using compare::Verdict;

struct Pictures {
  PlainImage reference, test;
};

Pictures readPictures(const FlipRequest& request, const FilePair& files) {
  Pictures pictures;
  base::parallelInvoke({[&] { pictures.reference = readPlainImage(files.reference, request.image); },
                        [&] { pictures.test = readPlainImage(files.test, request.image); }});
  return pictures;
}

std::string describeNonFinite(const PlainImage& image) {
  compare::NonFinite bad = compare::countNonFinite(image.color);
  const char* where = "";
  if (bad.count == 0 && !image.alpha.empty()) {
    bad = compare::countNonFinite(image.alpha);
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
    result.rangeReason = "as asked for";
    return;
  }
  for (const PlainImage* image : {&pictures.reference, &pictures.test})
    if (image->integer || image->encoded) {
      const char* which = image == &pictures.reference ? "reference" : "test";
      result.rangeReason = image->integer ? fmt::format("the {} holds {}-bit integers", which, image->bits)
                                          : fmt::format("the {} is taken for display-encoded", which);
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
compare::MeasureRequest measureRequest(const FlipRequest& request, const FlipPair& result,
                                       const std::vector<compare::BudgetCheck>& checks) {
  compare::MeasureRequest measure;
  measure.metrics = request.metrics.empty() ? defaultFlipMetrics(result.hdr) : request.metrics;
  for (const compare::BudgetCheck& check : checks) measure.statistics.push_back(check.statistic.name);
  if (request.budgets)
    for (const std::string& name : compare::requiredStatistics(*request.budgets)) measure.statistics.push_back(name);
  measure.options = request.metric;
  measure.keepMaps = {flipOf(result.hdr)};
  return measure;
}

// A metric of linear light has no meaning where the pictures are displayed ones.
void requireApplicable(const compare::MeasureRequest& measure, const FlipPair& result) {
  if (result.hdr) return;
  std::vector<std::string> metrics = measure.metrics;
  for (const std::string& name : measure.statistics) metrics.push_back(compare::requireStatistic(name, "limit").metric);
  for (const std::string& name : metrics)
    if (compare::requireMetric(name, "--metrics").needsLinear)
      throw base::Error(base::ExitCode::notComparable, result.files.test.string(), name,
                        fmt::format("does not apply to an LDR pair ({}); --hdr compares it as linear light all the "
                                    "same",
                                    result.rangeReason));
}

compare::Measurement measureColors(const Pictures& pictures, const std::vector<base::PixelList>& regions,
                                   const compare::MeasureRequest& request, bool hdr) {
  base::Image display[2], linear[2]; // only what is not at hand
  const PlainImage* const images[] = {&pictures.reference, &pictures.test};
  const base::Image *shown[2], *light[2];
  for (int i = 0; i < 2; ++i) {
    const PlainImage& image = *images[i];
    const bool isShown = image.encoded && image.integer; // floats may lie outside [0,1]
    if (!isShown) display[i] = toDisplay(image);
    shown[i] = isShown ? &image.color : &display[i];
    if (hdr && image.encoded) linear[i] = toLinear(image);
    light[i] = image.encoded ? &linear[i] : &image.color;
  }
  compare::ImagePair pair{*shown[0], *shown[1]};
  if (hdr) pair.referenceLinear = light[0], pair.testLinear = light[1];
  return compare::measureRegions(pair, regions, request);
}

// The metric keeps no more than its map, so the rare wish for this one costs a second pass.
base::Image makeExposureMap(const Pictures& pictures, const compare::MetricOptions& options) {
  compare::HdrFlipOptions hdr = options.hdr;
  hdr.ppd = options.ppd;
  hdr.region = options.box;
  const base::Image linear[] = {toLinear(pictures.reference), toLinear(pictures.test)};
  const compare::ImagePair pair{linear[0], linear[1]};
  const compare::MetricInput input(pair); // numbers in place of NaN
  return compare::flipHdr(input.reference, input.test, hdr).exposure;
}

base::Image spreadGrey(const base::Image& grey) {
  base::Image rgb(grey.width, grey.height, 3);
  for (std::size_t p = 0; p < grey.pixels.size(); ++p) std::fill_n(rgb.pixels.data() + 3 * p, 3, grey.pixels[p]);
  return rgb;
}

// Alpha as a grey picture, shown as it is stored: the metrics of displayed images say how far the two are apart.
std::vector<compare::RegionFigures> measureAlpha(const Pictures& pictures, const std::vector<base::PixelList>& regions,
                                                 compare::MeasureRequest request) {
  const base::Image reference = spreadGrey(pictures.reference.alpha), test = spreadGrey(pictures.test.alpha);
  const auto needsLinear = [](const std::string& name) { return compare::requireMetric(name, "metric").needsLinear; };
  std::erase_if(request.metrics, needsLinear);
  std::erase_if(request.statistics,
                [&](const std::string& name) { return needsLinear(compare::requireStatistic(name, "limit").metric); });
  request.metrics.push_back("flip");
  request.keepMaps.clear();
  auto figures = compare::measureRegions({reference, test}, regions, request).regions;
  for (compare::RegionFigures& region : figures)
    region.name = region.name == "image" ? "alpha" : "alpha, " + region.name;
  return figures;
}

void judgeRow(FlipRow& row, const FlipRequest& request, const std::vector<compare::BudgetCheck>& checks,
              const FlipPair& pair) {
  compare::BudgetRule limits;
  const bool alpha = row.figures.name.starts_with("alpha");
  for (const compare::BudgetCheck& check : checks)
    if (!alpha || row.figures.all.find(check.statistic.name)) limits.checks.push_back(check);
  row.checks = compare::runChecks(limits, row.figures);
  if (request.budgets) {
    // A region is to its pair what a material is to its scene; a whole image is one to both.
    const bool whole = row.figures.name == "image" || row.figures.name == "alpha";
    const compare::BudgetRule* rule =
        whole ? compare::findWholeRule(*request.budgets, pair.files.name)
              : compare::findMaterialRule(*request.budgets, pair.files.name, row.figures.name);
    if (!rule) throw base::Error(base::ExitCode::failed, "budgets", row.figures.name, "no rule judges it");
    for (compare::CheckResult& check : compare::runChecks(*rule, row.figures)) row.checks.push_back(std::move(check));
    row.rule = {rule->origin, rule->reason, rule->owner, rule->requireSeen, rule->file, rule->line};
  }
  for (const compare::CheckResult& check : row.checks)
    if (check.verdict > row.verdict) {
      row.verdict = check.verdict;
      row.reason = compare::describeCheck(check);
    }
  if (row.figures.all.nonFinite > 0 && row.verdict < Verdict::fail) {
    row.verdict = Verdict::fail;
    row.reason = fmt::format("{} pixel{} NaN or infinite", row.figures.all.nonFinite,
                             row.figures.all.nonFinite == 1 ? " is" : "s are");
  }
}

} // namespace

void compareFiles(const FlipRequest& request, FlipPair& result) {
  if (!result.files.missing.empty()) {
    const auto& present = result.files.reference.empty() ? result.files.test : result.files.reference;
    throw base::fileError(present.string(), "", result.files.missing);
  }
  Pictures pictures = readPictures(request, result.files);
  requireComparable(pictures.reference, pictures.test, request.image.alpha);
  result.width = pictures.reference.color.width;
  result.height = pictures.reference.color.height;
  describe(pictures, result);
  checkFinite(request, pictures, result);
  chooseRange(request, pictures, result);
  const auto isZero = [](float v) { return v == 0; };
  result.identical = pictures.reference.color == pictures.test.color && pictures.reference.alpha == pictures.test.alpha;
  result.black =
      result.identical && std::all_of(pictures.test.color.pixels.begin(), pictures.test.color.pixels.end(), isZero);

  const std::vector<base::PixelList> regions = findRegions(request.mask, result.width, result.height);
  const std::vector<compare::BudgetCheck> checks = makeChecks(request.thresholds, result.hdr);
  compare::MeasureRequest measure = measureRequest(request, result, checks);
  requireApplicable(measure, result);
  std::vector<const base::PixelList*> lists;
  for (const base::PixelList& region : regions) lists.push_back(&region);
  const compare::Rect box = compare::boundsOf(lists, result.width, result.height);
  const bool whole = box == compare::Rect{0, 0, result.width, result.height};
  if (!whole) measure.options.box = box;

  const compare::Measurement colors = measureColors(pictures, regions, measure, result.hdr);
  std::vector<compare::RegionFigures> figures = colors.regions;
  for (const std::string& note : colors.notes) result.notes.push_back(note);
  if (!pictures.reference.alpha.empty())
    for (compare::RegionFigures& region : measureAlpha(pictures, regions, measure))
      figures.push_back(std::move(region));
  base::Image exposure;
  if (result.hdr && !request.outputs.exposureMap.empty()) exposure = makeExposureMap(pictures, measure.options);
  pictures = {}; // the maps are large enough
  for (compare::RegionFigures& region : figures) {
    FlipRow row;
    row.figures = std::move(region);
    judgeRow(row, request, checks, result);
    result.rows.push_back(std::move(row));
  }
  const base::Image* map = colors.findMap(flipOf(result.hdr));
  if (regions.size() == 1 && regions[0].name == "image") result.pooling = compare::poolMap(*map);
  for (const FlipRow& row : result.rows)
    if (row.verdict > result.verdict) {
      result.verdict = row.verdict;
      result.reason = result.rows.size() > 1 ? row.figures.name + ": " + row.reason : row.reason;
    }
  writeFlipFiles(request, {*map, exposure.empty() ? nullptr : &exposure, regions}, result);
}

} // namespace parity::job
