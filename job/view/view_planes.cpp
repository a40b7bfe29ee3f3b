#include "job/view/view_planes.h"

#include <algorithm>
#include <string>
#include <utility>

#include "shading/terms.h"

namespace parity::job {

namespace {

// Of each pixel the chosen material that covers most of it: 1 + its place in `chosen`, 0 for none; and its own FLIP.
struct Foremost {
  base::Image number, flip;
};

Foremost findForemost(const ViewFrames& frames, const std::vector<std::vector<float>>& materialFlip,
                      const std::vector<std::size_t>& chosen) {
  const int width = frames.first().frame.color.width, height = frames.first().frame.color.height;
  Foremost foremost{base::Image(width, height, 1), base::Image(width, height, 1)};
  std::vector<float> most(foremost.number.pixelCount(), 0.f);
  for (std::size_t i = 0; i < chosen.size() && i < 65535; ++i) { // more have no number
    const base::PixelList& list = frames.coverage[chosen[i]];
    for (std::size_t k = 0; k < list.pixels.size(); ++k) {
      const float weight = list.weights.empty() ? 1.f : list.weights[k];
      const std::uint32_t p = list.pixels[k];
      if (weight <= most[p]) continue;
      most[p] = weight;
      foremost.number.pixels[p] = static_cast<float>(i + 1);
      foremost.flip.pixels[p] = materialFlip[i][k];
    }
  }
  return foremost;
}

bool isBlack(const base::Image& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(), [](float v) { return v == 0; });
}

} // namespace

std::vector<report::PixelPlane> termPlanesOf(const ViewFrames& frames, const std::vector<Column>& columns,
                                             std::size_t test) {
  const base::Frame &first = frames.first().frame, &other = frames.paths[test].frame;
  std::vector<report::PixelPlane> planes;
  if (other.terms.empty()) return planes;
  for (std::size_t t = 0; t < first.terms.size(); ++t) {
    if (isBlack(first.terms[t]) && isBlack(other.terms[t])) continue;
    const std::string name = "." + std::string(shading::kTermNames[t]);
    planes.push_back({columns.front().name + name, report::PlaneKind::rgb16f, &first.terms[t]});
    planes.push_back({columns[test].name + name, report::PlaneKind::rgb16f, &other.terms[t]});
  }
  return planes;
}

ViewPlanes planesOf(const ViewFrames& frames, const std::vector<Column>& columns, std::size_t reference,
                    std::size_t test, const base::Image& flip, const std::vector<std::vector<float>>& materialFlip,
                    const std::vector<std::size_t>& chosen) {
  using report::PlaneKind;
  ViewPlanes planes;
  planes.color = {{columns[reference].name, PlaneKind::rgb16f, &frames.paths[reference].frame.color},
                  {columns[test].name, PlaneKind::rgb16f, &frames.paths[test].frame.color}};
  if (!frames.truth.color.empty()) planes.color.push_back({"truth", PlaneKind::rgb16f, &frames.truth.color});
  planes.color.push_back({"flip", PlaneKind::unorm16, &flip});
  Foremost foremost = findForemost(frames, materialFlip, chosen);
  planes.color.push_back({"materialFlip", PlaneKind::unorm16, &planes.made.emplace_back(std::move(foremost.flip))});
  planes.color.push_back({"material", PlaneKind::uint16, &planes.made.emplace_back(std::move(foremost.number))});
  if (reference == 0) planes.terms = termPlanesOf(frames, columns, test);
  return planes;
}

} // namespace parity::job
