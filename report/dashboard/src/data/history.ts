// What earlier runs say of rows: their figures and verdicts over the runs, and what changed them (docs/history.md).
import type { Images, Verdict } from "./types";

/** In the order of the overview's column "standing" (report/standing.h). */
export const kStandings = ["", "unknown", "new", "still", "fixed", "accepted", "flaky"] as const;
export type Standing = (typeof kStandings)[number];

export interface EarlierRun {
  name: string; // of its file in the history
  started: string; // ISO 8601, UTC
  commit: string; // "": not known
  verdict: Verdict;
}

/** A value from its first run to its last one: places in the runs. Between two of them a gap: the row was not seen. null: not a number. */
export type ValueSpan = readonly [first: number, last: number, value: number | null];
export type VerdictSpan = readonly [first: number, last: number, verdict: Verdict];

export interface TrendChange {
  run: number; // place in the runs: the first one that has it
  kind: "nondeterministic" | "crashed" | "regressed" | "fixed" | "changed" | "new" | "gone";
  cause: string; // "asset, build"; "": not known
  metric: string; // the figure that changed most; "": none
  before: number | null;
  after: number | null;
  figures: number; // how many figures changed
}

export interface Trend {
  figures: Readonly<Record<string, readonly ValueSpan[]>>; // by name, oldest first
  verdicts: readonly VerdictSpan[];
  changes: readonly TrendChange[]; // oldest first
}

/** Of a row of a report's page. */
export interface RowTrend extends Trend {
  approved?: { run: number; images: Images }; // the run whose state was approved, and its pictures in the report's folder
}

/** The block "history" of a report's page: the runs before it, oldest first. */
export interface EarlierRuns {
  format: 1;
  suite: string;
  branch: string;
  runs: EarlierRun[];
}

/** In the file of a scene: rows as in `scene.views`: each view's materials, then its whole image. null: the runs know nothing of it. */
export interface SceneTrends {
  views: (RowTrend | null)[][];
}

// The page of `parity history page`.

export interface NightChange extends TrendChange {
  row: string; // "SCENE/VIEW/MATERIAL", "SCENE/VIEW" or "SCENE"
}

export interface Night extends EarlierRun {
  rows: number;
  failed: number;
  warned: number;
  isComplete: boolean;
  isWhole: boolean; // false: a part of the scenes (--only, --material), which is compared with no run
  isFirst: boolean; // of its suite and branch: there was no run to compare it with
  version: string; // of parity
  build: string; // digest
  device: string;
  machine: string; // processor
  cpuS: number | null; // CPU seconds of all scenes that did not come from the cache; null: not known
  wallS: number | null;
  scenes: number; // with a known time
  cachedScenes: number; // of these
  worst: { row: string; flip: number } | null; // the row with the largest mean FLIP
  meanFlip: number | null; // of all rows of materials
  events: Readonly<Record<string, number>>; // how many of each kind
  changes: NightChange[]; // the gravest first; not all where there are many
}

export interface Nights {
  format: 1;
  version: string;
  suite: string;
  branch: string;
  statistics: Readonly<Record<string, { better: string }>>; // by figure
  runs: Night[]; // oldest first
  rows: Readonly<Record<string, Trend>>; // of rows that changed, by name: those that changed last, at most some thousands
  timings: { scene: string; machine: string; run: number; beforeMs: number; nowMs: number }[]; // steps in the CPU time of scenes
}
