// report.json and run.json. Made of report/record/*_records.h by build/describe_report: not to be edited.

/** The form of report.json that is described here. */
export const kSchema = 4;

/** The terms of a path's light in words (report/term_words.h). */
export const kTermWords: Readonly<Record<string, string>> = {
  sunDiffuse: "diffuse light of the sun",
  sunSpecular: "highlights of the sun",
  localDiffuse: "diffuse light of local lights",
  localSpecular: "highlights of local lights",
  lightmap: "light of the lightmap",
  skyDiffuse: "diffuse light of the environment",
  skySpecular: "reflections of the environment",
  emissive: "emitted light",
  fog: "light of the fog",
  coatSpecular: "reflections and highlights of the clear coat",
  sheen: "light of the sheen",
  transmission: "light through the surface",
};

/** Visible difference of two shading paths, per material. Equal inputs give a byte-identical file; times and dates are in run.json. null in place of a number means infinite (psnr of identical images) or not a number (then the verdict is 'error'). */
export interface Report {
  schema: number; // Version of this format
  tool: string;
  version: string;
  suite: string; // Name of the suite; empty: the run had none
  device: string; // Vulkan device name and driver
  verdict: Verdict;
  headline: string; // The whole report in a sentence
  counts: Counts;
  wholeCounts: Counts;
  displayTable: string; // File of the display transform as a table, relative to the report's folder; empty: none
  problems: Problem[]; // Reasons why the whole run does not pass: no material was compared, or a material that a budget requires is missing
  warnings: string[]; // Warnings about the whole run
  baseline: Baseline | null; // The earlier report that this run was compared with
  approvals?: Approvals; // The approvals that the run was judged by (--approvals); absent: it had none
  only?: string[]; // Globs of the views that were asked for (--only); absent: all
  settings: Setting[]; // Settings of the run, in a fixed order
  conditions: Condition[]; // Conditions of every scene; the device is one more condition
  digests: RunDigests;
  statistics: Record<string, Statistic>; // Label, unit and digits of each figure in 'metrics' and 'checks', by its name
  scenes: Scene[];
}

/** In order of severity; a whole has the worst verdict of its parts */
export type Verdict = "pass" | "not seen" | "too small" | "not judged" | "warn" | "fail" | "not run" | "error";

/** counts: rows (material x view) by verdict, without materials that only another view shows; wholeCounts: whole images */
export interface Counts {
  pass: number;
  notSeen: number;
  tooSmall: number;
  notJudged: number;
  warn: number;
  fail: number;
  error: number;
}

export interface Problem {
  verdict: "fail" | "error";
  reason: string;
}

export interface Baseline {
  source: string; // The file as given; without its folder if the path is absolute
  version: string; // Version of the program that made it
  device: string;
  common: number; // Number of material views in both reports
  notComparable: number; // Number of material views and whole images in both reports with different conditions; at least a warning
  gone: GoneRow[]; // Rows of the baseline that this run does not have; at least a warning
  error: string; // Reason why it could not be used (then the verdict is 'error'); empty: it was used
  notWhole?: string; // Why nobody can tell by it which failures are new: it is of a part of the scenes, or lacks results; absent: it is whole
}

export interface GoneRow {
  scene: string;
  view: string; // Empty: the whole scene is gone
  material: string; // Empty: the whole view is gone
}

export interface Approvals {
  source: string; // The file as given; without its folder if the path is absolute
  asOf: string; // The day of the run for approvals, ISO 8601
  entries: number;
}

export interface Setting {
  name: string;
  value: string;
}

/** A condition, besides the scene's files, that decides figures: a baseline with other conditions is not comparable */
export interface Condition {
  name: string;
  value: string; // With full precision; a file counts by its content
  actsOn: "figures" | "whole images" | "truth"; // The figures that it decides: all except those against the truth, only those of whole images, or only those against the truth
  words?: string; // The value in words; absent: the same as the value
}

/** What decides the figures and verdicts of every scene: digests, in hexadecimal digits */
export interface RunDigests {
  settings: string; // Of scenes that have no settings of their own
  budgets: string; // Of the text of the budget files; empty: the built-in ones
}

export interface Statistic {
  label: string; // Name in a sentence
  unit: string; // %: a share, which is 0 to 1 in this file
  digits: number; // Digits after the point for display
  better: "lower" | "higher" | "near zero";
}

