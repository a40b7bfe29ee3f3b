#include "job/view_comparison.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/glob.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "compare/flip.h"
#include "compare/magma.h"
#include "compare/metrics.h"
#include "compare/region.h"
#include "job/displayed.h"
#include "shading/terms.h"

namespace parity::job {

namespace {

struct Box {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0; // half open
};

// The list's pixels with a margin, so that the crop shows what surrounds them.
Box boxAround(const base::PixelList& list, int width, int height) {
  int x0 = width, y0 = height, x1 = 0, y1 = 0;
  for (const std::uint32_t p : list.pixels) {
    const int x = static_cast<int>(p) % width, y = static_cast<int>(p) / width;
    x0 = std::min(x0, x), x1 = std::max(x1, x + 1);
    y0 = std::min(y0, y), y1 = std::max(y1, y + 1);
  }
  const int margin = std::max(8, std::max(x1 - x0, y1 - y0) / 16);
  return {std::max(x0 - margin, 0), std::max(y0 - margin, 0), std::min(x1 + margin, width),
          std::min(y1 + margin, height)};
}

base::Image8 crop(const base::Image8& image, const Box& box) {
  base::Image8 out(box.x1 - box.x0, box.y1 - box.y0, image.channels);
  for (int y = 0; y < out.height; ++y)
    std::copy_n(image.at(box.x0, box.y0 + y), static_cast<std::size_t>(out.width) * image.channels, out.at(0, y));
  return out;
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

// Whether all of the list is black in both pictures, or all of it white.
bool isFlat(const base::Image8& reference, const base::Image8& test, const base::PixelList& list) {
  if (list.pixels.empty()) return false;
  const std::uint8_t value = reference.pixels[std::size_t{list.pixels.front()} * 3];
  if (value != 0 && value != 255) return false;
  return std::all_of(list.pixels.begin(), list.pixels.end(), [&](std::uint32_t p) {
    const auto isValue = [&](const base::Image8& image) {
      const std::uint8_t* rgb = image.pixels.data() + std::size_t{p} * 3;
      return rgb[0] == value && rgb[1] == value && rgb[2] == value;
    };
    return isValue(reference) && isValue(test);
  });
}

std::vector<std::string> materialNotes(const scenes::Material& m) {
  std::vector<std::string> notes;
  if (m.unlit) return {"unlit"};
  if (m.fullyRough) notes.push_back("fully rough: no specular, no environment fetch on mobile");
  if (m.isNonmetal() && !m.fullyRough) notes.push_back("nonmetal: EnvBRDFApproxNonmetal on mobile");
  const glm::vec3 f0 = m.dielectricF0();
  if (f0.x != f0.y || f0.y != f0.z || m.specularColorTexture.present())
    notes.push_back("tinted F0, kept as RGB by both paths");
  if (std::max({f0.x, f0.y, f0.z}) > 0.08f) notes.push_back("F0 above 0.08, beyond UE4's Specular");
  if (m.alphaMode == scenes::AlphaMode::blend) notes.push_back("alpha-blended: drawn as one layer on top");
  return notes;
}

// Mean scene-referred luminance of each term over the region.
std::vector<compare::TermFigures> termFigures(const ViewFrames& frames, const base::PixelList& list) {
  std::vector<compare::TermFigures> result;
  if (frames.highend.terms.empty() || list.pixels.empty()) return result;
  const auto mean = [&](const base::Image& term) {
    double sum = 0, total = 0;
    for (std::size_t i = 0; i < list.pixels.size(); ++i) {
      const float* p = term.pixels.data() + std::size_t{list.pixels[i]} * 3;
      const double weight = list.weights.empty() ? 1 : list.weights[i];
      sum += weight * (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
      total += weight;
    }
    return sum / total;
  };
  for (std::size_t t = 0; t < shading::kTermCount; ++t)
    result.push_back(
        {std::string(shading::kTermNames[t]), mean(frames.highend.terms[t]), mean(frames.mobile.terms[t])});
  return result;
}

} // namespace

compare::ViewResult compareView(Context& context, const scenes::Scene& scene, const ViewFrames& frames,
                                const compare::Budgets& budgets, const ViewComparisonRequest& request) {
  const Settings& settings = context.settings();
  Displayed reference, test;
  {
    const base::Stopwatch watch(&context.timings(), "display transform");
    reference = displayImage(frames.highend.color, context.display(), request.exposureEv);
    test = displayImage(frames.mobile.color, context.display(), request.exposureEv);
  }
  base::Image flip;
  {
    const base::Stopwatch watch(&context.timings(), "flip");
    flip = compare::flipMap(reference.finite, test.finite);
    markNonFinite(flip, reference.measured);
    markNonFinite(flip, test.measured);
  }

  compare::ViewResult view;
  view.name = request.viewName;
  view.width = settings.width;
  view.height = settings.height;
  {
    const base::Stopwatch watch(&context.timings(), "figures");
    std::vector<std::size_t> chosen;
    for (std::size_t m = 0; m < frames.coverage.size(); ++m) {
      const auto& globs = settings.materials;
      if (globs.empty() || std::any_of(globs.begin(), globs.end(), [&](const std::string& g) {
            return base::matchesGlob(g, scene.materials[m].name);
          }))
        chosen.push_back(m);
    }
    // With --material the whole is what was chosen, not what else is in the picture.
    const base::PixelList whole = allPixels(frames.coverage, chosen, flip.pixelCount());
    view.whole = compare::measureRegion(reference.measured, test.measured, flip, whole);
    view.materials.resize(chosen.size());
    base::parallelFor(chosen.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const base::PixelList& list = frames.coverage[chosen[i]];
        compare::MaterialResult& material = view.materials[i];
        material.name = scene.materials[chosen[i]].name;
        material.figures = compare::measureRegion(reference.measured, test.measured, flip, list);
        material.notes = materialNotes(scene.materials[chosen[i]]);
        if (isFlat(reference.pixels, test.pixels, list))
          material.notes.push_back("all black or all white in both pictures: there is nothing to compare");
        material.terms = termFigures(frames, list);
        compare::judgeMaterial(material, budgets, request.sceneName);
      }
    });
    compare::judgeWhole(view, budgets, request.sceneName);
    if (request.reportFolder.empty()) return view;

    const std::string prefix = "images/" + request.imagePrefix;
    view.images = {prefix + "_highend.png", prefix + "_mobile.png", prefix + "_flip.png"};
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (frames.coverage[chosen[i]].pixels.empty()) continue;
      const std::string crops = fmt::format("{}_m{}", prefix, chosen[i]);
      view.materials[i].crops = {crops + "_highend.png", crops + "_mobile.png", crops + "_flip.png"};
    }
  }

