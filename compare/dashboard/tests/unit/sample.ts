// A small report made by hand, for tests of what the page derives from one.
import type { Judged, Material, Report, Scene, Verdict, View } from "../../src/data/types";

export function makeJudged(verdict: Verdict, flip: number | null, patch: Partial<Judged> = {}): Judged {
  const figures = flip === null ? null : { pixels: 100, nonFinite: 0, metrics: { "flip.mean": flip, "bias.ev": -flip }, referenceLuma: 0.5, testLuma: 0.4 };
  return {
    verdict, reason: "", bias: flip === null ? "" : "mobile is darker", figures: { interior: figures, all: figures && { ...figures, pixels: 120 } },
    checks: [], budget: { rule: "built-in", preset: "default", reason: "", owner: "", requireSeen: false }, baseline: null, ...patch,
  };
}

export function makeMaterial(name: string, verdict: Verdict, flip: number | null, patch: Partial<Material> = {}): Material {
  return { ...makeJudged(verdict, flip), name, seenElsewhere: false, notes: [], terms: [], crops: { reference: "", test: "", flip: "" }, ...patch };
}

export function makeView(name: string, materials: Material[]): View {
  return {
    name, width: 64, height: 64, verdict: "pass", whole: makeJudged("pass", 0.01), materials,
    images: { reference: "", test: "", flip: "" }, exposureEv: 0, pixels: { color: "", terms: "" },
  };
}

export function makeScene(name: string, views: View[], error: string | null = null): Scene {
  return {
    name, source: name + ".glb", environment: "none", sun: "none", verdict: error === null ? "pass" : "error",
    error: error === null ? null : { message: error, exitCode: 4 }, warnings: [], views, passes: [], permutations: [],
  };
}

export function makeReport(scenes: Scene[]): Report {
  const counts = { pass: 0, notSeen: 0, warn: 0, fail: 0, error: 0 };
  return {
    schema: 2, tool: "parity", version: "0", device: "device", verdict: "pass", headline: "", displayTable: "", counts, wholeCounts: counts,
    warnings: [], baseline: null, settings: [], statistics: {}, scenes,
  };
}