export interface Scene {
  name: string;
  source: string; // The file as named in the command or suite, or builtin:NAME
  environment: string; // Name, or 'none'
  sun: string; // In words, or 'none'
  light?: string; // Scales of light, and fog, in words; absent: the defaults
  conditions: Condition[]; // Conditions of the scene: its light, the shown part of the file, ...
  inputs?: SceneInputs; // Absent: the scene's files could not be read
  verdict: Verdict;
  /** Reason why the scene could not be compared; the views hold the part done before. null: it was compared */
  error: {
    message: string;
    exitCode: number; // 128 and more: a signal ended the run before the scene was done
  } | null;
  warnings: string[];
  materials?: MaterialCard[]; // What its materials are made of; absent: not known
  views: View[];
  passes: Pass[]; // Work done for the scene in all views, and skipped work
  permutations: Permutation[]; // The specialised shaders of the pictures, by path, in order of their first use
}

/** What decides the figures besides the settings of the run, as digests of 12 hexadecimal digits: equal content, equal digest */
export interface SceneInputs {
  asset: string; // The scene's file, its buffers and its images
  environment: string; // Empty: none
  request: string; // What is asked of the scene otherwise than of the run, and its views
  bake: string; // Its baked light; empty: none
  pictures?: string; // Pictures of other engines; absent: none
}

/** What a material is made of */
export interface MaterialCard {
  name: string;
  inputs: CardInput[]; // Base colour, metallic and roughness; other inputs only if they differ from glTF's default
  alphaMode: "opaque" | "mask" | "blend";
  alphaCutoff?: number; // Only of a mask
  doubleSided: boolean;
  unlit: boolean;
  nonmetal: boolean; // Found: metallic is 0 everywhere and F0 is 0.04
  fullyRough: boolean; // As requested
  vertexColors: boolean; // Colours of vertices multiply base colour and opacity
  f0: number[]; // Reflectance at normal incidence of a dielectric, before textures
  notModelled: string[]; // Parts that no path models
}

export interface CardInput {
  name: "baseColor" | "opacity" | "metallic" | "roughness" | "normal" | "occlusion" | "emissive" | "specular" | "specularColor" | "coat" | "coatRoughness" | "coatNormal" | "sheenColor" | "sheenRoughness" | "anisotropy" | "anisotropyRotation" | "iridescence" | "iridescenceIor" | "iridescenceThickness" | "transmission" | "diffuseTransmission" | "diffuseTransmissionColor" | "ior" | "thickness" | "attenuationColor" | "attenuationDistance" | "dispersion";
  value: number[]; // Linear colour or number; the factor if there is a texture
  texture?: CardTexture; // absent: none
}

/** Texture of an input. least, most and mean: of each channel over the texels, times the factor, colours linear; empty: not decoded, or a normal map */
export interface CardTexture {
  name: string;
  file: string; // Empty: within the scene's own file, or made by the program
  channels: "rgb" | "r" | "g" | "b" | "a"; // Channels that the input reads
  width: number; // 0: not decoded, because no mesh shows the material
  height: number;
  texCoord: number; // Number of the set of texture coordinates
  picture: string; // A small picture of these channels, relative to the report's folder; empty: none
  least: number[];
  most: number[];
  mean: number[];
}

export interface View {
  name: string;
  reference: string; // The reference path of the figures
  test: string; // The test path of the figures
  width: number;
  height: number;
  conditions: Condition[]; // Conditions of the view: its camera
  verdict: Verdict;
  /** All pixels that show a material */
  whole: {
    verdict: Verdict;
    reason: string; // Reason of the verdict; empty for a pass
    accepted?: string; // What its budget or an approval accepts although it is no pass, with the reason; absent: nothing
    bias: string; // Difference of light and tint in words; empty without pixels
    figures: Figures | null; // null: no pixel
    checks: Check[];
    budget: Rule;
    baseline: Change | null; // null: there is no baseline
    truth?: Truth;
    stages: Stage[];
  };
  materials: Material[]; // In the order of the scene
  images: Images;
  exposureEv: number; // Exposure of the pictures; apply it to the values of 'pixels'
  pixels: PixelFiles;
  droppedLights?: DroppedLights;
}

