// What the charts of nights draw: lines over the runs, marks of what happened, the small trend of a row.
import type { Night, Trend } from "./history";
import { kKinds } from "./nights";

/** A value for each run; null: none is drawn. */
export type Values = (number | null)[];

export interface Line {
  label: string;
  color: string; // a variable of tokens.css
  values: Values;
  dash?: readonly number[];
  isScattered?: boolean; // its runs take turns with those of other lines: points
}

/** Runs at which something happened, as a lane above a chart. */
export interface Lane {
  kind: string;
  color: string;
  runs: number[];
}

/** A part of the scenes, or an incomplete run, has fewer rows than its neighbours: its counts are no part of a line. */
const ofWhole = (night: Night, value: number | null): number | null => (night.isWhole && night.isComplete ? value : null);

export function countLines(runs: readonly Night[]): Line[] {
  return [
    { label: "failed", color: "--fail", values: runs.map((each) => ofWhole(each, each.failed)) },
    { label: "warned", color: "--warn", values: runs.map((each) => ofWhole(each, each.warned)), dash: [6, 3] },
  ];
}

export function flipLines(runs: readonly Night[]): Line[] {
  return [
    { label: "worst row", color: "--fail", values: runs.map((each) => ofWhole(each, each.worst?.flip ?? null)) },
    { label: "mean of all materials", color: "--accent", values: runs.map((each) => ofWhole(each, each.meanFlip)), dash: [6, 3] },
  ];
}

const kMachineColors = ["--accent", "--warn", "--error", "--pass", "--fail"];

/** One line a machine, those with the most nights first; more machines than colours share the last line. */
export function costLines(runs: readonly Night[]): Line[] {
  const nights = new Map<string, number>();
  for (const { machine, cpuS } of runs) if (cpuS !== null) nights.set(machine, (nights.get(machine) ?? 0) + 1);
  const machines = [...nights].sort((a, b) => b[1] - a[1]).map(([machine]) => machine);
  const shown = machines.length > kMachineColors.length + 1 ? machines.slice(0, kMachineColors.length) : machines;
  const lines = shown.map((machine, index): Line => ({
    label: machine === "" ? "machine not known" : machine,
    color: kMachineColors[index] ?? "--muted",
    values: runs.map((each) => (each.machine === machine ? each.cpuS : null)),
    isScattered: machines.length > 1,
  }));
  if (shown.length < machines.length)
    lines.push({ label: `${machines.length - shown.length} other machines`, color: "--muted", values: runs.map((each) => (shown.includes(each.machine) ? null : each.cpuS)), isScattered: true });
  return lines;
}

const kLaneColors: Readonly<Record<string, string>> = { nondeterministic: "--error", crashed: "--error", regressed: "--fail" };

/** The grave ones of what happened, the gravest first; no lane where nothing of its kind did. */
export function lanesOf(runs: readonly Night[]): Lane[] {
  return kKinds
    .filter((kind) => kind in kLaneColors)
    .map((kind) => ({ kind, color: kLaneColors[kind] ?? "", runs: runs.flatMap(({ events }, place) => ((events[kind] ?? 0) > 0 ? [place] : [])) }))
    .filter((lane) => lane.runs.length > 0);
}

const round = (value: number): string => String(Number(value.toFixed(1)));

/** The path of an SVG of this size: steps of a figure over so many runs, with gaps where the row was not seen. */
export function trendPath(trend: Trend, figure: string, runs: number, width: number, height: number): string {
  const spans = (trend.figures[figure] ?? []).filter((span): span is readonly [number, number, number] => span[2] !== null);
  if (spans.length === 0 || runs === 0) return "";
  const values = spans.map(([, , value]) => value);
  const least = Math.min(...values), most = Math.max(...values);
  const x = (run: number): string => round((width * run) / runs);
  const y = (value: number): string => round(most === least ? height / 2 : height - 1.5 - ((height - 3) * (value - least)) / (most - least));
  let path = "", end = -1;
  for (const [first, last, value] of spans) {
    path += first === end ? `V${y(value)}` : `M${x(first)} ${y(value)}`;
    end = last + 1;
    path += `H${x(end)}`;
  }
  return path;
}
