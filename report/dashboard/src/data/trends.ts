// What a chart and a table need of a row's figures over the runs (data/history): steps, ranges, dates. No part of it draws.
import type { EarlierRun, TrendChange, ValueSpan } from "./history";

/** "2026-11-21"; "" where it is not known. */
export function dayOf(run: EarlierRun | undefined): string {
  return run?.started.slice(0, 10) ?? "";
}

/** "2026-11-21, 010e2b14a553": what a reader calls a run. */
export function runTitle(run: EarlierRun | undefined): string {
  if (run === undefined) return "unknown run";
  return [dayOf(run), run.commit === "" ? "" : run.commit.slice(0, 12)].filter((each) => each !== "").join(", ") || run.name;
}

/** "2026-11-21 (010e2b14a553)": the same within a sentence. */
export function runInText(run: EarlierRun | undefined): string {
  const [day, commit] = [dayOf(run), run?.commit.slice(0, 12) ?? ""];
  return day === "" || commit === "" ? runTitle(run) : `${day} (${commit})`;
}

/** The value in a run; null: not a number; undefined: the run has no value. */
export function valueAt<Value>(spans: readonly (readonly [number, number, Value])[], run: number): Value | undefined {
  return spans.find(([first, last]) => first <= run && run <= last)?.[2];
}

export interface ChartSeries {
  label: string;
  spans: readonly ValueSpan[];
  today?: number | null; // of the run after all of these; undefined: there is none
}

/** Limits of a figure; isAbsolute: of its size, so that they lie on both sides of 0. */
export interface ChartLimits {
  warn: number | null;
  fail: number | null;
  isAbsolute?: boolean;
}

/** For each run the left and the right end of its step, at half a run before and after its place; null: nothing is drawn. */
export interface Steps {
  x: number[];
  y: (number | null)[][]; // by series
}

/** How many places the chart has: the runs, and today where a series has it. */
export function placesOf(runs: number, series: readonly ChartSeries[]): number {
  return runs + Number(series.some(({ today }) => today !== undefined));
}

export function stepsOf(runs: number, series: readonly ChartSeries[]): Steps {
  const places = placesOf(runs, series);
  const x = Array.from({ length: 2 * places }, (_, i) => Math.floor(i / 2) - 0.5 + (i % 2));
  const y = series.map(({ spans, today }) => {
    const values = new Array<number | null>(2 * places).fill(null);
    for (const [first, last, value] of spans) values.fill(value, 2 * Math.max(first, 0), 2 * Math.min(last + 1, runs));
    if (today !== undefined) values.fill(today, 2 * runs);
    return values;
  });
  return { x, y };
}

const kFarLimit = 4; // a limit so many times larger than all values would press them flat: it is not drawn

/** The lines of limits that the chart has room for. */
export function limitLines(limits: ChartLimits | null, series: readonly ChartSeries[]): { kind: "warn" | "fail"; value: number }[] {
  if (limits === null) return [];
  const values = series.flatMap(({ spans, today }) => [...spans.map(([, , value]) => value), today ?? null]);
  const most = values.reduce<number>((all, value) => Math.max(all, Math.abs(value ?? 0)), 0);
  const lines: { kind: "warn" | "fail"; value: number }[] = [];
  for (const kind of ["warn", "fail"] as const) {
    const value = limits[kind];
    if (value === null || (most > 0 && Math.abs(value) > kFarLimit * most)) continue;
    lines.push({ kind, value });
    if (limits.isAbsolute === true && value !== 0) lines.push({ kind, value: -value });
  }
  return lines;
}

/** What the y axis shows: all values, with a little room; 0 where it is not far below them. */
export function rangeOfValues(values: readonly (number | null)[]): [number, number] {
  const known = values.filter((value): value is number => value !== null && Number.isFinite(value));
  if (known.length === 0) return [0, 1];
  let [least, most] = [Math.min(...known), Math.max(...known)];
  if (least > 0 && least < 0.7 * most) least = 0;
  if (most < 0 && most > 0.7 * least) most = 0;
  if (least === 0 && most === 0) return [0, 1];
  const room = 0.08 * (most - least || Math.abs(most) || 1);
  return [least === 0 ? 0 : least - room, most === 0 ? 0 : most + room];
}

/** Which places of the x axis get a date, so that there are at most so many. */
export function labelledPlaces(places: number, most: number): number[] {
  const step = Math.max(1, Math.ceil(places / Math.max(most, 1)));
  const from = (places - 1) % step; // the last one has a label
  return Array.from({ length: Math.ceil((places - from) / step) }, (_, i) => from + i * step);
}

/** "regressed, cause: asset" */
export function changeWords({ kind, cause }: TrendChange): string {
  return cause === "" ? kind : `${kind}, cause: ${cause}`;
}
