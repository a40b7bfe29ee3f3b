#include "job/view/view_pictures.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include <fmt/format.h>

#include "base/file.h"
#include "base/frame.h"
#include "base/image/image_io.h"
#include "base/parallel.h"
#include "compare/flip/magma.h"
#include "compare/pooling/region.h"
#include "job/view/displayed.h"
#include "report/pixel_chunk.h"

namespace parity::job {

namespace {

// A material's own FLIP in its crop; 0 elsewhere.
base::Image ownFlip(const base::PixelList& list, const std::vector<float>& flip, const compare::Rect& box, int width) {
  base::Image map(box.width, box.height, 1);
  for (std::size_t i = 0; i < list.pixels.size(); ++i)
    *map.at(static_cast<int>(list.pixels[i]) % width - box.x, static_cast<int>(list.pixels[i]) / width - box.y) =
        flip[i];
  return map;
}

struct Picture {
  const base::Image8* whole;
  std::string path;
};

void nameImages(report::ImageSet& images, std::optional<compare::Truth>& truth, const std::string& prefix,
                const ViewPictures& of) {
  const std::string reference = prefix + "_" + of.reference.name, test = prefix + "_" + of.test.name;
  images = {reference + ".png", test + ".png", prefix + "_flip.png"};
  if (truth) truth->images = {prefix + "_truth.png", reference + "_truth_flip.png", test + "_truth_flip.png"};
}

std::string termFileOf(const std::string& prefix) { return "pixels/" + prefix + "_terms.js"; }

// The file of these planes, encoded from `first` on; nothing where there are none.
void appendChunk(std::vector<EncodedPicture>& files, std::string& name, const std::string& file,
                 const std::vector<report::PixelPlane>& planes, const report::EncodedPlane* first) {
  if (planes.empty()) return;
  name = file;
  const base::Image& shape = *planes.front().values;
  files.push_back({file, report::makeChunk(file, shape.width, shape.height, {first, planes.size()})});
}

} // namespace

compare::Rect cropOf(const base::PixelList& list, int width, int height) {
  const base::PixelList* lists[] = {&list};
  const compare::Rect box = compare::boundsOf(lists, width, height);
  return compare::boundsOf(lists, width, height, std::max(8, std::max(box.width, box.height) / 16));
}

base::Image8 crop(const base::Image8& image, const compare::Rect& box) {
  base::Image8 out(box.width, box.height, image.channels);
  for (int y = 0; y < out.height; ++y)
    std::copy_n(image.at(box.x, box.y + y), static_cast<std::size_t>(out.width) * image.channels, out.at(0, y));
  return out;
}

std::string pictureBeside(const std::string& picture, const std::string& path, const std::string& kind) {
  const std::string end = "_" + path + ".png"; // as nameImages has it
  assert(picture.ends_with(end));
  return picture.substr(0, picture.size() - end.size()) + "_" + kind + ".png";
}

std::vector<EncodedPicture> encodeViewPictures(report::ViewResult& view, const ViewPictures& pictures,
                                               const std::vector<compare::Rect>& crops,
                                               const std::vector<std::size_t>& numbers, const std::string& prefix) {
  const std::string stem = "images/" + prefix;
  nameImages(view.images, view.truth, stem, pictures);
  for (std::size_t i = 0; i < view.materials.size(); ++i)
    if (!crops[i].empty())
      nameImages(view.materials[i].crops, view.materials[i].truth, fmt::format("{}_m{}", stem, numbers[i]), pictures);

  const base::Image8 heat = compare::magmaImage(*pictures.flip);
  base::Image8 referenceHeat, testHeat;
  if (view.truth) {
    referenceHeat = compare::magmaImage(*pictures.referenceTruthFlip);
    testHeat = compare::magmaImage(*pictures.testTruthFlip);
  }
  struct Task {
    Picture picture;
    std::optional<compare::Rect> box;
  };
  std::vector<Task> tasks;
  const auto add = [&](const report::ImageSet& set, const std::optional<compare::Truth>& truth,
                       const std::optional<compare::Rect>& box) {
    std::vector<Picture> all = {{pictures.reference.picture, set.reference}, {pictures.test.picture, set.test}};
    if (!box) all.push_back({&heat, set.flip});
    if (truth) {
      all.push_back({pictures.truth, truth->images.truth});
      all.push_back({&referenceHeat, truth->images.referenceFlip});
      all.push_back({&testHeat, truth->images.testFlip});
    }
    for (const Picture& picture : all) tasks.push_back({picture, box});
  };
  add(view.images, view.truth, std::nullopt);
  for (std::size_t i = 0; i < view.materials.size(); ++i)
    if (!crops[i].empty()) add(view.materials[i].crops, view.materials[i].truth, crops[i]);
  std::vector<base::Image8> ownHeats(view.materials.size());
  for (std::size_t i = 0; i < view.materials.size(); ++i) {
    if (crops[i].empty()) continue;
    ownHeats[i] = compare::magmaImage(
        ownFlip(*pictures.materials[i], (*pictures.materialFlip)[i], crops[i], pictures.flip->width));
    tasks.push_back({{&ownHeats[i], view.materials[i].crops.flip}, std::nullopt});
  }
  std::vector<report::PixelPlane> planes = pictures.planes.color;
  planes.insert(planes.end(), pictures.planes.terms.begin(), pictures.planes.terms.end());
  std::vector<EncodedPicture> encoded(tasks.size());
  std::vector<report::EncodedPlane> encodedPlanes(planes.size());
  const auto encode = [&](std::size_t i) { // planes first: they take longest
    if (i < planes.size()) {
      encodedPlanes[i] = report::encodePlane(planes[i]);
      return;
    }
    const auto& [picture, box] = tasks[i - planes.size()];
    encoded[i - planes.size()] = {picture.path,
                                  base::encodeImage8(picture.path, box ? crop(*picture.whole, *box) : *picture.whole)};
  };
  base::parallelFor(planes.size() + tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) encode(i);
  });
  const report::EncodedPlane* const first = encodedPlanes.data();
  appendChunk(encoded, view.pixels.color, "pixels/" + prefix + ".js", pictures.planes.color, first);
  appendChunk(encoded, view.pixels.terms, termFileOf(prefix), pictures.planes.terms,
              first + pictures.planes.color.size());
  return encoded;
}

std::vector<EncodedPicture> encodeTerms(report::ViewResult& view, const std::vector<report::PixelPlane>& planes,
                                        const std::string& prefix) {
  std::vector<report::EncodedPlane> encoded(planes.size());
  base::parallelFor(planes.size(), 1, [&](std::size_t i, std::size_t) { encoded[i] = report::encodePlane(planes[i]); });
  std::vector<EncodedPicture> files;
  appendChunk(files, view.pixels.terms, termFileOf(prefix), planes, encoded.data());
  return files;
}

void writePictures(const std::vector<EncodedPicture>& pictures, const std::filesystem::path& folder) {
  base::parallelFor(pictures.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) base::writeBytes(folder / pictures[i].file, pictures[i].bytes);
  });
}

} // namespace parity::job