export interface Figures {
  pixels: number;
  nonFinite: number; // Pixels where either render is NaN or infinite
  metrics: Record<string, number | null>; // By the name of the figure: flip.mean, flip.fraction_over(0.1), psnr, bias.ev, ... (compare/pooling/statistic.h)
  clippedBlack: number | null; // Share of pixels that are black in both displayed images, so that they show no difference
  clippedWhite: number | null; // Share of pixels that are white in both displayed images, so that they show no difference
  referenceLuma: number | null; // Mean Rec.709 luma of the displayed reference
  testLuma: number | null; // The same for the test
  referenceLuminance: number | null; // Mean linear luminance of the reference as exposed, before clipping; 1 is white
  testLuminance: number | null; // The same for the test
}

export interface Check {
  metric: string; // A name in 'metrics'
  regress: boolean; // true: the value is not the figure, but its loss against the baseline
  value: number | null; // null: infinite, not a number, or unknown
  warn: number | null; // Limit of the verdict warn: an upper limit, or a lower limit if more is better (psnr, ssim); of the absolute value if the figure has a sign; null: no limit
  fail: number | null; // Limit of the verdict fail: an upper limit, or a lower limit if more is better (psnr, ssim); of the absolute value if the figure has a sign; null: no limit
  verdict: "pass" | "warn" | "fail" | "error" | "not judged"; // not judged: a regression whose baseline has no counterpart, or has other conditions; a figure of accepted NaN; an exposure of two pictures too dark to measure it
  note: string;
  approval?: Approval; // absent: none
}

/** An approval of the figure, as it stands on the day 'asOf' of the report */
export interface Approval {
  origin: string; // Place of the entry
  state: "holds" | "loose" | "expired" | "lapsed"; // holds: it covers the figure; loose and expired: the same with a warning; lapsed: it does not
  value: number; // The figure that was approved
  slack: number; // How much worse the figure may be
  until: string; // The last day on which it holds, ISO 8601
  daysLeft: number; // Until that day; negative: days since
  owner: string;
  reason: string;
  words: string; // Why it warns or does not hold; empty: it holds
}

/** The budget rule that judged it */
export interface Rule {
  rule: string; // Place of the rule; empty: no rule matched
  preset: string; // Preset whose limits it uses; empty: it has its own limits
  reason: string;
  owner: string;
  requireSeen: boolean;
  minPixels: number; // A material with fewer pixels is too small to be judged
  accept?: Accept[]; // What the rule accepts for its reason; absent: nothing
  maxNonFinite?: number; // The most NaN or infinite pixels in a view that the rule accepts; absent: none
}

/** What a budget accepts although it is no pass */
export type Accept = "not seen" | "too small" | "not judged" | "clipped" | "base layer only" | "non-finite" | "no limit";

export interface Change {
  new: boolean; // The baseline does not have it
  verdict: Verdict | null; // Verdict in the baseline; null: new
  notComparable: string; // The conditions that differ, in words; then there are no changes and the verdict is at least warn; empty: no condition differs
  changes: Record<string, number | null>; // Figure of this run minus figure of the baseline; null: from or to infinite
  images?: BaselineImages; // absent: no picture of it changed, or the baseline has none
}

/** Copies of the baseline's pictures that are not as in this run, relative to the report's folder; empty: as in this run, or the baseline has none of this size */
export interface BaselineImages {
  reference: string;
  test: string;
}

/** Both paths against the ground truth; only with --truth. It does not change verdicts */
export interface Truth {
  figures: TruthFigures | null; // null: no pixel
  terms: TruthTerm[]; // Without terms that are black in the truth and in both paths
  notes: string[]; // Cautions about these figures
  images: TruthImages;
}

export interface TruthFigures {
  nonFinite: number; // Pixels where the truth itself is NaN or infinite; the verdict then is 'error'
  reference: Figures; // Figures of the reference against the truth
  test: Figures; // Figures of the test against the truth
  error: TruthError;
}

/** Error of the truth; null: unknown */
export interface TruthError {
  median: number | null; // Median of the relative standard errors of the pixels
  worst: number | null; // Largest relative standard error of a pixel
  relmse: number | null; // Approximate relmse from this error alone; every relmse against the truth includes it
  samples: number | null; // Mean number of environment samples for each pixel and sampling strategy; 0: all in closed form
}

