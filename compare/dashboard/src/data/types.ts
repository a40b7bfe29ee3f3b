// report.json, run.json and bench.json as the page reads them (compare/report.schema.json is the contract).

/**
 * In order of gravity. "too small": of fewer pixels than its budget's minPixels. "not judged": most of its pixels are
 * clipped in both pictures. Both weigh as warnings, as "not seen" does.
 */
export type Verdict = "pass" | "not seen" | "too small" | "not judged" | "warn" | "fail" | "error";

/** By the figure's name: "flip.mean", "psnr", "bias.ev"; null: not finite (psnr of equal pictures). */
export type Metrics = Record<string, number | null>;

export interface Figures {
  pixels: number;
  nonFinite: number;
  metrics: Metrics;
  clippedBlack: number | null; // shares that are black in both displayed pictures, and white in both: 0..1
  clippedWhite: number | null;
  referenceLuma: number | null; // means of the displayed pictures
  testLuma: number | null;
  referenceLuminance: number | null; // means of linear light as exposed, before clipping; 1: white
  testLuminance: number | null;
}

export interface Check {
  metric: string;
  regress: boolean;
  value: number | null;
  warn: number | null;
  fail: number | null;
  verdict: Verdict; // "not judged": there was nothing to judge by, the note says why
  note: string;
}

export interface Rule {
  rule: string;
  preset: string;
  reason: string;
  owner: string;
  requireSeen: boolean;
  minPixels: number; // a material of fewer is too small to be judged
}

export interface Change {
  new: boolean;
  verdict: Verdict | null;
  changes: Metrics; // now minus then
}

export interface Images {
  reference: string;
  test: string;
  flip: string;
}

export interface TruthTerm {
  term: string;
  luminance: { truth: number | null; highend: number | null; mobile: number | null };
  figures: { highend: Metrics; mobile: Metrics } | null; // null: no pixel
}

export interface TruthFigures {
  nonFinite: number;
  highend: Figures;
  mobile: Figures;
  error: { median: number | null; worst: number | null; relmse: number | null; samples: number | null };
}

export interface Truth {
  figures: TruthFigures | null; // null: no pixel
  terms: TruthTerm[];
  notes: string[];
  images: { truth: string; highendFlip: string; mobileFlip: string };
}

export interface Encoding {
  target: string;
  figures: Figures | null;
}

export interface TextureCompression {
  block: string;
  figures: Figures | null;
}

/** What mobile's mean FLIP becomes once one of its terms is high-end's. */
export interface Attribution {
  flip: number | null;
  terms: { term: string; flip: number | null }[];
}

export interface TermLight {
  term: string;
  reference: number | null;
  test: number | null;
}

/** What materials and whole images have in common. */
export interface Judged {
  verdict: Verdict;
  reason: string;
  bias: string;
  figures: Figures | null; // null: no pixel
  checks: Check[];
  budget: Rule;
  baseline: Change | null;
  truth?: Truth;
  encoding?: Encoding;
  textures?: TextureCompression;
}

export interface Material extends Judged {
  name: string;
  seenElsewhere: boolean;
  notModelled: string[]; // its parts that no path models, "clearcoat": only its base layer is judged
  notes: string[];
  terms: TermLight[];
  crops: Images;
  attribution?: Attribution;
}

/** Lights that mobile drops from objects of a view. */
export interface DroppedLights {
  lights: number;
  measured: DroppedLight[]; // the most effect first
  notMeasured: string[];
}

export interface DroppedLight {
  name: string;
  kind: "directional" | "point" | "spot";
  keptBy: number; // objects
  droppedBy: number;
  materials: { name: string; flip: number }[]; // the most changed first
}

export interface View {
  name: string;
  width: number;
  height: number;
  verdict: Verdict;
  whole: Judged;
  materials: Material[];
  images: Images;
  exposureEv: number;
  pixels: { color: string; terms: string };
  droppedLights?: DroppedLights;
}

export interface Pass {
  name: string;
  count: number;
  unit: string;
  skipped: string | null;
}

export interface Permutation {
  path: string;
  textures: string;
  features: string;
  pixels: number;
  samplers: number;
  cost?: { fp32: number; fp16: number; integer: number; fetches: number; openLoops: number };
}

export interface Scene {
  name: string;
  source: string;
  environment: string;
  sun: string;
  light?: string;
  verdict: Verdict;
  error: { message: string; exitCode: number } | null;
  warnings: string[];
  views: View[];
  passes: Pass[];
  permutations: Permutation[];
}

export interface Counts {
  pass: number;
  notSeen: number;
  tooSmall: number;
  notJudged: number;
  warn: number;
  fail: number;
  error: number;
}

export interface Baseline {
  source: string;
  version: string;
  device: string;
  common: number;
  gone: { scene: string; view: string; material: string }[];
  error: string;
}

/** How to read a figure. */
export interface Statistic {
  label: string;
  unit: string;
  digits: number;
  better: "lower" | "higher" | "near zero";
}

export interface Report {
  schema: number;
  tool: string;
  version: string;
  device: string;
  verdict: Verdict;
  headline: string;
  displayTable: string;
  counts: Counts;
  wholeCounts: Counts;
  problems?: { verdict: "fail" | "error"; reason: string }[];
  warnings: string[];
  baseline: Baseline | null;
  settings: { name: string; value: string }[];
  statistics: Record<string, Statistic>;
  scenes: Scene[];
}

export interface Run {
  schema: number;
  startedAt: string;
  commandLine: string;
  timings: { stage: string; timeMs: number | null }[];
  compiledShaders: number;
  cachedScenes: string[];
}
