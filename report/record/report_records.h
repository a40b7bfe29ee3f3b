// The records of report/: the report itself, its scenes, views and materials, and what differs from run to run.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "report/record/compare_records.h"
#include "report/record/derived.h"
#include "report/report.h"

namespace parity::report {

// A row is a line.
// clang-format off
template <> inline constexpr auto kRecord<FigureChange> = record<FigureChange>(
    "", "",
    hidden(&FigureChange::metric),
    hidden(&FigureChange::before),
    hidden(&FigureChange::now));
template <> struct ByName<FigureChange> {
  static const std::string& keyOf(const FigureChange& change) { return change.metric; }
  static double valueOf(const FigureChange& change) { return change.change(); }
};

template <> inline constexpr auto kRecord<BaselineChange> = record<BaselineChange>(
    "change", "",
    field("new", &BaselineChange::isNew, "The baseline does not have it"),
    shown("verdict", &BaselineChange::before,
          [](const BaselineChange& change) {
            return change.isNew ? std::nullopt : std::optional<compare::Verdict>(change.before);
          },
          "In the baseline; null: new", {.ifEmpty = IfEmpty::null}),
    field("notComparable", &BaselineChange::notComparable,
          "The conditions that differ, in words: there are no changes, and the verdict is at least warn; empty: none "
          "does"),
    field("changes", &BaselineChange::changes, "Now minus then; null: to or from infinite"));

template <> inline constexpr auto kRecord<ImageSet> = record<ImageSet>(
    "images", "Paths relative to the report's folder, '/'-separated; empty: none",
    field("reference", &ImageSet::reference),
    field("test", &ImageSet::test),
    field("flip", &ImageSet::flip));

template <> inline constexpr auto kRecord<TermFigures> = record<TermFigures>(
    "termLight", "Mean scene-referred luminance over the material's pixels",
    field("term", &TermFigures::term),
    field("reference", &TermFigures::reference),
    field("test", &TermFigures::test));

template <> inline constexpr auto kRecord<PixelFiles> = record<PixelFiles>(
    "pixelFiles", "Files of the values behind the pictures, relative to the report's folder; empty: none",
    field("color", &PixelFiles::color,
          "Both paths, FLIP of the whole images, FLIP of each material by the swap, which material is where"),
    field("terms", &PixelFiles::terms, "Both paths' terms"));

template <> inline constexpr auto kRecord<StageResult> = record<StageResult>(
    "stage",
    "What a stage of the test path alone makes of its picture: the reference is that without the stage, the test "
    "that with it, both as displayed. It judges nothing",
    field("stage", &StageResult::stage, "encoding: storing the colour in the target; textures: compressing them"),
    field("through", &StageResult::through, "What the picture passes through there: rgba8-gamma2, astc6x6"),
    field("figures", &StageResult::figures, "null: no pixel, nothing is known", {.ifEmpty = IfEmpty::null}));

template <> inline constexpr auto kRecord<MaterialResult> = record<MaterialResult>(
    "material", "",
    field("name", &MaterialResult::name, "", {.read = true}),
    hidden(&MaterialResult::test),
    field("verdict", &MaterialResult::verdict, "", {.kept = false, .read = true}),
    field("reason", &MaterialResult::reason, "What decided the verdict; empty on a pass", {.kept = false}),
    field("seenElsewhere", &MaterialResult::seenElsewhere,
          "Not seen in this view, or too small, but seen in another one: the row does not count", {.kept = false}),
    computed("bias", [](const MaterialResult& material) { return biasOf(material.figures, material.test); },
             "How the test's light and tint differ, in words; empty without pixels"),
    field("figures", &MaterialResult::figures, "null: no pixel, nothing is known",
          {.read = true, .ifEmpty = IfEmpty::null}),
    field("checks", &MaterialResult::checks, "Empty where the material is not seen", {.kept = false}),
    field("budget", &MaterialResult::rule, "", {.kept = false}),
    field("baseline", &MaterialResult::baseline, "null: there is no baseline",
          {.kept = false, .ifEmpty = IfEmpty::null}),
    field("notModelled", &MaterialResult::notModelled,
          "Parts of it that no path models: only its base layer is judged, which is at least a warning"),
    field("notes", &MaterialResult::notes, "Permutation, sampler excess, tinted F0, ..."),
    field("terms", &MaterialResult::terms),
    field("crops", &MaterialResult::crops),
    field("truth", &MaterialResult::truth),
    field("stages", &MaterialResult::stages),
    field("attribution", &MaterialResult::attribution));

template <> inline constexpr auto kRecord<LightEffect> = record<LightEffect>(
    "lightEffect", "",
    field("name", &LightEffect::material),
    field("flip", &LightEffect::flip,
          "Mean FLIP of the reference's picture without this light against that with all lights",
          {.finite = true, .least = 0, .most = 1}));

template <> inline constexpr auto kRecord<DroppedLight> = record<DroppedLight>(
    "droppedLight", "",
    field("name", &DroppedLight::name),
    field("kind", &DroppedLight::kind, "", {.oneOf = "directional|point|spot"}),
    field("keptBy", &DroppedLight::keptBy, "Objects of the view that the test path shades with it"),
    field("droppedBy", &DroppedLight::droppedBy, "Objects of the view that it reaches and that do without it",
          {.least = 1}),
    field("materials", &DroppedLight::materials, "Of the objects that drop it, the most changed first"));

template <> inline constexpr auto kRecord<DroppedLights> = record<DroppedLights>(
    "droppedLights",
    "Lights that the test path drops from objects that the view shows; absent: none, or not asked for. It judges nothing",
    field("lights", &DroppedLights::lights, "That it could have, dropped or not", {.least = 1}),
    field("measured", &DroppedLights::measured, "The most effect first"),
    field("notMeasured", &DroppedLights::notMeasured,
          "Names of the dropped lights beyond the run's limit (--dropped-lights), the most estimated effect first"));

template <> inline constexpr auto kRecord<ViewResult> = record<ViewResult>(
    "view", "",
    field("name", &ViewResult::name, "", {.read = true}),
    field("reference", &ViewResult::reference, "The path that its figures compare with"),
    field("test", &ViewResult::test, "The path that its figures are of"),
    field("width", &ViewResult::width, "", {.least = 1}),
    field("height", &ViewResult::height, "", {.least = 1}),
    field("conditions", &ViewResult::conditions, "Of the view: its camera", {.kept = false, .read = true}),
    field("verdict", &ViewResult::verdict, "", {.kept = false, .read = true}),
    group("whole", "All pixels of any material",
        field("verdict", &ViewResult::wholeVerdict, "", {.kept = false, .read = true}),
        field("reason", &ViewResult::reason, "What decided the verdict; empty on a pass", {.kept = false}),
        computed("bias", [](const ViewResult& view) { return biasOf(view.whole, view.test); },
                 "How the test's light and tint differ, in words; empty without pixels"),
        field("figures", &ViewResult::whole, "null: no pixel, nothing is known",
              {.read = true, .ifEmpty = IfEmpty::null}),
        field("checks", &ViewResult::checks, "", {.kept = false}),
        field("budget", &ViewResult::rule, "", {.kept = false}),
        field("baseline", &ViewResult::baseline, "null: there is no baseline",
              {.kept = false, .ifEmpty = IfEmpty::null}),
        field("truth", &ViewResult::truth),
        field("stages", &ViewResult::stages)),
    field("materials", &ViewResult::materials, "In the scene's order", {.read = true}),
    field("images", &ViewResult::images),
    field("exposureEv", &ViewResult::exposureEv, "Of its pictures: what the values of 'pixels' are exposed by",
          {.finite = true}),
    field("pixels", &ViewResult::pixels),
    field("droppedLights", &ViewResult::droppedLights));

template <> inline constexpr auto kRecord<PassResult> = record<PassResult>(
    "pass", "",
    field("name", &PassResult::name),
    field("count", &PassResult::count, "Of the unit; what a cache gave counts as done"),
    field("unit", &PassResult::unit),
    field("skipped", &PassResult::skipped, "Why nothing was done; null where count is not 0",
          {.ifEmpty = IfEmpty::null}));

template <> inline constexpr auto kRecord<PermutationCost> = record<PermutationCost>(
    "permutationCost", "A pixel's at most, counted from SPIR-V; only of a run that was asked for it (--costs)",
    field("fp32", &PermutationCost::fp32, "Scalar operations on 32-bit reals"),
    field("fp16", &PermutationCost::fp16, "Scalar operations on 16-bit reals"),
    field("integer", &PermutationCost::integer, "Scalar operations on integers and booleans"),
    field("fetches", &PermutationCost::fetches, "Texture reads"),
    field("openLoops", &PermutationCost::openLoops,
          "Loops whose number of turns is not known: their bodies count once"));

template <> inline constexpr auto kRecord<PermutationResult> = record<PermutationResult>(
    "permutation", "",
    field("path", &PermutationResult::path),
    field("textures", &PermutationResult::textures, "That it reads; 'none'"),
    field("features", &PermutationResult::features, "Of the materials that it is made for; 'none'"),
    field("pixels", &PermutationResult::pixels, "Surface samples that it shaded, over all views"),
    field("samplers", &PermutationResult::samplers,
          "That it binds: its materials' textures, and what else the path reads"),
    field("cost", &PermutationResult::cost));

// Scenes with an error are not kept; the conditions are in the archive's key.
template <> inline constexpr auto kRecord<SceneResult> = record<SceneResult>(
    "scene", "",
    field("name", &SceneResult::name, "", {.read = true}),
    field("source", &SceneResult::source, "The file as it was named, or builtin:NAME"),
    field("environment", &SceneResult::environment, "'none': none", {.read = true}),
    field("sun", &SceneResult::sun, "'none': none", {.read = true}),
    field("light", &SceneResult::light, "Scales of its light and its fog, in words; absent: the defaults",
          {.read = true, .ifEmpty = IfEmpty::absent}),
    field("conditions", &SceneResult::conditions, "Of the scene: its light, what of the file is shown, ...",
          {.kept = false, .read = true}),
    field("verdict", &SceneResult::verdict, "", {.kept = false, .read = true}),
    groupOrNull("error", "The scene could not be compared; the views hold what was done before. null: it was compared",
                [](const SceneResult& scene) { return scene.error.empty(); },
        field("message", &SceneResult::error, "", {.kept = false, .read = true, .filled = true}),
        field("exitCode", &SceneResult::errorExitCode, "", {.kept = false, .least = 3, .most = 4})),
    field("warnings", &SceneResult::warnings),
    field("views", &SceneResult::views, "", {.read = true}),
    field("passes", &SceneResult::passes, "What was done for the scene, over all views, and what was skipped"),
    field("permutations", &SceneResult::permutations,
          "The specialised shaders that made the pictures, by path, in order of their first use"));

template <> inline constexpr auto kRecord<GoneRow> = record<GoneRow>(
    "goneRow", "",
    field("scene", &GoneRow::scene),
    field("view", &GoneRow::view, "Empty: the whole scene is gone"),
    field("material", &GoneRow::material, "Empty: the whole view is gone"));

template <> inline constexpr auto kRecord<BaselineSummary> = record<BaselineSummary>(
    "baseline", "",
    field("source", &BaselineSummary::source, "The file as it was given; without its folder, if that path is absolute"),
    field("version", &BaselineSummary::version, "Of the program that made it"),
    field("device", &BaselineSummary::device),
    field("common", &BaselineSummary::common, "Material views that both show"),
    field("notComparable", &BaselineSummary::notComparable,
          "Material views and whole images that both show, under other conditions; at least a warning"),
    field("gone", &BaselineSummary::gone, "What the baseline has and this run has not; at least a warning"),
    field("error", &BaselineSummary::error, "Why it could not be used (the verdict is 'error'); empty: it was"));

template <> inline constexpr auto kRecord<RunProblem> = record<RunProblem>(
    "problem", "",
    field("verdict", &RunProblem::verdict, "", {.oneOf = "fail|error"}),
    field("reason", &RunProblem::reason),
    hidden(&RunProblem::file),
    hidden(&RunProblem::line));

template <> inline constexpr auto kRecord<VerdictCounts> = record<VerdictCounts>(
    "counts",
    "counts: rows (material x view) by verdict, without those that another view shows; wholeCounts: whole images",
    field("pass", &VerdictCounts::pass),
    field("notSeen", &VerdictCounts::notSeen),
    field("tooSmall", &VerdictCounts::tooSmall),
    field("notJudged", &VerdictCounts::notJudged),
    field("warn", &VerdictCounts::warn),
    field("fail", &VerdictCounts::fail),
    field("error", &VerdictCounts::error));

template <> inline constexpr auto kRecord<FigureWords> = record<FigureWords>(
    "statistic", "",
    field("label", &FigureWords::label, "In a sentence"),
    field("unit", &FigureWords::unit, "%: of a share, which is 0 to 1 in this file"),
    field("digits", &FigureWords::digits, "After the point, where people read it"),
    field("better", &FigureWords::better, "", {.oneOf = "lower|higher|near zero"}));

using Setting = std::pair<std::string, std::string>;
template <> inline constexpr auto kRecord<Setting> = record<Setting>(
    "setting", "",
    field("name", &Setting::first, "", {.read = true}),
    field("value", &Setting::second, "", {.read = true}));

using Timing = std::pair<std::string, double>;
template <> inline constexpr auto kRecord<Timing> = record<Timing>(
    "timing", "",
    field("stage", &Timing::first),
    field("timeMs", &Timing::second));

using Schema = std::integral_constant<int, kReportSchema>;

template <> inline constexpr auto kRecord<Report> = record<Report>(
    "report",
    "How far apart two shading paths look, per material. Equal inputs give a byte-identical file; times and dates are "
    "in run.json. A number that is null is infinite (psnr of identical images) or not a number (the verdict is then "
    "'error').",
    computed("schema", [](const Report&) { return Schema(); }, "Version of this format"),
    field("tool", &Report::tool),
    field("version", &Report::version, "", {.read = true}),
    field("device", &Report::device, "Vulkan device name and driver", {.read = true}),
    field("verdict", &Report::verdict, "", {.read = true}),
    computed("headline", [](const Report& report) { return headline(report); }, "The whole report in a sentence"),
    computed("counts", [](const Report& report) { return countVerdicts(report); }),
    computed("wholeCounts", [](const Report& report) { return countWholes(report); }),
    field("displayTable", &Report::displayTable,
          "File of the display transform as a table, relative to the report's folder; empty: none"),
    shown("problems", &Report::lost, [](const Report& report) { return problemsOf(report); },
          "Why the run as a whole is no pass: no material was compared, or none is where a budget requires one"),
    field("warnings", &Report::warnings, "Of the whole run"),
    field("baseline", &Report::baseline, "The earlier report that this run was held against",
          {.ifEmpty = IfEmpty::null}),
    field("settings", &Report::settings, "What the run was asked for, in a fixed order", {.read = true}),
    field("conditions", &Report::conditions, "Of every scene; the device is one more", {.read = true}),
    computed("statistics", [](const Report& report) { return figureWordsOf(report); },
             "How to read each figure of 'metrics' and 'checks', by its name"),
    field("scenes", &Report::scenes, "", {.read = true}));

template <> inline constexpr auto kRecord<RunInfo> = record<RunInfo>(
    "run", "What differs from run to run, kept out of the report",
    computed("schema", [](const RunInfo&) { return Schema(); }),
    field("startedAt", &RunInfo::startedAt, "ISO 8601, UTC"),
    field("commandLine", &RunInfo::commandLine),
    field("timings", &RunInfo::timings),
    field("compiledShaders", &RunInfo::compiledShaders, "Of all paths, the same one once"),
    field("cachedScenes", &RunInfo::cachedScenes, "Whose results were taken from the cache, unchanged"));

// clang-format on
} // namespace parity::report