  const base::Stopwatch watch(&context.timings(), "write images");
  const base::Image8 heat = quantize(compare::magmaImage(flip));
  const base::Image8* pictures[] = {&reference.pixels, &test.pixels, &heat};
  std::vector<std::function<void()>> tasks;
  const auto write = [&](const std::string& path, base::Image8 image) {
    base::writeImage8(request.reportFolder / path, image);
  };
  for (int k = 0; k < 3; ++k) {
    const std::string& path = k == 0 ? view.images.reference : k == 1 ? view.images.test : view.images.flip;
    tasks.push_back([&write, path, picture = pictures[k]] { write(path, *picture); });
  }
  for (const compare::MaterialResult& material : view.materials) {
    if (material.crops.reference.empty()) continue;
    const auto list = std::find_if(frames.coverage.begin(), frames.coverage.end(),
                                   [&](const auto& l) { return l.name == material.name; });
    const Box box = boxAround(*list, settings.width, settings.height);
    const std::string* paths[] = {&material.crops.reference, &material.crops.test, &material.crops.flip};
    for (int k = 0; k < 3; ++k)
      tasks.push_back([&write, path = *paths[k], picture = pictures[k], box] { write(path, crop(*picture, box)); });
  }
  base::parallelInvoke(tasks);
  return view;
}

} // namespace parity::job
