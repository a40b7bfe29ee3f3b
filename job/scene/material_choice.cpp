#include "job/scene/material_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/glob.h"
#include "base/text/nearest.h"

namespace parity::job {

namespace {

// The share of each pixel that shows a material that matches.
std::vector<float> sharesOf(const scenes::Scene& scene, const std::vector<std::string>& globs,
                            const std::vector<base::PixelList>& coverage, std::size_t pixels) {
  std::vector<float> shares(pixels, 0.f);
  for (std::size_t m = 0; m < coverage.size(); ++m) {
    const auto matches = [&](const std::string& glob) { return base::matchesGlob(glob, scene.materials[m].name); };
    if (std::ranges::none_of(globs, matches)) continue;
    const base::PixelList& list = coverage[m];
    for (std::size_t i = 0; i < list.pixels.size(); ++i)
      shares[list.pixels[i]] += list.weights.empty() ? 1.f : list.weights[i];
  }
  return shares;
}

void blend(base::Image& image, const std::vector<float>& shares, const glm::vec3& rest) {
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i] >= 1) continue;
    for (int c = 0; c < 3; ++c) {
      float& value = image.pixels[static_cast<std::size_t>(image.channels) * i + static_cast<std::size_t>(c)];
      value = shares[i] > 0 ? rest[c] + shares[i] * (value - rest[c]) : rest[c]; // 0 * NaN is NaN
    }
  }
}

} // namespace

std::string describeUnmatched(const scenes::Scene& scene, const std::string& glob) {
  std::vector<std::string_view> names;
  for (const scenes::Material& material : scene.materials) names.push_back(material.name);
  return "no material has this name; " + base::describeNearestToGlob(glob, names);
}

bool hasAnyMaterial(const scenes::Scene& scene, const std::vector<std::string>& globs) {
  return globs.empty() || std::ranges::any_of(globs, [&](const std::string& glob) {
           return std::ranges::any_of(scene.materials, [&](const auto& m) { return base::matchesGlob(glob, m.name); });
         });
}

void requireMaterials(const scenes::Scene& scene, const std::vector<std::string>& globs) {
  for (const std::string& glob : globs)
    if (std::ranges::none_of(scene.materials, [&](const auto& m) { return base::matchesGlob(glob, m.name); }))
      throw base::Error(base::ExitCode::failed, scene.name, fmt::format("--material '{}'", glob),
                        describeUnmatched(scene, glob));
}

void keepMaterials(base::Frame& frame, const scenes::Scene& scene, const std::vector<std::string>& globs,
                   const std::vector<base::PixelList>& coverage, const glm::vec3& background) {
  if (globs.empty()) return;
  const std::vector<float> shares = sharesOf(scene, globs, coverage, frame.color.pixelCount());
  blend(frame.color, shares, background);
  for (base::Image& term : frame.terms) blend(term, shares, glm::vec3(0));
}

} // namespace parity::job
