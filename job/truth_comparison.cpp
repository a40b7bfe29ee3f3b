#include "job/truth_comparison.h"

#include <array>

#include <fmt/format.h>

#include "base/parallel.h"
#include "compare/measure_truth.h"
#include "job/material_swaps.h"

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

// The materials' swapped pictures: of the truth's, by each path.
std::vector<compare::TruthSwap> swapsOf(Context& context, const ViewFrames& frames, const TruthRequest& request,
                                        const std::vector<gpu::SwappedPixels>& highend,
                                        const std::vector<gpu::SwappedPixels>& mobile, std::size_t plane,
                                        bool finished) {
  std::vector<compare::TruthSwap> swaps(request.materials.size());
  base::parallelFor(swaps.size(), 1, [&](std::size_t i, std::size_t) {
    const base::PixelList& list = *request.materials[i];
    const auto material = static_cast<std::size_t>(&list - frames.coverage.data());
    swaps[i] = {
        displaySwap(context, list, highend[material], plane, request.exposureEv, finished ? &request.highend : nullptr),
        displaySwap(context, list, mobile[material], plane, request.exposureEv, finished ? &request.mobile : nullptr)};
  });
  return swaps;
}

// Adds the term to the whole image and to every material where it is not black in all three.
void addTerm(TruthComparison& comparison, Context& context, const ViewFrames& frames, std::size_t term,
             const TruthRequest& request) {
  const std::array<const base::Image*, 3> images = {&frames.reference.terms[term], &frames.highend.terms[term],
                                                    &frames.mobile.terms[term]};
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
    measured.highend = compare::meanLuminance(*images[1], list);
    measured.mobile = compare::meanLuminance(*images[2], list);
    truth.terms.push_back(std::move(measured));
  };
  const std::string name(shading::kTermNames[term]);
  const Prepared truth = prepare(*images[0]), highend = prepare(*images[1]), mobile = prepare(*images[2]);
  add(comparison.whole, request.whole,
      compare::measureTerm(name, {truth.picture, highend.picture, mobile.picture}, request.whole, request.box));
  std::vector<compare::TruthTerm> measured = compare::measureTermSwaps(
      name, truth.picture,
      swapsOf(context, frames, request, frames.truthHighendTerms, frames.truthMobileTerms, term, false));
  for (std::size_t i = 0; i < measured.size(); ++i)
    add(comparison.materials[i], *request.materials[i], std::move(measured[i]));
}

} // namespace

TruthComparison compareWithTruth(Context& context, const ViewFrames& frames, const TruthRequest& request) {
  const base::Stopwatch watch(&context.timings(), "compare with the truth");
  const float exposureEv = request.exposureEv;
  const Prepared truth(frames.reference.color, displayImage(frames.reference.color, context.display(), exposureEv),
                       exposureEv);
  const Prepared highend(frames.highend.color, request.highend, exposureEv);
  const Prepared mobile(frames.mobile.color, request.mobile, exposureEv);
  const compare::TruthMeasureRequest measure{.box = request.box,
                                             .keepMaps = request.pictures,
                                             .wantedError = context.settings().reference.integral.relativeError};
  const compare::TruthErrorMaps maps{&frames.referenceError, &frames.referenceTaken};
  compare::TruthMeasurement measured =
      compare::measureTruth({truth.picture, highend.picture, mobile.picture}, maps, request.whole, measure);
  TruthComparison comparison{
      truth.displayed, std::move(measured.truth),
      compare::measureTruthSwaps(truth.picture, maps,
                                 swapsOf(context, frames, request, frames.truthHighend, frames.truthMobile, 0, true),
                                 measure.wantedError),
      std::move(measured.highendFlip), std::move(measured.mobileFlip)};
  for (std::size_t term = 0; term < shading::kTermCount; ++term) addTerm(comparison, context, frames, term, request);
  return comparison;
}

std::string describeTruth(const Settings& settings) {
  const reference::Options& options = settings.reference;
  const reference::Model& model = options.model;
  const bool multiple = model.scattering == reference::Scattering::multiple;
  const bool correlated = model.geometryTerm == reference::GeometryTerm::heightCorrelated;
  return fmt::format(
      "exact integrals, {} scattering between microfacets{}, {}, {} Fresnel curve, {} diffuse lobe{}{}, to "
      "a standard error of {:.3g} %",
      multiple ? "multiple" : "single", multiple ? " (Kulla-Conty)" : "",
      correlated ? "height-correlated Smith" : "Schlick-Smith",
      highend::fresnelNames()[static_cast<std::size_t>(model.fresnel)],
      highend::diffuseNames()[static_cast<std::size_t>(model.diffuse)],
      settings.shadows || options.bounces > 0 ? ", with shadows" : "",
      options.bounces > 0
          ? fmt::format(", {} bounce{} between surfaces", options.bounces, options.bounces > 1 ? "s" : "")
          : "",
      100 * options.integral.relativeError);
}

} // namespace parity::job
