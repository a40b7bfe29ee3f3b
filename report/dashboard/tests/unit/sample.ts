// A small report made by hand, for tests of what the page derives from one.
import type { Judged } from "../../src/data/judged";
import { kSchema, type Explanation, type Figures, type Material, type Report, type Scene, type Verdict, type View } from "../../src/data/types";

export function makeFigures(flip: number, patch: Partial<Figures> = {}): Figures {
  return {
    pixels: 100, nonFinite: 0, metrics: { "flip.mean": flip, "bias.ev": -flip }, clippedBlack: 0, clippedWhite: 0,
    referenceLuma: 0.5, testLuma: 0.4, referenceLuminance: 0.3, testLuminance: 0.2, ...patch,
  };
}

export function makeJudged(verdict: Verdict, flip: number | null, patch: Partial<Judged> = {}): Judged {
  return {
    verdict, reason: "", bias: flip === null ? "" : "mobile is darker", figures: flip === null ? null : makeFigures(flip),
    checks: [], budget: { rule: "built-in", preset: "default", reason: "", owner: "", requireSeen: false, minPixels: 64 }, baseline: null, stages: [], ...patch,
  };
}

export function makeMaterial(name: string, verdict: Verdict, flip: number | null, patch: Partial<Material> = {}): Material {
  return { ...makeJudged(verdict, flip), name, seenElsewhere: false, notModelled: [], notes: [], terms: [], crops: { reference: "", test: "", flip: "" }, ...patch };
}

/** Of a metal ball that reflects a capture without parallax. */
export function makeExplanation(patch: Partial<Explanation> = {}): Explanation {
  return {
    words: "captures without parallax (0.387 of FLIP 0.445)", advice: ["mobile-parallax=on: mean FLIP 0.090 instead of 0.445, with 13 % more operations."],
    approximations: [
      { approximation: "captures without parallax", change: "mobile-parallax=on", alone: 0.355, share: 0.387 },
      { approximation: "formulas of the preset", change: "formulas=refit", alone: -0.02, share: 0.035 },
      { approximation: "storage of captures", change: "capture=fp16", alone: -0.014, share: -0.012 },
    ],
    sets: [
      { changes: [], flip: 0.445, operations: 421, fetches: 4 },
      { changes: ["mobile-parallax=on"], flip: 0.09, operations: 476, fetches: 4 },
      { changes: ["formulas=refit", "mobile-parallax=on"], flip: 0.018, operations: 408, fetches: 5 },
    ],
    advised: 1, picture: "", ranges: [], masks: [], ...patch,
  };
}

export function makeView(name: string, materials: Material[]): View {
  return {
    name, reference: "highend", test: "mobile", width: 64, height: 64, conditions: [], verdict: "pass", whole: makeJudged("pass", 0.01), materials,
    images: { reference: "", test: "", flip: "" }, exposureEv: 0, pixels: { color: "", terms: "" },
  };
}

export function makeScene(name: string, views: View[], error: string | null = null): Scene {
  return {
    name, source: name + ".glb", environment: "none", sun: "none", conditions: [], verdict: error === null ? "pass" : "error",
    error: error === null ? null : { message: error, exitCode: 4 }, warnings: [], views, passes: [], permutations: [],
  };
}

export function makeReport(scenes: Scene[]): Report {
  const counts = { pass: 0, notSeen: 0, tooSmall: 0, notJudged: 0, warn: 0, fail: 0, error: 0 };
  return {
    schema: kSchema, tool: "parity", version: "0", suite: "", device: "device", verdict: "pass", headline: "", displayTable: "", counts, wholeCounts: counts,
    problems: [], warnings: [], baseline: null, settings: [], conditions: [], digests: { settings: "", budgets: "" }, statistics: {}, scenes,
  };
}
