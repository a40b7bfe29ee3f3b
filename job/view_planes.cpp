#include "job/view_planes.h"

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
  const int width = frames.highend.color.width, height = frames.highend.color.height;
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

std::vector<compare::PixelPlane> termPlanesOf(const ViewFrames& frames) {
  std::vector<compare::PixelPlane> planes;
  for (std::size_t t = 0; t < frames.highend.terms.size(); ++t) {
    const base::Image &highend = frames.highend.terms[t], &mobile = frames.mobile.terms[t];
    if (isBlack(highend) && isBlack(mobile)) continue;
    const std::string name(shading::kTermNames[t]);
    planes.push_back({"highend." + name, compare::PlaneKind::rgb16f, &highend});
    planes.push_back({"mobile." + name, compare::PlaneKind::rgb16f, &mobile});
  }
  return planes;
}

ViewPlanes planesOf(const ViewFrames& frames, const base::Image& flip,
                    const std::vector<std::vector<float>>& materialFlip, const std::vector<std::size_t>& chosen) {
  using compare::PlaneKind;
  ViewPlanes planes;
  planes.color = {{"highend", PlaneKind::rgb16f, &frames.highend.color},
                  {"mobile", PlaneKind::rgb16f, &frames.mobile.color}};
  if (!frames.reference.color.empty()) planes.color.push_back({"truth", PlaneKind::rgb16f, &frames.reference.color});
  planes.color.push_back({"flip", PlaneKind::unorm16, &flip});
  Foremost foremost = findForemost(frames, materialFlip, chosen);
  planes.color.push_back({"materialFlip", PlaneKind::unorm16, &planes.made.emplace_back(std::move(foremost.flip))});
  planes.color.push_back({"material", PlaneKind::uint16, &planes.made.emplace_back(std::move(foremost.number))});
  planes.terms = termPlanesOf(frames);
  return planes;
}

} // namespace parity::job
