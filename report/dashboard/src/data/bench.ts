// bench.json of `parity bench` (study/sweep/sweep_json.cpp), and the pictures that the program has drawn of its scenes.

import { pathWord } from "./paths";

export type Maybe = number | null; // null: not finite
export type Spread = Record<"median" | "low" | "high", number>;
export type Figure = "flip.mean" | "flip.p95" | "relmse";
export type Errors = Record<Figure, Maybe> & { nonFinite: number };
export type Stage = "shading" | "preparation" | "storage";
/** "truth"; else the first path's default, by the path's name. */
export type Against = string;

export type Region = {
  name?: string; // of the material; none: all that is covered
  truth?: Errors;
} & Record<string, unknown>; // and by the first path's name Errors
export interface Variant {
  path: string;
  name: string;
  stage: Stage;
  timeMs?: Record<"device" | "wall" | "cpu", Spread> & { compile: number };
  prepareMs?: Spread;
  cost: Record<"operations" | "fetches" | "samplers", number>;
  dominated: boolean;
  error: Region;
  materials: Region[];
}
export type MeasuredScene = Record<"scene" | "environment" | "sun", string> &
  Record<"width" | "height" | "pixels" | "truthError", number> & { skipped: string[]; variants: Variant[] };
export type BenchScene = MeasuredScene | { scene: string; failure: string };

export type Purchase = Record<"path" | "knob" | "from" | "to", string> &
  Record<"msPerMillionSamples" | "error" | "errorPerMs", Maybe> & { timeIsCertainIn: number };
export type Ratio = Record<"scene" | "id", string> & Record<"ratio" | "low" | "high", number> &
  Record<"flipBefore" | "flipNow", Maybe> & { verdict: "slower" | "faster" | "the same" };
export interface Conclusions {
  against: Against;
  figure: Figure;
  notes: string[]; // what limits the conclusions
  dominatedEverywhere: string[];
  budget?: Record<string, number>;
  cheapest?: { scene: string; path: string; setting: string | null }[];
  purchases: Purchase[];
  compared?: { confidence: number; notes: string[]; variants: Ratio[] };
}
export interface Bench {
  version: string;
  commandLine: string;
  startedAt: string;
  machine: Record<"processor" | "device" | "driver" | "deviceKind" | "simd", string> & { threads: number };
  rounds: number;
  scenes: BenchScene[];
  conclusions: Conclusions;
}

/** One of the pictures of a scene: an SVG that the program has made. */
export type Plot = { stage: Stage; against: Against; svg: string };
export type Sweep = { bench: Bench; plots: Plot[][] }; // plots: of each scene

const isObject = (value: unknown): value is Record<string, unknown> => typeof value === "object" && value !== null;

/** null where it is no bench of the form that this page reads: parity checks all of it before it makes the page. */
export function sweepOf(bench: unknown, plots: unknown): Sweep | null {
  if (!isObject(bench) || bench["schema"] !== 2 || !Array.isArray(bench["scenes"]) || !isObject(bench["conclusions"])) return null;
  return { bench: bench as unknown as Bench, plots: Array.isArray(plots) ? (plots as Plot[][]) : [] };
}

/** What a figure is taken against, in words. */
export const wordsOf = (against: Against): string => (against === "truth" ? "the truth" : `the ${pathWord(against)} default`);

export const errorsOf = (region: Region, against: Against): Errors | undefined => region[against] as Errors | undefined;