export interface TruthTerm {
  term: string;
  /** Mean scene-referred luminance */
  luminance: {
    truth: number | null;
    reference: number | null;
    test: number | null;
  };
  /** Figures of the term alone against the same term of the truth, displayed like the colour, by name; null: no pixel */
  figures: {
    reference: Record<string, number | null>;
    test: Record<string, number | null>;
  } | null;
}

/** Paths relative to the report's folder, '/'-separated; empty: none */
export interface TruthImages {
  truth: string;
  referenceFlip: string; // FLIP of the view's reference against the truth
  testFlip: string; // FLIP of the view's test against the truth
}

/** Change that one stage of the test path alone causes in its picture: the reference is the displayed picture without the stage, the test is the displayed picture with it. It does not change verdicts */
export interface Stage {
  stage: string; // encoding: storing the colour in the target; textures: compressing them
  through: string; // Format of the stage: rgba8-gamma2, astc6x6
  figures: Figures | null; // null: no pixel
}

export interface Material {
  name: string;
  verdict: Verdict;
  reason: string; // Reason of the verdict; empty for a pass
  accepted?: string; // What its budget or an approval accepts although it is no pass, with the reason; absent: nothing
  seenElsewhere: boolean; // Not seen or too small in this view, but seen in another view; the row does not count
  bias: string; // Difference of light and tint in words; empty without pixels
  figures: Figures | null; // null: no pixel
  checks: Check[]; // Empty if the material is not seen
  budget: Rule;
  baseline: Change | null; // null: there is no baseline
  notModelled: string[]; // Parts that no path models; then only the base layer is judged, and the verdict is at least warn
  notes: string[]; // Permutation, sampler excess, tinted F0, ...
  external?: boolean; // A picture of another engine takes part, so no terms and no cause are known; absent: no
  terms: TermLight[];
  crops: Images;
  truth?: Truth;
  stages: Stage[];
  droppedLobes?: DroppedLobe[]; // Lobes of the material that the test path leaves out; absent: none, or not requested (--dropped-lights 0)
  whatIf?: WhatIf[]; // Only with --what-if
  explanation?: Explanation; // Only of materials over budget, with --explain over-budget
  attribution?: Attribution;
}

/** Mean scene-referred luminance over the material's pixels */
export interface TermLight {
  term: string;
  reference: number | null;
  test: number | null;
}

/** Paths relative to the report's folder, '/'-separated; empty: none */
export interface Images {
  reference: string;
  test: string;
  flip: string;
}

export interface DroppedLobe {
  lobe: "clear coat" | "sheen" | "anisotropy" | "iridescence" | "transmission" | "diffuse transmission";
  flip: number; // Mean FLIP of the reference's picture without this lobe of the material against its picture with it
}

/** What the figures and the verdict of a material would be with another preset of the test path */
export interface WhatIf {
  preset: string;
  words: string; // All of it in a sentence
  verdict: Verdict;
  reason: string; // Reason of the verdict; empty for a pass
  figures: Figures;
}

/** Approximations of the test path that make the material differ, and what would help */
export interface Explanation {
  words: string; // The largest approximation and the advice, in a line
  failure?: string; // Reason why there is no explanation; absent: there is one
  advice: string[]; // Sentences; what they say was rendered
  approximations: ApproximationEffect[]; // The largest share first
  sets: ExplainedSet[]; // The best set of each size, that of no change first
  advised: number; // Place in 'sets'; 0: none
  picture: string; // Crop of the test picture with the advised set, relative to the report's folder; empty: none
  ranges: ErrorRange[]; // Tenths of each quantity that hold pixels
  masks: ErrorMask[];
}

export interface ApproximationEffect {
  approximation: string; // Approximation of the test path
  change: string; // Change to a nearer form: sky-sh=9
  alone: number; // Mean FLIP that the change takes off by itself
  share: number; // The same, averaged over all orders of the changes (Shapley value)
}

/** Changes of the test path, made together */
export interface ExplainedSet {
  changes: string[]; // Empty: none
  flip: number; // Mean FLIP of the material
  operations: number; // Scalar operations of a pixel
  fetches: number; // Texture fetches of a pixel
}

export interface ErrorRange {
  quantity: "roughness" | "metallic" | "N.V";
  from: number;
  to: number;
  pixels: number; // Share of the material's pixels
  flip: number; // Share of the material's FLIP
}

