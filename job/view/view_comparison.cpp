#include "job/view/view_comparison.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "base/parallel.h"
#include "base/text/glob.h"
#include "compare/metrics/measure.h"
#include "compare/metrics/measure_truth.h"
#include "compare/pooling/region.h"
#include "job/report_folder.h"
#include "job/view/displayed.h"
#include "job/view/material_swaps.h"
#include "job/view/path_stage.h"
#include "job/view/truth_comparison.h"
#include "shading/terms.h"

namespace parity::job {

namespace {

compare::Rect unionOf(const compare::Rect& a, const compare::Rect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

// The pixels of these materials together.
base::PixelList allPixels(const std::vector<base::PixelList>& coverage, const std::vector<std::size_t>& materials,
                          std::size_t pixelCount) {
  std::vector<float> weight(pixelCount, 0.f);
  for (const std::size_t m : materials) {
    const base::PixelList& list = coverage[m];
    for (std::size_t i = 0; i < list.pixels.size(); ++i) {
      float& w = weight[list.pixels[i]];
      w = std::min(w + (list.weights.empty() ? 1.f : list.weights[i]), 1.f);
    }
  }
  base::PixelList all{"all materials", {}, {}};
  for (std::size_t p = 0; p < pixelCount; ++p)
    if (weight[p] > 0) {
      all.pixels.push_back(static_cast<std::uint32_t>(p));
      all.weights.push_back(weight[p]);
    }
  if (std::all_of(all.weights.begin(), all.weights.end(), [](float w) { return w == 1; })) all.weights.clear();
  return all;
}

std::vector<std::string> materialNotes(const scenes::Material& m, const paths::Path& path,
                                       const paths::Options& options) {
  std::vector<std::string> notes;
  if (m.unlit) {
    notes.push_back("unlit");
    return notes;
  }
  for (std::string& note : path.notesOn(m, options)) notes.push_back(std::move(note));
  const glm::vec3 f0 = m.dielectricF0();
  if (f0.x != f0.y || f0.y != f0.z || m.specularColorTexture.present())
    notes.push_back("tinted F0: both paths keep it as RGB");
  if (std::max({f0.x, f0.y, f0.z}) > 0.08f) notes.push_back("F0 is above 0.08, the limit of UE4's Specular");
  if (m.alphaMode == scenes::AlphaMode::blend) notes.push_back("alpha-blended: its pixels count by their opacity");
  return notes;
}

// What is measured where: the whole image, and each chosen material.
struct Subject {
  base::PixelList whole;
  std::vector<const base::PixelList*> materials;
  std::vector<compare::Rect> crops; // of the materials
  std::optional<compare::Rect> box; // where the report shows only some materials
};

Subject makeSubject(const ViewFrames& frames, const std::vector<std::size_t>& chosen, bool restricted) {
  const int width = frames.first().frame.color.width, height = frames.first().frame.color.height;
  Subject subject;
  // With --material the whole is what was chosen, not what else is in the picture.
  subject.whole = allPixels(frames.coverage, chosen, frames.first().frame.color.pixelCount());
  compare::Rect box;
  for (const std::size_t m : chosen) {
    subject.materials.push_back(&frames.coverage[m]);
    subject.crops.push_back(cropOf(frames.coverage[m], width, height));
    box = unionOf(box, subject.crops.back());
  }
  if (restricted && !box.empty()) subject.box = box;
  return subject;
}

// A frame's linear light as the camera exposes it.
class Exposed {
public:
  Exposed(const base::Image& color, float exposureEv)
      : m_copy(exposureEv != 0 ? expose(color, exposureEv) : base::Image()),
        m_image(m_copy.empty() ? &color : &m_copy) {}
  Exposed(const Exposed&) = delete;
  Exposed& operator=(const Exposed&) = delete;
  const base::Image& image() const { return *m_image; }

private:
  base::Image m_copy;
  const base::Image* m_image;
};

struct ViewMeasurement {
  compare::Measurement whole;
  compare::SwapMeasurement materials;
};

// What a material is swapped by: of a path that is compared with the first what the renderer has gathered, else the
// pictures themselves.
struct SwapSource {
  const std::vector<gpu::SwappedPixels>&swap, &swapLight;
};

// Of each material the reference's picture with the test's colours, where they are no paths over the same surfaces.
std::vector<gpu::SwappedPixels> mixedSwaps(const ViewFrames& frames, const ViewComparisonRequest& request) {
  std::vector<gpu::SwappedPixels> swaps(frames.coverage.size());
  base::parallelFor(swaps.size(), 1, [&](std::size_t m, std::size_t) {
    swaps[m] = mixByCoverage(frames.coverage[m], frames.paths[request.reference].frame.color,
                             frames.paths[request.test].frame.color);
  });
  return swaps;
}

// The materials as the test's colours make them; a picture of it as displayed.
std::vector<compare::Swap> swapsOf(Context& context, const ViewFrames& frames, const SwapSource& path,
                                   const Displayed& test, const Subject& subject, float exposureEv) {
  // A target that is displayed cuts light off above white: figures of linear light are of what the shader made.
  const bool isCut = !path.swapLight.empty();
  std::vector<compare::Swap> swaps(subject.materials.size());
  base::parallelFor(swaps.size(), 1, [&](std::size_t i, std::size_t) {
    const base::PixelList& list = *subject.materials[i];
    const std::size_t material = static_cast<std::size_t>(&list - frames.coverage.data());
    swaps[i] = displaySwap(context, list, path.swap[material], 0, exposureEv, &test);
    if (isCut && !list.pixels.empty())
      swaps[i].linear = Exposed(path.swapLight[material].planes[0], exposureEv).image();
  });
  return swaps;
}

compare::MeasureRequest wishOf(const Subject& subject, const ViewComparisonRequest& request) {
  compare::MeasureRequest measure;
  measure.metrics = request.settings.metrics;
  measure.statistics = request.statistics;
  measure.options.box = subject.box;
  return measure;
}

ViewMeasurement measureView(Context& context, const ViewFrames& frames, const Displayed& reference,
                            const Displayed& test, const Subject& subject, const SwapSource& source,
                            const ViewComparisonRequest& request) {
  std::vector<std::uint32_t> invalid = reference.nonFinite;
  invalid.insert(invalid.end(), test.nonFinite.begin(), test.nonFinite.end());
  const PathFrames& path = frames.paths[request.test];
  const Exposed referenceLight(frames.paths[request.reference].frame.color, request.settings.exposureEv),
      testLight(path.swapLight.empty() ? path.frame.color : path.beforeTarget, request.settings.exposureEv);
  compare::MeasureRequest measure = wishOf(subject, request);
  if (request.pictures) measure.keepMaps = {"flip"}; // for the pictures
  const std::vector<compare::Swap> swaps = swapsOf(context, frames, source, test, subject, request.settings.exposureEv);
  return {compare::measureRegions({reference.pixels, test.pixels, &referenceLight.image(), &testLight.image(), invalid},
                                  {subject.whole}, measure),
          compare::measureSwaps(referenceOf(reference, referenceLight.image()), swaps, measure)};
}

std::string titleOf(const ViewComparisonRequest& request, std::size_t column) {
  return column < request.paths.chosen.size() ? request.paths.chosen[column]->title() : request.columns[column].name;
}

// In names of files an external is what it stands for, whatever it is called.
std::string fileWord(const ViewComparisonRequest& request, std::size_t column) {
  if (!request.columns[column].external) return request.columns[column].name;
  return column == request.reference ? kExternalReference : kExternal;
}

// Of each material that is seen, what each preset of this path would give.
std::vector<std::vector<report::WhatIf>> measureWhatIfs(Context& context, const ViewFrames& frames,
                                                        const Displayed& reference, const Subject& subject,
                                                        const ViewComparisonRequest& request) {
  std::vector<std::vector<report::WhatIf>> all(subject.materials.size());
  const Settings& settings = request.settings;
  const Exposed referenceLight(frames.first().frame.color, settings.exposureEv);
  if (request.isMixed()) return all; // they are swapped into the first path's picture
  for (std::size_t k = 0; k < frames.whatIfs.size(); ++k) {
    if (settings.whatIfs[k].path != request.columns[request.test].name) continue;
    const base::Stopwatch watch(&context.timings(), "compare what-ifs");
    const PathFrames& path = frames.whatIfs[k];
    const Displayed shown = displayImage(path.frame.color, context.display(), settings.exposureEv);
    const std::vector<compare::Swap> swaps =
        swapsOf(context, frames, {path.swap, path.swapLight}, shown, subject, settings.exposureEv);
    std::vector<compare::Figures> figures =
        compare::measureSwaps(referenceOf(reference, referenceLight.image()), swaps, wishOf(subject, request)).figures;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (figures[i].pixels > 0) {
        report::WhatIf& whatIf = all[i].emplace_back();
        whatIf.preset = settings.whatIfs[k].preset;
        whatIf.figures = std::move(figures[i]);
      }
  }
  return all;
}

} // namespace

std::vector<report::TermFigures> termFigures(const ViewFrames& frames, std::size_t test, const base::PixelList& list) {
  const base::Frame &first = frames.first().frame, &other = frames.paths[test].frame;
  std::vector<report::TermFigures> result;
  if (first.terms.empty() || other.terms.empty() || list.pixels.empty()) return result;
  const auto mean = [&](const base::Image& term) { return term.empty() ? 0.0 : compare::meanLuminance(term, list); };
  for (std::size_t t = 0; t < first.terms.size(); ++t)
    result.push_back({std::string(shading::kTermNames[t]), mean(first.terms[t]), mean(other.terms[t])});
  return result;
}

std::vector<std::size_t> chooseMaterials(const scenes::Scene& scene, const std::vector<std::string>& globs,
                                         std::size_t count) {
  std::vector<std::size_t> chosen;
  for (std::size_t m = 0; m < count; ++m)
    if (globs.empty() || std::any_of(globs.begin(), globs.end(), [&](const std::string& glob) {
          return base::matchesGlob(glob, scene.materials[m].name);
        }))
      chosen.push_back(m);
  return chosen;
}

ComparedView compareView(Context& context, const scenes::Scene& scene, const ViewFrames& frames,
                         const ViewComparisonRequest& request) {
  const Settings& settings = request.settings;
  const paths::Path* path = request.renderer ? request.paths.chosen[request.test] : nullptr;
  const std::string &referenceName = request.columns[request.reference].name,
                    &testName = request.columns[request.test].name;
  const PathFrames &first = frames.paths[request.reference], &tested = frames.paths[request.test];
  const std::vector<gpu::SwappedPixels> mixed =
      request.isMixed() ? mixedSwaps(frames, request) : std::vector<gpu::SwappedPixels>();
  const std::vector<gpu::SwappedPixels> none;
  const SwapSource source{request.isMixed() ? mixed : tested.swap, request.isMixed() ? none : tested.swapLight};
  ComparedView compared;
  compared.test = request.test;
  Displayed &reference = compared.reference, &test = compared.tested;
  {
    const base::Stopwatch watch(&context.timings(), "display transform");
    reference = displayImage(first.frame.color, context.display(), settings.exposureEv);
    test = displayImage(tested.frame.color, context.display(), settings.exposureEv);
  }
  const std::vector<std::size_t>& chosen = compared.materials =
      chooseMaterials(scene, settings.materials, frames.coverage.size());
  Subject subject;
  ViewMeasurement measured;
  {
    const base::Stopwatch watch(&context.timings(), "metrics");
    subject = makeSubject(frames, chosen, !settings.materials.empty());
    measured = measureView(context, frames, reference, test, subject, source, request);
  }

  std::vector<std::vector<report::WhatIf>> whatIfs = measureWhatIfs(context, frames, reference, subject, request);

  const auto measureSince = [&](const base::Image& before) {
    return measureStage(context, {before, tested.frame.color, test, subject.whole, subject.materials, subject.box,
                                  settings.exposureEv});
  };
  std::vector<compare::Figures> encoding, textures;
  const std::string target = path ? path->targetName(settings.options) : "";
  if (!target.empty()) encoding = measureSince(tested.beforeTarget);
  const base::TextureBlock compressed = path ? path->textureBlock(settings.options) : base::TextureBlock::none;
  if (compressed != base::TextureBlock::none)
    textures = measureSince(tested.ofOriginals.empty() ? tested.frame.color : tested.ofOriginals);
  const std::string& block = base::textureBlockNames()[static_cast<std::size_t>(compressed)];

  std::optional<TruthComparison> truth;
  if (settings.truth)
    truth = compareWithTruth(context, frames, first, tested,
                             {reference, test, subject.whole, subject.materials, subject.box, settings.exposureEv,
                              settings.reference.integral.relativeError, request.pictures,
                              titleOf(request, request.reference), titleOf(request, request.test)});

  report::ViewResult& view = compared.view;
  view.name = request.viewName;
  view.reference = referenceName;
  view.test = testName;
  view.width = settings.width;
  view.height = settings.height;
  view.exposureEv = settings.exposureEv;
  view.whole = measured.whole.regions[0];
  if (!encoding.empty()) view.stages.push_back({report::kEncodingStage, target, std::move(encoding[0])});
  if (!textures.empty()) view.stages.push_back({report::kTexturesStage, block, std::move(textures[0])});
  if (truth) view.truth = truth->whole;
  view.materials.resize(chosen.size());
  base::parallelFor(chosen.size(), 1, [&](std::size_t i, std::size_t) {
    const base::PixelList& list = frames.coverage[chosen[i]];
    report::MaterialResult& material = view.materials[i];
    material.name = scene.materials[chosen[i]].name;
    material.test = testName;
    material.figures = measured.materials.figures[i];
    // Two engines may well model what we do not.
    const bool areOthers = request.columns[request.reference].external && request.columns[request.test].external;
    if (!areOthers) material.notModelled = scene.materials[chosen[i]].notModelled;
    if (path) {
      material.notes = materialNotes(scene.materials[chosen[i]], *path, settings.options);
      if (std::string excess = request.renderer->describeExcess(scene.materials[chosen[i]]); !excess.empty())
        material.notes.push_back(std::move(excess));
    }
    material.isExternal = request.isMixed();
    if (!request.isMixed()) material.terms = termFigures(frames, request.test, list);
    material.whatIf = std::move(whatIfs[i]);
    if (!encoding.empty()) material.stages.push_back({report::kEncodingStage, target, std::move(encoding[i + 1])});
    if (!textures.empty()) material.stages.push_back({report::kTexturesStage, block, std::move(textures[i + 1])});
    if (truth) material.truth = truth->materials[i];
  });
  if (!request.pictures) return compared;

  const base::Stopwatch watch(&context.timings(), "encode images");
  ViewPictures pictures;
  pictures.reference = {request.isMixed() ? fileWord(request, request.reference) : referenceName, &reference.pixels};
  pictures.test = {request.isMixed() ? fileWord(request, request.test) : testName, &test.pixels};
  pictures.flip = measured.whole.findMap("flip");
  pictures.materials = subject.materials;
  pictures.materialFlip = &measured.materials.flip;
  if (truth) {
    pictures.truth = &truth->truth.pixels;
    pictures.referenceTruthFlip = &truth->referenceFlip;
    pictures.testTruthFlip = &truth->testFlip;
  }
  if (request.pixelData)
    pictures.planes = planesOf(frames, request.columns, request.reference, request.test, *pictures.flip,
                               measured.materials.flip, chosen);
  compared.pictures = encodeViewPictures(view, pictures, subject.crops, chosen, request.imagePrefix);
  return compared;
}

} // namespace parity::job
