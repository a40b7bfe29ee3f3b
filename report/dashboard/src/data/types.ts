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
};

/** How far apart two shading paths look, per material. Equal inputs give a byte-identical file; times and dates are in run.json. A number that is null is infinite (psnr of identical images) or not a number (the verdict is then 'error'). */
export interface Report {
  schema: number; // Version of this format
  tool: string;
  version: string;
  device: string; // Vulkan device name and driver
  verdict: Verdict;
  headline: string; // The whole report in a sentence
  counts: Counts;
  wholeCounts: Counts;
  displayTable: string; // File of the display transform as a table, relative to the report's folder; empty: none
  problems: Problem[]; // Why the run as a whole is no pass: no material was compared, or none is where a budget requires one
  warnings: string[]; // Of the whole run
  baseline: Baseline | null; // The earlier report that this run was held against
  settings: Setting[]; // What the run was asked for, in a fixed order
  conditions: Condition[]; // Of every scene; the device is one more
  statistics: Record<string, Statistic>; // How to read each figure of 'metrics' and 'checks', by its name
  scenes: Scene[];
}

/** In order of gravity; a whole has the worst of its parts' */
export type Verdict = "pass" | "not seen" | "too small" | "not judged" | "warn" | "fail" | "error";

/** counts: rows (material x view) by verdict, without those that another view shows; wholeCounts: whole images */
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
  source: string; // The file as it was given; without its folder, if that path is absolute
  version: string; // Of the program that made it
  device: string;
  common: number; // Material views that both show
  notComparable: number; // Material views and whole images that both show, under other conditions; at least a warning
  gone: GoneRow[]; // What the baseline has and this run has not; at least a warning
  error: string; // Why it could not be used (the verdict is 'error'); empty: it was
}

export interface GoneRow {
  scene: string;
  view: string; // Empty: the whole scene is gone
  material: string; // Empty: the whole view is gone
}

export interface Setting {
  name: string;
  value: string;
}

/** What decides the figures besides the scene's files: a baseline of other conditions is not comparable */
export interface Condition {
  name: string;
  value: string; // In full precision; files by their content
  actsOn: "figures" | "whole images" | "truth"; // The figures that it decides: all but the truth's, those of whole images alone, those against the truth alone
  words?: string; // The value for people; absent: the value says it
}

export interface Statistic {
  label: string; // In a sentence
  unit: string; // %: of a share, which is 0 to 1 in this file
  digits: number; // After the point, where people read it
  better: "lower" | "higher" | "near zero";
}

export interface Scene {
  name: string;
  source: string; // The file as it was named, or builtin:NAME
  environment: string; // 'none': none
  sun: string; // 'none': none
  light?: string; // Scales of its light and its fog, in words; absent: the defaults
  conditions: Condition[]; // Of the scene: its light, what of the file is shown, ...
  verdict: Verdict;
  /** The scene could not be compared; the views hold what was done before. null: it was compared */
  error: {
    message: string;
    exitCode: number;
  } | null;
  warnings: string[];
  views: View[];
  passes: Pass[]; // What was done for the scene, over all views, and what was skipped
  permutations: Permutation[]; // The specialised shaders that made the pictures, by path, in order of their first use
}

export interface View {
  name: string;
  reference: string; // The path that its figures compare with
  test: string; // The path that its figures are of
  width: number;
  height: number;
  conditions: Condition[]; // Of the view: its camera
  verdict: Verdict;
  /** All pixels of any material */
  whole: {
    verdict: Verdict;
    reason: string; // What decided the verdict; empty on a pass
    bias: string; // How the test's light and tint differ, in words; empty without pixels
    figures: Figures | null; // null: no pixel, nothing is known
    checks: Check[];
    budget: Rule;
    baseline: Change | null; // null: there is no baseline
    truth?: Truth;
    stages: Stage[];
  };
  materials: Material[]; // In the scene's order
  images: Images;
  exposureEv: number; // Of its pictures: what the values of 'pixels' are exposed by
  pixels: PixelFiles;
  droppedLights?: DroppedLights;
}

export interface Figures {
  pixels: number;
  nonFinite: number; // Pixels where either render is NaN or infinite
  metrics: Record<string, number | null>; // By the figure's name: flip.mean, flip.fraction_over(0.1), psnr, bias.ev, ... (compare/pooling/statistic.h)
  clippedBlack: number | null; // Share that is black in both displayed images: it says nothing
  clippedWhite: number | null; // Share that is white in both displayed images: it says nothing
  referenceLuma: number | null; // Mean Rec.709 luma of the displayed reference
  testLuma: number | null; // The same of the test
  referenceLuminance: number | null; // Mean linear luminance of the reference as exposed, before clipping; 1 is white
  testLuminance: number | null; // The same of the test
}

export interface Check {
  metric: string; // A name of 'metrics'
  regress: boolean; // The value is by how much the figure is worse than in the baseline, not the figure
  value: number | null; // null: infinite, not a number, or not known
  warn: number | null; // Beyond it (below, where more is better: psnr, ssim; in absolute value, where signed) the verdict is warn; null: no such limit
  fail: number | null; // Beyond it (below, where more is better: psnr, ssim; in absolute value, where signed) the verdict is fail; null: no such limit
  verdict: "pass" | "warn" | "fail" | "error" | "not judged"; // not judged: a regression without a counterpart in a baseline, or with one of other conditions
  note: string;
}