/** Where on a texture half of the material's FLIP lies */
export interface ErrorMask {
  input: string; // Input of the material's card, whose texture the picture covers
  picture: string; // Relative to the report's folder; transparent where the other half lies
  texels: number; // Share of the seen texels that hold this half
}

/** The term that makes the material differ; only for materials over budget, or as --attribution requests */
export interface Attribution {
  flip: number | null; // Mean FLIP without a swap
  terms: TermEffect[]; // Terms that differ between the paths
}

export interface TermEffect {
  term: string;
  flip: number | null; // Mean FLIP after the test takes this term from the reference
}

/** Files of pixel values, relative to the report's folder; empty: none */
export interface PixelFiles {
  color: string; // Both paths, FLIP of the whole images, FLIP of each material by swap, and the material of each pixel
  terms: string; // Terms of both paths
}

/** Lights that the test path drops for visible objects; absent: none, or not requested. They do not change verdicts */
export interface DroppedLights {
  lights: number; // Number of lights that reach visible objects, dropped or not
  measured: DroppedLight[]; // The largest effect first
  notMeasured: string[]; // Names of dropped lights that were not measured (--dropped-lights), the largest estimated effect first
}

export interface DroppedLight {
  name: string;
  kind: "directional" | "point" | "spot";
  keptBy: number; // Number of visible objects that the test path shades with this light
  droppedBy: number; // Number of visible objects that this light reaches and that the test path shades without it
  materials: LightEffect[]; // Materials of the objects that drop the light, the largest change first
}

export interface LightEffect {
  name: string;
  flip: number; // Mean FLIP of the reference's picture without this light against its picture with all lights
}

export interface Pass {
  name: string;
  count: number; // Number of units; work from a cache counts as done
  unit: string;
  skipped: string | null; // Reason why nothing was done; null if count is not 0
}

export interface Permutation {
  path: string;
  textures: string; // Textures that it reads, or 'none'
  features: string; // Features of its materials, or 'none'
  pixels: number; // Number of surface samples that it shaded, in all views
  samplers: number; // Number of samplers that it binds: textures of its materials, and other inputs of the path
  cost?: PermutationCost;
}

/** Largest cost of a pixel, counted from SPIR-V; only with --costs */
export interface PermutationCost {
  fp32: number; // Scalar operations on 32-bit reals
  fp16: number; // Scalar operations on 16-bit reals
  integer: number; // Scalar operations on integers and booleans
  fetches: number; // Texture reads
  openLoops: number; // Number of loops with unknown iteration count; their bodies count once
}

/** Data that differs from run to run, so that it is not in the report */
export interface Run {
  schema: number;
  startedAt: string; // ISO 8601, UTC
  commandLine: string;
  timings: Timing[];
  compiledShaders: number; // Shaders of all paths; equal shaders count once
  cachedScenes: string[]; // Scenes whose unchanged results came from the cache
  again: AgainCommand[]; // For each view that was asked for
  incidents: string[]; // Crashes of workers after which a second try succeeded
  sceneTimes: SceneTime[]; // Of each scene that was done; several scenes may run at a time
  warningsFail: boolean; // true: a warning alone makes the exit code 1 (--warn-exit), and its case in junit.xml fails
  origin: Origin;
}

export interface Timing {
  stage: string;
  timeMs: number | null;
}

/** A command line that compares one view again and prints its rows */
export interface AgainCommand {
  scene: string;
  view: string;
  command: string; // For a POSIX shell; --material GLOB chooses a material
}

/** Wall time of a scene, from its file or the cache to its figures and pictures */
export interface SceneTime {
  scene: string;
  seconds: number;
  cpuSeconds: number; // CPU time of all threads; 0: not known, because several scenes ran at a time in one process
  machine?: string; // Processor; absent: that of 'origin'
}

/** What made the run */
export interface Origin {
  build: string; // Hash of the program
  driver: string; // Driver of the device, with its version
  numerics: string; // Numerics id: how the machine rounds; empty: not known
  machine: string; // Name of the processor; empty: not known
  whole: boolean; // false: with --only or --material
  complete: boolean; // false: a scene was not run, or has no result
  cpuSeconds: number; // CPU time of this process and of its workers, all threads
}
