#include "job/scene_record.h"

#include <cassert>

#include "compare/pixel_chunk.h"
#include "job/archive.h"

namespace parity::compare {

using job::Is;

template <Is<Figure> T> auto fields(T& figure) {
  auto& [name, value] = figure;
  return std::tie(name, value);
}
template <Is<Figures> T> auto fields(T& figures) {
  auto& [pixels, nonFinite, clippedBlack, clippedWhite, referenceLuma, testLuma, referenceLuminance, testLuminance,
         values] = figures;
  return std::tie(pixels, nonFinite, clippedBlack, clippedWhite, referenceLuma, testLuma, referenceLuminance,
                  testLuminance, values);
}
template <Is<TruthError> T> auto fields(T& error) {
  auto& [median, worst, relmse, samples] = error;
  return std::tie(median, worst, relmse, samples);
}
template <Is<TruthFigures> T> auto fields(T& figures) {
  auto& [highend, mobile, error, nonFinite] = figures;
  return std::tie(highend, mobile, error, nonFinite);
}
template <Is<TruthTerm> T> auto fields(T& term) {
  auto& [name, truth, highend, mobile, highendFigures, mobileFigures] = term;
  return std::tie(name, truth, highend, mobile, highendFigures, mobileFigures);
}
template <Is<TruthImages> T> auto fields(T& images) {
  auto& [truth, highendFlip, mobileFlip] = images;
  return std::tie(truth, highendFlip, mobileFlip);
}
template <Is<Truth> T> auto fields(T& truth) {
  auto& [figures, terms, notes, images] = truth;
  return std::tie(figures, terms, notes, images);
}
template <Is<Encoding> T> auto fields(T& encoding) {
  auto& [target, figures] = encoding;
  return std::tie(target, figures);
}
template <Is<TextureCompression> T> auto fields(T& textures) {
  auto& [block, figures] = textures;
  return std::tie(block, figures);
}
template <Is<ImageSet> T> auto fields(T& images) {
  auto& [reference, test, flip] = images;
  return std::tie(reference, test, flip);
}
template <Is<TermFigures> T> auto fields(T& figures) {
  auto& [term, reference, test] = figures;
  return std::tie(term, reference, test);
}
template <Is<TermEffect> T> auto fields(T& effect) {
  auto& [term, flip] = effect;
  return std::tie(term, flip);
}
template <Is<Attribution> T> auto fields(T& attribution) {
  auto& [flip, terms] = attribution;
  return std::tie(flip, terms);
}
template <Is<PixelFiles> T> auto fields(T& files) {
  auto& [color, terms] = files;
  return std::tie(color, terms);
}
template <Is<MaterialResult> T> auto fields(T& material) {
  auto& [name, figures, checks, verdict, reason, notModelled, notes, terms, crops, rule, baseline, truth, encoding,
         textures, attribution, seenElsewhere] = material;
  return std::tie(name, figures, notModelled, notes, terms, crops, truth, encoding, textures, attribution);
}
template <Is<LightEffect> T> auto fields(T& effect) {
  auto& [material, flip] = effect;
  return std::tie(material, flip);
}
template <Is<DroppedLight> T> auto fields(T& light) {
  auto& [name, kind, keptBy, droppedBy, materials] = light;
  return std::tie(name, kind, keptBy, droppedBy, materials);
}
template <Is<DroppedLights> T> auto fields(T& dropped) {
  auto& [lights, measured, notMeasured] = dropped;
  return std::tie(lights, measured, notMeasured);
}
template <Is<ViewResult> T> auto fields(T& view) {
  auto& [name, width, height, whole, checks, rule, baseline, truth, encoding, textures, verdict, wholeVerdict, reason,
         materials, images, pixels, exposureEv, droppedLights, conditions] = view;
  return std::tie(name, width, height, whole, truth, encoding, textures, materials, images, pixels, exposureEv,
                  droppedLights);
}
template <Is<PassResult> T> auto fields(T& pass) {
  auto& [name, unit, count, skipped] = pass;
  return std::tie(name, unit, count, skipped);
}
template <Is<PermutationCost> T> auto fields(T& cost) {
  auto& [fp32, fp16, integer, fetches, openLoops] = cost;
  return std::tie(fp32, fp16, integer, fetches, openLoops);
}
template <Is<PermutationResult> T> auto fields(T& permutation) {
  auto& [path, textures, features, pixels, samplers, cost] = permutation;
  return std::tie(path, textures, features, pixels, samplers, cost);
}
// Scenes with an error are not kept; the conditions are in the key.
template <Is<SceneResult> T> auto fields(T& scene) {
  auto& [name, source, environment, sun, light, warnings, views, passes, permutations, error, errorExitCode, verdict,
         conditions] = scene;
  return std::tie(name, source, environment, sun, light, warnings, views, passes, permutations);
}

} // namespace parity::compare

namespace parity::job {

template <Is<EncodedPicture> T> auto fields(T& picture) {
  auto& [file, bytes] = picture;
  return std::tie(file, bytes);
}
template <Is<SceneRecord> T> auto fields(T& record) {
  auto& [result, prefixes, pictures] = record;
  return std::tie(result, prefixes, pictures);
}

std::vector<std::byte> toBytes(const SceneRecord& record) {
  assert(record.result.error.empty());
  Writer write;
  write(record);
  return write.bytes();
}

std::optional<SceneRecord> recordFromBytes(std::span<const std::byte> bytes) {
  try {
    Reader read(bytes);
    SceneRecord record;
    read(record);
    if (read.atEnd() && record.prefixes.size() == record.result.views.size()) return record;
  } catch (const std::out_of_range&) { // not whole
  }
  return std::nullopt;
}

void renamePictures(SceneRecord& record, const std::vector<std::string>& prefixes) {
  assert(prefixes.size() == record.prefixes.size());
  const auto rename = [&](std::string& name, std::size_t view) {
    const std::string before = "images/" + record.prefixes[view] + "_";
    if (name.starts_with(before)) name.replace(0, before.size(), "images/" + prefixes[view] + "_");
  };
  const auto renamePixels = [&](std::string& name, std::size_t view) {
    for (const char* end : {".js", "_terms.js"})
      if (name == "pixels/" + record.prefixes[view] + end) {
        name = "pixels/" + prefixes[view] + end;
        return true;
      }
    return false;
  };
  const auto renameAll = [&](compare::ImageSet& images, std::optional<compare::Truth>& truth, std::size_t view) {
    for (std::string* name : {&images.reference, &images.test, &images.flip}) rename(*name, view);
    if (!truth) return;
    for (std::string* name : {&truth->images.truth, &truth->images.highendFlip, &truth->images.mobileFlip})
      rename(*name, view);
  };
  for (std::size_t v = 0; v < prefixes.size(); ++v) {
    compare::ViewResult& view = record.result.views[v];
    renameAll(view.images, view.truth, v);
    for (std::string* name : {&view.pixels.color, &view.pixels.terms}) renamePixels(*name, v);
    for (compare::MaterialResult& material : view.materials) renameAll(material.crops, material.truth, v);
  }
  for (EncodedPicture& picture : record.pictures)
    for (std::size_t v = 0; v < prefixes.size(); ++v) {
      if (renamePixels(picture.file, v)) {
        compare::renameChunk(picture.bytes, picture.file);
        break;
      }
      const std::string before = "images/" + record.prefixes[v] + "_";
      if (!picture.file.starts_with(before)) continue;
      rename(picture.file, v);
      break; // its new name may begin as another view's old one
    }
  record.prefixes = prefixes;
}

} // namespace parity::job
