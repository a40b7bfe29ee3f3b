// What must hold of the frames of every scene (see render_stress.h).
#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "shading/terms.h"
#include "study/stress/render_stress.h"

namespace parity::stress {

namespace {

Finding makeFinding(const StressScene& scene, const std::string& place, const std::string& fault) {
  Finding finding;
  finding.subject = scene.name;
  finding.place = place;
  finding.fault = fault;
  finding.count = 1;
  finding.reproduce = scene.reproduce;
  return finding;
}

// Of karis2014 up to this roughness: 1/R^4, and R.L that rounds to above 1 (study/stress/table_mobile.cpp).
float karisFailsUpTo(bool half) { return half ? 0.17f : 0.01f; }

// The pixels of materials on which karis2014's own formulas may fail.
std::vector<bool> pixelsOfKaris(const StressScene& scene, const SceneFrames& frames, const PathFrame& path) {
  std::vector<bool> pixels(path.frame.color.pixelCount(), false);
  if (path.preset != "karis2014") return pixels;
  for (std::size_t m = 0; m < frames.coverage.size(); ++m)
    if (scene.leastRoughness[m] <= karisFailsUpTo(path.half))
      for (const std::uint32_t pixel : frames.coverage[m].pixels) pixels[pixel] = true;
  return pixels;
}

bool isFinite(const base::Image& image, std::size_t pixel) {
  const float* p = image.pixels.data() + pixel * static_cast<std::size_t>(image.channels);
  return std::all_of(p, p + image.channels, [](float value) { return std::isfinite(value); });
}

// Above which magnitude of a pixel's terms half has saturated on the way: the colour of a surface stops at 65504, then
// fog and opacity take their share of it; the terms, one by one, do not stop. One number a pixel.
std::vector<double> saturationOf(const StressScene& scene, const SceneFrames& frames, const PathFrame& path) {
  std::vector<double> limits(path.frame.color.pixelCount(), 65504);
  for (const base::PixelList& list : frames.coverage)
    for (std::size_t i = 0; i < list.weights.size(); ++i)
      limits[list.pixels[i]] = std::min(limits[list.pixels[i]], 65504.0 * list.weights[i]);
  if (!scene.scene.fog) return limits;
  const base::Image& fog = path.frame.terms[static_cast<std::size_t>(shading::Term::fog)];
  for (std::size_t p = 0; p < limits.size(); ++p) {
    const double transmittance = 1 - fog.pixels[3 * p] / scene.scene.fog->color.x;
    limits[p] *= std::clamp(transmittance, 0.0, 1.0) * (limits[p] < 65504 ? 0.1 : 1); // layers differ in their fog
  }
  return limits;
}

// By how much the terms miss the colour, relative to the sum of their magnitudes.
double missOf(const PathFrame& path, std::size_t value, double saturation) {
  double sum = 0, magnitude = 0, ofSurface = 0;
  for (const base::Image& term : path.frame.terms) {
    sum += term.pixels[value];
    magnitude += std::fabs(term.pixels[value]);
    if (&term != &path.frame.terms[static_cast<std::size_t>(shading::Term::fog)])
      ofSurface += std::fabs(term.pixels[value]);
  }
  constexpr double kDenormals = 1e-6; // a dozen roundings of a half denormal
  double miss = std::fabs(sum - path.frame.color.pixels[value]);
  if (!path.preset.empty() && ofSurface > std::max(0.99 * saturation, 1e-3))
    miss = std::max(0.0, path.frame.color.pixels[value] - sum);
  return std::max(0.0, miss - kDenormals) / std::max(magnitude, kDenormals);
}

void checkPath(const StressScene& scene, const SceneFrames& frames, const PathFrame& path,
               std::vector<Finding>& findings) {
  const std::vector<bool> karis = pixelsOfKaris(scene, frames, path);
  const std::vector<double> saturation = saturationOf(scene, frames, path);
  const base::Image& color = path.frame.color;
  const double tolerance = path.half ? 4e-3 : 1e-3;
  std::uint64_t bad = 0, known = 0, apart = 0;
  std::size_t firstBad = 0, worstApart = 0;
  double worst = 0;
  for (std::size_t p = 0; p < color.pixelCount(); ++p) {
    const bool finite = isFinite(color, p) && std::all_of(path.frame.terms.begin(), path.frame.terms.end(),
                                                          [&](const base::Image& term) { return isFinite(term, p); });
    if (!finite) {
      if (!karis[p] && bad++ == 0) firstBad = p;
      known += karis[p];
      continue;
    }
    if (karis[p]) continue; // terms that saturated on their way to infinity
    double miss = 0;
    for (std::size_t c = 0; c < 3; ++c) miss = std::max(miss, missOf(path, 3 * p + c, saturation[p]));
    if (miss > tolerance) ++apart;
    if (miss > worst) {
      worst = miss;
      worstApart = p;
    }
  }
  const auto place = [&](std::size_t p) {
    return fmt::format("x {}, y {}", p % static_cast<std::size_t>(color.width),
                       p / static_cast<std::size_t>(color.width));
  };
  if (bad > 0) {
    Finding& finding = findings.emplace_back(makeFinding(scene, path.path, "not finite"));
    finding.count = bad;
    finding.example = fmt::format("{} of {} pixels; the first is at {}", bad, color.pixelCount(), place(firstBad));
  }
  if (apart > 0) {
    Finding& finding = findings.emplace_back(makeFinding(scene, path.path, "the terms do not sum to the colour"));
    finding.count = apart;
    finding.magnitude = worst;
    finding.example = fmt::format("{} pixels, by {:.3g} % at {}", apart, 100 * worst, place(worstApart));
  }
  const bool mustFail = scene.karisMustFail && path.preset == "karis2014";
  if (known > 0 || mustFail) {
    Finding& finding =
        findings.emplace_back(makeFinding(scene, path.path, known > 0 ? "not finite" : "vanished: not finite"));
    finding.expected = known > 0;
    finding.count = known;
    finding.region = fmt::format("karis2014, materials of roughness <= {}", karisFailsUpTo(path.half));
    finding.reason = "D_Approx: the article has no roughness floor";
    finding.example = fmt::format("{} pixels", known);
  }
}

} // namespace

std::vector<Finding> checkFrames(const StressScene& scene, const SceneFrames& frames, const SceneFrames* twin) {
  std::vector<Finding> findings;
  if (frames.paths.empty()) findings.push_back(makeFinding(scene, "", "nothing was rendered"));
  for (const PathFrame& path : frames.paths) {
    if (path.frame.color.empty() || path.frame.terms.size() < shading::kBaseTermCount)
      findings.push_back(makeFinding(scene, path.path, "no picture has terms"));
    else
      checkPath(scene, frames, path, findings);
  }
  if (scene.check && findings.end() == std::find_if(findings.begin(), findings.end(), [](const Finding& f) {
                       return f.fault == "no picture has terms" || f.fault == "nothing was rendered";
                     }))
    for (const std::string& text : scene.check(frames, twin)) {
      Finding& finding = findings.emplace_back(makeFinding(scene, "", "not as expected"));
      finding.example = text;
    }
  return findings;
}

std::vector<Finding> checkSame(const StressScene& scene, const PathFrame& first, const PathFrame& second) {
  const auto sameBits = [](const base::Image& a, const base::Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
  };
  bool same = sameBits(first.frame.color, second.frame.color) && first.frame.terms.size() == second.frame.terms.size();
  for (std::size_t t = 0; same && t < first.frame.terms.size(); ++t)
    same = sameBits(first.frame.terms[t], second.frame.terms[t]);
  if (same) return {};
  return {makeFinding(scene, first.path, "two renders differ")};
}

} // namespace parity::stress