/** The budget rule that judged it */
export interface Rule {
  rule: string; // Where the rule stands; empty: none matched
  preset: string; // Whose limits it took; empty: all are its own
  reason: string;
  owner: string;
  requireSeen: boolean;
  minPixels: number; // A material of fewer pixels is too small to be judged
}

export interface Change {
  new: boolean; // The baseline does not have it
  verdict: Verdict | null; // In the baseline; null: new
  notComparable: string; // The conditions that differ, in words: there are no changes, and the verdict is at least warn; empty: none does
  changes: Record<string, number | null>; // Now minus then; null: to or from infinite
}

/** Both paths against the ground truth; only of a run that was asked for it. It judges nothing */
export interface Truth {
  figures: TruthFigures | null; // null: no pixel, nothing is known
  terms: TruthTerm[]; // Without those that are black in all three
  notes: string[]; // What to beware of in these figures
  images: TruthImages;
}

export interface TruthFigures {
  nonFinite: number; // Pixels where the truth itself is NaN or infinite; the verdict then is 'error'
  reference: Figures; // Of the view's reference against the truth
  test: Figures; // Of the view's test against the truth
  error: TruthError;
}

/** How well the truth is known; null: not known */
export interface TruthError {
  median: number | null; // Of the pixels' relative standard errors
  worst: number | null; // The largest of them
  relmse: number | null; // What that error alone would give, about; every relmse against the truth holds it
  samples: number | null; // Of the environment, a pixel and way of sampling, on average; 0: all in closed form
}

export interface TruthTerm {
  term: string;
  /** Mean scene-referred luminance */
  luminance: {
    truth: number | null;
    reference: number | null;
    test: number | null;
  };
  /** Of the term alone, displayed and exposed as the colour is, against the truth's, by name; null: no pixel */
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

/** What a stage of the test path alone makes of its picture: the reference is that without the stage, the test that with it, both as displayed. It judges nothing */
export interface Stage {
  stage: string; // encoding: storing the colour in the target; textures: compressing them
  through: string; // What the picture passes through there: rgba8-gamma2, astc6x6
  figures: Figures | null; // null: no pixel, nothing is known
}

export interface Material {
  name: string;
  verdict: Verdict;
  reason: string; // What decided the verdict; empty on a pass
  seenElsewhere: boolean; // Not seen in this view, or too small, but seen in another one: the row does not count
  bias: string; // How the test's light and tint differ, in words; empty without pixels
  figures: Figures | null; // null: no pixel, nothing is known
  checks: Check[]; // Empty where the material is not seen
  budget: Rule;
  baseline: Change | null; // null: there is no baseline
  notModelled: string[]; // Parts of it that no path models: only its base layer is judged, which is at least a warning
  notes: string[]; // Permutation, sampler excess, tinted F0, ...
  terms: TermLight[];
  crops: Images;
  truth?: Truth;
  stages: Stage[];
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

/** Which term makes it differ: only of a material over budget, or as the run was asked */
export interface Attribution {
  flip: number | null; // Mean, as it is
  terms: TermEffect[]; // Those that are not the same in both paths
}

export interface TermEffect {
  term: string;
  flip: number | null; // Mean, once the test has the reference's term
}

/** Files of the values behind the pictures, relative to the report's folder; empty: none */
export interface PixelFiles {
  color: string; // Both paths, FLIP of the whole images, FLIP of each material by the swap, which material is where
  terms: string; // Both paths' terms
}

/** Lights that the test path drops from objects that the view shows; absent: none, or not asked for. It judges nothing */
export interface DroppedLights {
  lights: number; // That it could have, dropped or not
  measured: DroppedLight[]; // The most effect first
  notMeasured: string[]; // Names of the dropped lights beyond the run's limit (--dropped-lights), the most estimated effect first
}

export interface DroppedLight {
  name: string;
  kind: "directional" | "point" | "spot";
  keptBy: number; // Objects of the view that the test path shades with it
  droppedBy: number; // Objects of the view that it reaches and that do without it
  materials: LightEffect[]; // Of the objects that drop it, the most changed first
}

export interface LightEffect {
  name: string;
  flip: number; // Mean FLIP of the reference's picture without this light against that with all lights
}

export interface Pass {
  name: string;
  count: number; // Of the unit; what a cache gave counts as done
  unit: string;
  skipped: string | null; // Why nothing was done; null where count is not 0
}

export interface Permutation {
  path: string;
  textures: string; // That it reads; 'none'
  features: string; // Of the materials that it is made for; 'none'
  pixels: number; // Surface samples that it shaded, over all views
  samplers: number; // That it binds: its materials' textures, and what else the path reads
  cost?: PermutationCost;
}

/** A pixel's at most, counted from SPIR-V; only of a run that was asked for it (--costs) */
export interface PermutationCost {
  fp32: number; // Scalar operations on 32-bit reals
  fp16: number; // Scalar operations on 16-bit reals
  integer: number; // Scalar operations on integers and booleans
  fetches: number; // Texture reads
  openLoops: number; // Loops whose number of turns is not known: their bodies count once
}

/** What differs from run to run, kept out of the report */
export interface Run {
  schema: number;
  startedAt: string; // ISO 8601, UTC
  commandLine: string;
  timings: Timing[];
  compiledShaders: number; // Of all paths, the same one once
  cachedScenes: string[]; // Whose results were taken from the cache, unchanged
}

export interface Timing {
  stage: string;
  timeMs: number | null;
}
