#include "job/truth_comparison.h"

#include <array>

#include <fmt/format.h>

#include "compare/measure_truth.h"

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

// The term of every region that is not black in all three, behind those that the regions have.
void addTerm(std::vector<compare::Truth>& regions, Context& context, const ViewFrames& frames, std::size_t term,
             const TruthRequest& request, const compare::TruthMeasureRequest& measure) {
  const std::array<const base::Image*, 3> images = {&frames.reference.terms[term], &frames.highend.terms[term],
                                                    &frames.mobile.terms[term]};
  const auto isUnseen = [&](const base::PixelList& list) {
    return compare::isBlack(*images[0], list) && compare::isBlack(*images[1], list) &&
           compare::isBlack(*images[2], list);
  };
  if (isUnseen(request.lists.front())) return; // it holds all the others
  const auto prepare = [&](const base::Image& linear) {
    return Prepared(linear, displayImage(linear, context.display(), request.exposureEv), request.exposureEv);
  };
  const Prepared truth = prepare(*images[0]), highend = prepare(*images[1]), mobile = prepare(*images[2]);
  std::vector<compare::TruthTerm> measured = compare::measureTerm(
      std::string(shading::kTermNames[term]), {truth.picture, highend.picture, mobile.picture}, request.lists, measure);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const base::PixelList& list = request.lists[i];
    if (isUnseen(list)) continue;
    measured[i].truth = compare::meanLuminance(*images[0], list);
    measured[i].highend = compare::meanLuminance(*images[1], list);
    measured[i].mobile = compare::meanLuminance(*images[2], list);
    regions[i].terms.push_back(std::move(measured[i]));
  }
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
  compare::TruthMeasurement measured =
      compare::measureTruth({truth.picture, highend.picture, mobile.picture},
                            {&frames.referenceError, &frames.referenceTaken}, request.lists, measure);
  for (std::size_t term = 0; term < shading::kTermCount; ++term)
    addTerm(measured.regions, context, frames, term, request, measure);
  return {truth.displayed, std::move(measured.regions), std::move(measured.highendFlip),
          std::move(measured.mobileFlip)};
}

std::string describeTruth(const Settings& settings) {
  const reference::Options& options = settings.reference;
  const reference::Model& model = options.model;
  const bool multiple = model.scattering == reference::Scattering::multiple;
  const bool correlated = model.geometryTerm == reference::GeometryTerm::heightCorrelated;
  return fmt::format(
      "exact integrals, {} scattering between microfacets{}, {}, {} Fresnel curve, {} diffuse lobe{}, to "
      "a standard error of {:.3g} %",
      multiple ? "multiple" : "single", multiple ? " (Kulla-Conty)" : "",
      correlated ? "height-correlated Smith" : "Schlick-Smith",
      highend::fresnelNames()[static_cast<std::size_t>(model.fresnel)],
      highend::diffuseNames()[static_cast<std::size_t>(model.diffuse)], settings.shadows ? ", with shadows" : "",
      100 * options.integral.relativeError);
}

} // namespace parity::job
