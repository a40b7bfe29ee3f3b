// parity render: one scene by one path, with its terms or one intermediate on request.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>
#include <thread>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/image/image_io.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "compare/metrics/metrics.h"
#include "job/knobs.h"
#include "job/scene/material_choice.h"
#include "job/scene/material_ids.h"
#include "job/scene/passes.h"
#include "job/scene/scene_renderer.h"
#include "job/view/displayed.h"
#include "paths/preset/preset_folder.h"
#include "report/term_words.h"
#include "scenes/view.h"
#include "shading/terms.h"

namespace parity::cli {

namespace {

// Colour as R, G, B and each term as a layer: sunDiffuse.R and so on.
base::Image layers(const base::Frame& frame, std::vector<std::string>& names) {
  base::Image out(frame.color.width, frame.color.height, static_cast<int>(3 * (1 + frame.terms.size())));
  names = {"R", "G", "B"};
  for (std::size_t t = 0; t < frame.terms.size(); ++t)
    for (const char* channel : {".R", ".G", ".B"}) names.push_back(std::string(shading::kTermNames[t]) + channel);
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
  for (const float error : frames.truthError.pixels)
    if (error > 0) errors.push_back(error);
  if (errors.empty()) return; // all is in closed form
  std::sort(errors.begin(), errors.end());
  const auto over = errors.end() - std::upper_bound(errors.begin(), errors.end(), static_cast<float>(wanted));
  const std::string text = fmt::format(
      "truth: standard error: median {:.3g} %, worst {:.3g} %; {:.0f} samples a pixel for each sampling strategy",
      100 * errors[errors.size() / 2], 100 * errors.back(), frames.truthSamples);
  base::logInfo(text);
  if (over > 0)
    base::logWarning(fmt::format("truth: {} of {} pixels did not reach a standard error of {:.3g} %", over,
                                 errors.size(), 100 * wanted));
}

constexpr const char* kTruth = "truth"; // the path of that name

// What is shaded: the path, by an intermediate where that is asked for.
job::PathChoice choiceOf(const RenderCommand& command) {
  job::PathChoice choice{.chosen = {}, .truth = command.path == kTruth};
  if (!choice.truth) choice.chosen = {&job::pathByName(command.path)};
  if (command.term.empty() || shading::termByName(command.term)) return choice;
  if (!choice.truth)
    if (const auto intermediate = paths::placeOf(choice.chosen.front()->intermediates(), command.term)) {
      choice.intermediate = *intermediate;
      return choice;
    }
  std::vector<std::string> owners;
  for (const paths::Path* path : job::allPaths())
    if (paths::placeOf(path->intermediates(), command.term)) owners.push_back(path->name());
  throw base::Error(base::ExitCode::usage, "--term", command.term,
                    fmt::format("is an intermediate of the path {}; the path '{}' does not have it (--list-terms)",
                                fmt::join(owners, " and "), command.path));
}

// The settings that the command asks for: a term needs all of them, an intermediate is what the shader writes.
job::Settings settingsOf(const RenderCommand& command) {
  job::Settings settings = command.common.settings;
  settings.coverage = !settings.materials.empty() || !command.ids.empty();
  if (command.term.empty()) return settings;
  settings.background = glm::vec3(0);
  settings.terms = shading::termByName(command.term).has_value();
  return settings;
}

// The preset folders of these settings, as their users named them.
std::vector<std::string> presetFolders(const job::Settings& settings) {
  std::vector<std::string> folders;
  for (const paths::Path* path : job::allPaths()) {
    const std::string knob = path->folderKnob();
    if (knob.empty()) continue;
    const std::string text = path->knobs().find(knob)->text(settings.options);
    for (const auto& folder : paths::readPresetFolders(path->name()))
      if (folder->text() == text) folders.push_back(folder->folder());
  }
  return folders;
}

// The folders as they are now. What else was prepared stays, unless the paths need the light in another form.
void readAgain(const RenderCommand& command, job::Context& context, job::PreparedScene& prepared,
               job::SceneRequest& request, const job::PathChoice& paths) {
  paths::forgetPresetFolders();
  RenderCommand now = command;
  now.common.settings = job::withKnobs(command.common.settings, command.common.given);
  job::Settings settings = settingsOf(now);
  bool isSame = true;
  for (const paths::Path* path : paths.chosen)
    isSame = isSame && path->lightNeeds(settings.options) == path->lightNeeds(prepared.settings.options) &&
             path->textureBlock(settings.options) == path->textureBlock(prepared.settings.options);
  request.settings = settings;
  if (isSame)
    prepared.settings.options = settings.options;
  else
    prepared = job::prepareScene(context, request, paths);
}

// What cannot be combined.
void requireSense(const RenderCommand& command, const job::Settings& settings, const job::PathChoice& paths) {
  const std::string extension = extensionOf(command.output);
  const bool layered = settings.terms && command.term.empty();
  if (command.common.settings.terms && !command.term.empty())
    throw base::Error(base::ExitCode::usage, "--term", command.term, "cannot be combined with --terms");
  if (paths.intermediate != 0)
    if (const paths::Path& path = *paths.chosen.front();
        path.targetName(settings.options) != path.targetName(paths::Options()))
      throw base::Error(
          base::ExitCode::usage, fmt::format("--{}-target", path.name()), command.term,
          "an intermediate is written as computed, so a render target has no effect on it; omit one of them");
  if (layered && extension != ".exr")
    throw base::Error(base::ExitCode::usage, "--terms", command.output, "terms are layers, which need an .exr file");
  if (command.common.settings.reference.bounces > 0 && !paths.truth)
    throw base::Error(base::ExitCode::usage, "--interreflection", command.path,
                      "only --path truth has light between surfaces");
  if (!command.errorMap.empty() && !paths.truth)
    throw base::Error(base::ExitCode::usage, "--error-map", command.path, "only --path truth has an error map");

  if (command.watches && presetFolders(settings).empty())
    throw base::Error(base::ExitCode::usage, "--watch", "", "there is no preset folder to watch");
}

// One picture, and what goes with it.
void draw(const RenderCommand& command, job::Context& context, job::PreparedScene& prepared,
          const job::SceneRequest& request, const job::PathChoice& paths) {
  const job::Settings& settings = request.settings;
  const std::string extension = extensionOf(command.output);
  const bool layered = settings.terms && command.term.empty();
  job::SceneRenderer renderer(context, prepared, prepared.settings, paths, 1, {},
                              command.watches ? gpu::ImageDone() : job::imageRelease(prepared, paths));
  for (const std::string& note : renderer.notes()) base::logWarning(note);
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  job::ViewFrames frames = renderer.render(scenes::makeCamera(prepared.scene, request.views.front(), aspect),
                                           makeProgress(command.common.quiet));
  for (const std::string& warning : renderer.warnings()) base::logWarning(warning);
  for (const report::PassResult& pass : job::describePasses(renderer.work(), renderer.reasons()))
    if (pass.count > 0) base::logDetail(job::lineOf(pass));
  base::Frame& frame = paths.truth ? frames.truth : frames.paths.front().frame;
  job::keepMaterials(frame, prepared.scene, settings.materials, frames.coverage, settings.background);
  const auto term = command.term.empty() ? std::nullopt : shading::termByName(command.term);
  const base::Image black(frame.color.width, frame.color.height, 3); // a scene without coat has no light of it
  const auto place = static_cast<std::size_t>(term.value_or(shading::Term::sunDiffuse));
  const base::Image& color = !term ? frame.color : place < frame.terms.size() ? frame.terms[place] : black;
  if (paths.truth) reportError(frames, settings.reference.integral.relativeError);
  if (!command.errorMap.empty()) base::writeImage(command.errorMap, frames.truthError);
  if (!command.ids.empty()) job::writeMaterialIds(command.ids, frames.coverage, settings.width, settings.height);

  if (const compare::NonFinite bad = compare::countNonFinite(color); bad.count > 0)
    base::logWarning(fmt::format("{} of {} pixels are NaN or infinite; the first is at x {}, y {}", bad.count,
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
}

// Names, sizes and times of the folders' files.
using FolderState = std::set<std::tuple<std::string, std::uintmax_t, std::filesystem::file_time_type>>;

FolderState stateOf(const std::vector<std::string>& folders) {
  FolderState state;
  for (const std::string& folder : folders) {
    std::error_code error, none;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
      state.emplace(entry->path().string(), entry->file_size(none), entry->last_write_time(none));
  }
  return state;
}

// The picture again at each change of the folders. What is wrong with one is said, and the next change is waited for.
int watch(const RenderCommand& command, job::Context& context, job::PreparedScene& prepared, job::SceneRequest& request,
          const job::PathChoice& paths) {
  constexpr auto kPause = std::chrono::milliseconds(20);
  const std::vector<std::string> folders = presetFolders(request.settings);
  const base::StopSignal stop;
  base::logInfo(fmt::format("watching {}; Ctrl-C ends", fmt::join(folders, " and ")));
  bool isFirst = true;
  for (FolderState seen; base::StopSignal::received() == 0;) {
    if (FolderState state = stateOf(folders); state != seen) {
      seen = std::move(state);
      const base::Stopwatch time(nullptr, "picture");
      try {
        if (!isFirst) readAgain(command, context, prepared, request, paths);
        isFirst = false;
        draw(command, context, prepared, request, paths);
        print("{}: {:.2f} s\n", command.output, time.elapsedMs() * 1e-3);
        finishStdout();
      } catch (const base::Error& error) {
        base::logError(error.what());
      }
    }
    std::this_thread::sleep_for(kPause);
  }
  return 0;
}

} // namespace

std::vector<std::string> termNames() {
  std::vector<std::string> names(shading::kTermNames.begin(), shading::kTermNames.end());
  for (const paths::Path* path : job::allPaths())
    for (const paths::Intermediate& each : path->intermediates())
      if (std::ranges::count(names, each.name) == 0) names.emplace_back(each.name);
  return names;
}

int runListTermsCommand() {
  print("Terms of light, in every path:\n");
  for (const auto& [term, words] : report::kTermWords) print("  {:<20} {}\n", term, words);
  for (const paths::Path* path : job::allPaths()) {
    print("Intermediates of the {} path (--path {}):\n", path->title(), path->name());
    for (const paths::Intermediate& each : path->intermediates()) print("  {:<20} {}\n", each.name, each.meaning);
  }
  return 0;
}

int runRenderCommand(const RenderCommand& command) {
  const job::Settings settings = settingsOf(command);
  const job::PathChoice paths = choiceOf(command);
  requireSense(command, settings, paths);
  job::SceneRequest request = sceneRequest(command.common, command.scene);
  request.settings = settings;
  requireSeparate({{"-o", command.output}, {"--error-map", command.errorMap}, {"--ids", command.ids}},
                  inputFiles(command.common, {request}));
  const base::ThreadLimit threads(command.common.threads);
  job::Context context(settings);
  job::PreparedScene prepared = job::prepareScene(context, request, paths);
  for (const std::string& warning : prepared.scene.warnings) base::logWarning(warning);
  job::requireMaterials(prepared.scene, settings.materials);
  if (command.watches) return watch(command, context, prepared, request, paths);
  draw(command, context, prepared, request, paths);
  if (command.common.timings) printTimings(context.timings().stages());
  return 0;
}

} // namespace parity::cli
