// Work is confined to the box that the materials' regions need and the filters' reach around it.
#include "compare/attribution.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/flip.h"
#include "compare/pooling.h"
#include "compare/region.h"
#include "shading/terms.h"

namespace parity::compare {
namespace {

void requireFitting(const AttributionInput& input) {
  const auto refuse = [](const char* reason) {
    return base::Error(base::ExitCode::notComparable, "attribution", "", reason);
  };
  if (input.referenceTerms.size() != shading::kTermCount || input.testTerms.size() != shading::kTermCount)
    throw refuse("both paths' terms are needed");
  const auto require = [&](const auto& image) {
    if (image.width != input.testColor.width || image.height != input.testColor.height || image.channels != 3)
      throw refuse("the pictures are not of one size");
  };
  require(input.reference);
  require(input.test);
  for (const auto* terms : {&input.referenceTerms, &input.testTerms})
    for (const base::Image& term : *terms) require(term);
}

bool differsOn(const base::PixelList& list, const base::Image& a, const base::Image& b) {
  return std::ranges::any_of(list.pixels, [&](std::uint32_t p) {
    const float *x = &a.pixels[3 * std::size_t{p}], *y = &b.pixels[3 * std::size_t{p}];
    return x[0] != y[0] || x[1] != y[1] || x[2] != y[2];
  });
}

// Part of the view's pictures.
struct Crop {
  Rect box;
  int width = 0; // of the view

  bool holds(std::uint32_t pixel) const {
    const int x = static_cast<int>(pixel) % width - box.x, y = static_cast<int>(pixel) / width - box.y;
    return x >= 0 && x < box.width && y >= 0 && y < box.height;
  }
  std::uint32_t placeOf(std::uint32_t pixel) const { // of one that it holds
    const int x = static_cast<int>(pixel) % width - box.x, y = static_cast<int>(pixel) / width - box.y;
    return static_cast<std::uint32_t>(y * box.width + x);
  }
  PixelView of(const base::Image8& image) const {
    PixelView view(image);
    view.bytes = image.at(box.x, box.y);
    view.width = box.width;
    view.height = box.height;
    return view;
  }
};

// Mobile's colour with the high-end path's term at a value of the picture. In double: a term may be all of the colour.
float swapValue(const AttributionInput& input, std::size_t term, std::size_t i) {
  const double color = input.testColor.pixels[i], other = input.referenceTerms[term].pixels[i];
  if (std::isfinite(color)) return static_cast<float>(color - input.testTerms[term].pixels[i] + other);
  double sum = other;
  for (std::size_t t = 0; t < shading::kTermCount; ++t)
    if (t != term) sum += input.testTerms[t].pixels[i];
  return static_cast<float>(sum);
}

base::Image swapTerm(const AttributionInput& input, std::size_t term, const Crop& crop) {
  base::Image swapped(crop.box.width, crop.box.height, 3);
  for (int y = 0; y < crop.box.height; ++y) {
    const std::size_t first =
        3 * (static_cast<std::size_t>(crop.box.y + y) * crop.width + static_cast<std::size_t>(crop.box.x));
    float* out = swapped.at(0, y);
    for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(crop.box.width); ++i)
      out[i] = swapValue(input, term, first + i);
  }
  return swapped;
}

// What is pooled for a material, in places of the crop.
struct Subject {
  std::size_t material = 0;
  base::PixelList region;
  RegionRuns runs; // refers to the region's weights
  Attribution result;
};

// The regions of all materials that have pixels, in places of the view.
std::vector<Subject> makeSubjects(std::span<const base::PixelList* const> materials, int width, int height,
                                  int radius) {
  std::vector<Subject> all(materials.size());
  base::parallelFor(materials.size(), 1, [&](std::size_t m, std::size_t) {
    Subject& subject = all[m];
    subject.material = m;
    subject.region = erode(*materials[m], width, height, radius);
    subject.result.region = "interior";
    if (!subject.region.pixels.empty()) return;
    subject.region = *materials[m];
    subject.result.region = "all";
  });
  std::erase_if(all, [&](const Subject& s) { return runsOf(s.region, width, height).pixels == 0; });
  return all;
}

Crop moveToCrop(std::vector<Subject>& subjects, int width, int height, int radius) {
  std::vector<const base::PixelList*> lists;
  for (const Subject& subject : subjects) lists.push_back(&subject.region);
  const Crop crop{boundsOf(lists, width, height, radius), width};
  base::parallelFor(subjects.size(), 1, [&](std::size_t i, std::size_t) {
    Subject& subject = subjects[i];
    for (std::uint32_t& pixel : subject.region.pixels) pixel = crop.placeOf(pixel);
    subject.runs = runsOf(subject.region, crop.box.width, crop.box.height);
  });
  return crop;
}

} // namespace

std::vector<std::optional<Attribution>> attributeTerms(const AttributionInput& input,
                                                       std::span<const base::PixelList* const> materials,
                                                       const ShowFunction& show) {
  requireFitting(input);
  std::vector<std::optional<Attribution>> results(materials.size());
  const int width = input.testColor.width, height = input.testColor.height, radius = flipFilterRadius({});
  std::vector<Subject> subjects = makeSubjects(materials, width, height, radius);
  if (subjects.empty()) return results;
  const Crop crop = moveToCrop(subjects, width, height, radius);
  const auto placesOf = [&](std::span<const std::uint32_t> pixels) {
    std::vector<std::uint32_t> places;
    for (const std::uint32_t pixel : pixels)
      if (crop.holds(pixel)) places.push_back(crop.placeOf(pixel));
    return places;
  };
  const std::vector<std::uint32_t> referenceNonFinite = placesOf(input.referenceNonFinite);

  // Mean FLIP over each subject.
  const auto compare = [&](const PixelView& test, const std::vector<std::uint32_t>& testNonFinite) {
    base::Image map = flipMap(crop.of(input.reference), test);
    for (const auto* pixels : {&referenceNonFinite, &testNonFinite})
      for (const std::uint32_t pixel : *pixels) map.pixels[pixel] = 1; // FLIP's worst
    std::vector<double> means(subjects.size());
    base::parallelFor(means.size(), 1, [&](std::size_t i, std::size_t) { means[i] = meanOf(map, subjects[i].runs); });
    return means;
  };
  // Task 0 is mobile as it is, the others are the terms.
  std::vector<std::vector<double>> means(1 + shading::kTermCount);
  std::vector<std::vector<char>> differs(shading::kTermCount, std::vector<char>(subjects.size(), 0));
  base::parallelFor(means.size(), 1, [&](std::size_t task, std::size_t) {
    if (task == 0) {
      means[0] = compare(crop.of(input.test), placesOf(input.testNonFinite));
      return;
    }
    const std::size_t term = task - 1;
    for (std::size_t i = 0; i < subjects.size(); ++i)
      differs[term][i] =
          differsOn(*materials[subjects[i].material], input.referenceTerms[term], input.testTerms[term]) ? 1 : 0;
    if (std::ranges::find(differs[term], 1) == differs[term].end()) return;
    const ShownPicture shown = show(swapTerm(input, term, crop), crop.box);
    means[task] = compare(shown.pixels, shown.nonFinite);
  });
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    Attribution& result = subjects[i].result;
    result.flip = means[0][i];
    for (std::size_t term = 0; term < shading::kTermCount; ++term)
      if (differs[term][i] == 1) result.terms.push_back({std::string(shading::kTermNames[term]), means[1 + term][i]});
    results[subjects[i].material] = std::move(result);
  }
  return results;
}

} // namespace parity::compare
