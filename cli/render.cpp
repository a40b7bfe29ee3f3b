// parity render: one scene by one path, with its terms or one intermediate on request.
#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image_io.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/requests.h"
#include "compare/metrics.h"
#include "job/displayed.h"
#include "job/material_choice.h"
#include "job/scene_renderer.h"
#include "scenes/view.h"
#include "shading/terms.h"

namespace parity::cli {

namespace {

// Colour as R, G, B and each term as a layer: sunDiffuse.R and so on.
base::Image layers(const base::Frame& frame, std::vector<std::string>& names) {
  base::Image out(frame.color.width, frame.color.height, static_cast<int>(3 * (1 + frame.terms.size())));
  names = {"R", "G", "B"};
  for (const std::string_view term : shading::kTermNames)
    for (const char* channel : {".R", ".G", ".B"}) names.push_back(std::string(term) + channel);
  for (std::size_t p = 0; p < frame.color.pixelCount(); ++p) {
    float* pixel = out.pixels.data() + p * out.channels;
    std::copy_n(frame.color.pixels.data() + 3 * p, 3, pixel);
    for (std::size_t t = 0; t < frame.terms.size(); ++t)
      std::copy_n(frame.terms[t].pixels.data() + 3 * p, 3, pixel + 3 * (t + 1));
  }
  return out;
}

// How well the wanted error was met, in a line.
void reportError(const job::ViewFrames& frames, double wanted) {
  std::vector<float> errors;
  for (const float error : frames.referenceError.pixels)
    if (error > 0) errors.push_back(error);
  if (errors.empty()) return; // all is in closed form
  std::sort(errors.begin(), errors.end());
  const auto over = errors.end() - std::upper_bound(errors.begin(), errors.end(), static_cast<float>(wanted));
  const std::string text = fmt::format(
      "reference: standard error {:.3g} % in the median, {:.3g} % at worst; {:.0f} samples a pixel in each way",
      100 * errors[errors.size() / 2], 100 * errors.back(), frames.referenceSamples);
  base::logInfo(text);
  if (over > 0)
    base::logWarning(fmt::format("reference: {} of {} pixels did not reach a standard error of {:.3g} %", over,
                                 errors.size(), 100 * wanted));
}

// The settings that the command asks for: a term needs all of them, an intermediate is what the shader writes.
job::Settings settingsOf(const RenderCommand& command) {
  job::Settings settings = command.common.settings;
  settings.coverage = !settings.materials.empty();
  if (command.term.empty()) return settings;
  settings.background = glm::vec3(0);
  if (shading::termByName(command.term)) {
    settings.terms = true;
    return settings;
  }
  const auto mobileView = mobile::viewByName(command.term), highendView = highend::viewByName(command.term);
  if (command.path == "mobile" && mobileView)
    settings.mobileView = *mobileView;
  else if (command.path == "highend" && highendView)
    settings.highendView = *highendView;
  else
    throw base::Error(base::ExitCode::usage, "--term", command.term,
                      fmt::format("is an intermediate of the {} path; the path '{}' has none of that name "
                                  "(--list-terms)",
                                  mobileView && highendView ? "mobile and the highend"
                                  : mobileView              ? "mobile"
                                                            : "highend",
                                  command.path));
  return settings;
}

} // namespace

std::vector<std::string> termNames() {
  std::vector<std::string> names(shading::kTermNames.begin(), shading::kTermNames.end());
  for (const mobile::View& view : mobile::kViews) names.emplace_back(view.name);
  for (const highend::View& view : highend::kViews)
    if (std::find(names.begin(), names.end(), view.name) == names.end()) names.emplace_back(view.name);
  return names;
}

int runListTermsCommand() {
  print("Terms, of every path:\n");
  for (const std::string_view name : shading::kTermNames) print("  {}\n", name);
  print("Intermediates of the mobile base pass (--path mobile):\n");
  for (const mobile::View& view : mobile::kViews) print("  {:<20} {}\n", view.name, view.meaning);
  print("Intermediates of the high-end path (--path highend):\n");
  for (const highend::View& view : highend::kViews) print("  {:<20} {}\n", view.name, view.meaning);
  return 0;
}

int runRenderCommand(const RenderCommand& command) {
  const job::Settings settings = settingsOf(command);
  const std::string extension = extensionOf(command.output);
  const bool layered = settings.terms && command.term.empty();
  if (command.common.settings.terms && !command.term.empty())
    throw base::Error(base::ExitCode::usage, "--term", command.term, "excludes --terms");
  if (settings.mobileView != mobile::kViewLit && settings.mobileTarget != job::Settings().mobileTarget)
    throw base::Error(base::ExitCode::usage, "--mobile-target", command.term,
                      "an intermediate is written as it was computed: no target stores it");
  if (layered && extension != ".exr")
    throw base::Error(base::ExitCode::usage, "--terms", command.output, "layers need an .exr file");
  if (command.common.settings.reference.bounces > 0 && command.path != "reference")
    throw base::Error(base::ExitCode::usage, "--interreflection", command.path,
                      "only the reference has light between surfaces");
  if (!command.errorMap.empty() && command.path != "reference")
    throw base::Error(base::ExitCode::usage, "--error-map", command.path, "only the reference has an error");

  const job::SceneRequest request = sceneRequest(command.common, command.scene);
  requireSeparate({{"-o", command.output}, {"--error-map", command.errorMap}}, inputFiles(command.common, {request}));
  const base::ThreadLimit threads(command.common.threads);
  job::Context context(settings);
  const bool highend = command.path == "highend", reference = command.path == "reference";
  const job::Paths paths{.highend = highend, .mobile = !highend && !reference, .reference = reference};
  job::PreparedScene prepared = job::prepareScene(context, request, paths);
  for (const std::string& warning : prepared.scene.warnings) base::logWarning(warning);
  job::requireMaterials(prepared.scene, settings.materials);
  job::SceneRenderer renderer(context, prepared, paths, 1, {}, job::imageRelease(prepared, paths));
  for (const std::string& note : renderer.notes()) base::logWarning("mobile: " + note);
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  job::ViewFrames frames = renderer.render(scenes::makeCamera(prepared.scene, request.views.front(), aspect),
                                           makeProgress(command.common.quiet));
  for (const std::string& warning : renderer.warnings()) base::logWarning(warning);
  base::Frame& frame = highend ? frames.highend : reference ? frames.reference : frames.mobile;
  job::keepMaterials(frame, prepared.scene, settings.materials, frames.coverage, settings.background);
  const auto term = command.term.empty() ? std::nullopt : shading::termByName(command.term);
  const base::Image& color = term ? frame.terms[static_cast<std::size_t>(*term)] : frame.color;
  if (reference) reportError(frames, settings.reference.integral.relativeError);
  if (!command.errorMap.empty()) base::writeImage(command.errorMap, frames.referenceError);

  if (const compare::NonFinite bad = compare::countNonFinite(color); bad.count > 0)
    base::logWarning(fmt::format("{} of {} pixels are NaN or infinite, the first at x {}, y {}", bad.count,
                                 color.pixelCount(), bad.x, bad.y));
  if (extension == ".png") {
    base::writeImage8(command.output, job::displayImage(color, context.display(), settings.exposureEv).pixels);
  } else if (layered) {
    base::WriteOptions options;
    const base::Image image = layers(frame, options.channelNames);
    base::writeImage(command.output, image, options);
  } else {
    base::writeImage(command.output, color);
  }
  if (command.common.timings) printTimings(context.timings().stages());
  return 0;
}

} // namespace parity::cli
