#include "job/view/truth_comparison.h"

#include <array>

#include <fmt/format.h>

#include "base/parallel.h"
#include "compare/metrics/measure_truth.h"
#include "job/view/material_swaps.h"

namespace parity::job {

namespace {

// One path's colour or term, made ready to be measured.
struct Prepared {
  Displayed displayed;
  base::Image exposed; // empty: the frame is
  compare::TruthPicture picture;

  Prepared(const base::Image& linear, Displayed shown, float exposureEv) : displayed(std::move(shown)) {
    if (exposureEv != 0) exposed = expose(linear, exposureEv);
    picture = {displayed.pixels, exposureEv != 0 ? &exposed : &linear, displayed.nonFinite};
  }
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;
};

// What the truth is compared with.
struct Tested {
  const PathFrames &reference, &test;
  const ViewFrames& frames;
  const TruthRequest& request;
};

// The materials' swapped pictures: of the truth's, by each path. finished: of colours, whose pictures are displayed.
std::vector<compare::TruthSwap> swapsOf(Context& context, const Tested& tested,
                                        std::vector<gpu::SwappedPixels> PathFrames::*swaps, std::size_t plane,
                                        bool finished) {
  const TruthRequest& request = tested.request;
  std::vector<compare::TruthSwap> all(request.materials.size());
  base::parallelFor(all.size(), 1, [&](std::size_t i, std::size_t) {
    const base::PixelList& list = *request.materials[i];
    const auto material = static_cast<std::size_t>(&list - tested.frames.coverage.data());
    const auto swapOf = [&](const PathFrames& path, const Displayed& displayed) {
      return displaySwap(context, list, (path.*swaps)[material], plane, request.exposureEv,
                         finished ? &displayed : nullptr);
    };
    all[i] = {swapOf(tested.reference, request.reference), swapOf(tested.test, request.test)};
  });
  return all;
}

// Adds the term to the whole image and to every material where it is not black in all three.
void addTerm(TruthComparison& comparison, Context& context, const Tested& tested, std::size_t term) {
  const TruthRequest& request = tested.request;
  const std::array<const base::Image*, 3> images = {
      &tested.frames.truth.terms[term], &tested.reference.frame.terms[term], &tested.test.frame.terms[term]};
  const auto isUnseen = [&](const base::PixelList& list) {
    return compare::isBlack(*images[0], list) && compare::isBlack(*images[1], list) &&
           compare::isBlack(*images[2], list);
  };
  if (isUnseen(request.whole)) return; // it holds all the others
  const auto prepare = [&](const base::Image& linear) {
    return Prepared(linear, displayImage(linear, context.display(), request.exposureEv), request.exposureEv);
  };
  const auto add = [&](compare::Truth& truth, const base::PixelList& list, compare::TruthTerm measured) {
    if (isUnseen(list)) return;
    measured.truth = compare::meanLuminance(*images[0], list);
    measured.reference = compare::meanLuminance(*images[1], list);
    measured.test = compare::meanLuminance(*images[2], list);
    truth.terms.push_back(std::move(measured));
  };
  const std::string name(shading::kTermNames[term]);
  const Prepared truth = prepare(*images[0]), reference = prepare(*images[1]), test = prepare(*images[2]);
  add(comparison.whole, request.whole,
      compare::measureTerm(name, {truth.picture, reference.picture, test.picture}, request.whole, request.box));
  std::vector<compare::TruthTerm> measured =
      compare::measureTermSwaps(name, truth.picture, swapsOf(context, tested, &PathFrames::truthTermSwap, term, false));
  for (std::size_t i = 0; i < measured.size(); ++i)
    add(comparison.materials[i], *request.materials[i], std::move(measured[i]));
}

} // namespace

TruthComparison compareWithTruth(Context& context, const ViewFrames& frames, const PathFrames& reference,
                                 const PathFrames& test, const TruthRequest& request) {
  const base::Stopwatch watch(&context.timings(), "compare with the truth");
  const float exposureEv = request.exposureEv;
  const Tested tested{reference, test, frames, request};
  const Prepared truth(frames.truth.color, displayImage(frames.truth.color, context.display(), exposureEv), exposureEv);
  const Prepared referencePicture(tested.reference.frame.color, request.reference, exposureEv);
  const Prepared testPicture(tested.test.frame.color, request.test, exposureEv);
  const compare::TruthMeasureRequest measure{.box = request.box,
                                             .keepMaps = request.pictures,
                                             .wantedError = request.wantedError,
                                             .reference = request.referenceTitle,
                                             .test = request.testTitle};
  const compare::TruthErrorMaps maps{&frames.truthError, &frames.truthTaken};
  compare::TruthMeasurement measured = compare::measureTruth(
      {truth.picture, referencePicture.picture, testPicture.picture}, maps, request.whole, measure);
  TruthComparison comparison{truth.displayed, std::move(measured.truth),
                             compare::measureTruthSwaps(truth.picture, maps,
                                                        swapsOf(context, tested, &PathFrames::truthSwap, 0, true),
                                                        measure),
                             std::move(measured.referenceFlip), std::move(measured.testFlip)};
  const bool hasTerms = !reference.frame.terms.empty() && !test.frame.terms.empty();
  for (std::size_t term = 0; hasTerms && term < frames.truth.terms.size(); ++term)
    addTerm(comparison, context, tested, term);
  return comparison;
}

} // namespace parity::job
