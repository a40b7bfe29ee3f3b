// The overview of nightly runs: its data block, checked as far as the page relies on it, and what is said of nights and changes.
import type { Night, NightChange, Nights, Trend, TrendChange } from "./history";
import { dayOf } from "./trends";
import { countOf } from "./wording";

export type Kind = TrendChange["kind"];
/** The gravest first. */
export const kKinds: readonly Kind[] = ["nondeterministic", "crashed", "regressed", "fixed", "changed", "new", "gone"];

const isObject = (value: unknown): value is Record<string, unknown> => typeof value === "object" && value !== null && !Array.isArray(value);
const isNight = (value: unknown): boolean =>
  isObject(value) && ["name", "started", "commit", "verdict"].every((key) => typeof value[key] === "string") && Array.isArray(value["changes"]) && isObject(value["events"]);
const isTrend = (value: unknown): boolean => isObject(value) && isObject(value["figures"]) && Array.isArray(value["verdicts"]) && Array.isArray(value["changes"]);

/** The nights of this page, or why they cannot be shown. */
export function nightsOf(value: unknown): Nights | { problem: string } {
  if (!isObject(value)) return { problem: "This page holds no nights." };
  if (value["format"] !== 1)
    return { problem: `Its nights have format ${JSON.stringify(value["format"]) ?? "unknown"}; this page reads format 1. Open it with the version of parity that wrote it.` };
  const { runs, rows, timings, statistics } = value;
  if (!Array.isArray(runs) || !Array.isArray(timings) || !isObject(rows) || !isObject(statistics)) return { problem: "Its data is not complete." };
  if (!runs.every(isNight)) return { problem: "A night of it is not complete." };
  if (!Object.values(rows).every(isTrend)) return { problem: "A row of it is not complete." };
  return value as unknown as Nights;
}

/** "2026-11-23 03:00 UTC" */
export const timeOf = ({ started }: { started: string }): string => `${started.slice(0, 16).replace("T", " ")} UTC`;

/** How much happened, the gravest first; kinds that this page does not know come last. */
export function eventsOf({ events }: Pick<Night, "events">): { kind: string; count: number }[] {
  const place = (kind: string): number => (kKinds as readonly string[]).indexOf(kind) >>> 0; // -1: the largest
  return Object.entries(events)
    .filter(([, count]) => count > 0)
    .map(([kind, count]) => ({ kind, count }))
    .sort((a, b) => place(a.kind) - place(b.kind));
}

/** What limits the comparison of a night with the one before. */
export function remarksOf(night: Pick<Night, "isFirst" | "isWhole" | "isComplete">): string[] {
  const remarks: string[] = [];
  if (night.isFirst) remarks.push("first run");
  if (!night.isWhole) remarks.push("a part of the scenes");
  if (!night.isComplete) remarks.push("incomplete");
  return remarks;
}

/** "3 regressed, 1 new (incomplete)", "nothing changed": a night in words. */
export function summaryOf(night: Night): string {
  const events = eventsOf(night).map(({ kind, count }) => `${count} ${kind}`).join(", ");
  const remarks = remarksOf(night).join(", ");
  if (events === "") return remarks === "" ? "nothing changed" : remarks;
  return remarks === "" ? events : `${events} (${remarks})`;
}

/** "nightly, main: 400 nights; last: 3 new failures, 12 failing" */
export function titleOf({ suite, branch, runs }: Nights): string {
  const whose = [suite, branch].filter((each) => each !== "").join(", ") || "History";
  const last = runs.at(-1);
  if (!last) return `${whose}: no nights`;
  const { nondeterministic = 0, crashed = 0, regressed = 0 } = last.events;
  const parts = remarksOf(last);
  if (nondeterministic > 0) parts.push(`${nondeterministic} nondeterministic`);
  if (crashed > 0) parts.push(`${crashed} crashed`);
  if (!last.isFirst && last.isWhole) parts.push(regressed > 0 ? countOf(regressed, "new failures") : "no new failure");
  parts.push(`${last.failed} failing`);
  return `${whose}: ${countOf(runs.length, "nights")}; last: ${parts.join(", ")}`;
}

/** "2025-10-01 to 2026-11-23", or the one day. */
export function spanOf(runs: readonly Night[]): string {
  const first = runs[0], last = runs.at(-1);
  if (!first || !last) return "";
  return dayOf(first) === dayOf(last) ? dayOf(first) : `${dayOf(first)} to ${dayOf(last)}`;
}

/** The changes of these kinds (none: of all), and how many more there are that the page does not list. */
export function changesOf(night: Night, kinds: ReadonlySet<string>): { listed: NightChange[]; more: number } {
  const isWanted = (kind: string): boolean => kinds.size === 0 || kinds.has(kind);
  const listed = night.changes.filter((each) => isWanted(each.kind));
  const all = Object.entries(night.events).reduce((sum, [kind, count]) => sum + (isWanted(kind) ? count : 0), 0);
  return { listed, more: Math.max(0, all - listed.length) };
}

/** Whether a figure became better or worse; "" where that cannot be said. */
export function directionOf({ metric, before, after }: TrendChange, statistics: Nights["statistics"]): "better" | "worse" | "" {
  const better = statistics[metric]?.better;
  if (better === undefined || before === null || after === null || before === after) return "";
  const loss = better === "higher" ? before - after : better === "near zero" ? Math.abs(after) - Math.abs(before) : after - before;
  return loss === 0 ? "" : loss > 0 ? "worse" : "better";
}

/** Finds rows that have every word of a query in their name. */
export function rowsWith(rows: Nights["rows"], query: string): [name: string, trend: Trend][] {
  const words = query.toLowerCase().split(/\s+/).filter((each) => each !== "");
  return Object.entries(rows).filter(([name]) => {
    const text = name.toLowerCase();
    return words.every((word) => text.includes(word));
  });
}

export const kOrders = ["last change", "most changes", "name"] as const;
export type Order = (typeof kOrders)[number];

export function inOrder(rows: [name: string, trend: Trend][], order: Order): [name: string, trend: Trend][] {
  const last = (trend: Trend): number => trend.changes.at(-1)?.run ?? -1;
  const byName = (a: string, b: string): number => (a < b ? -1 : a > b ? 1 : 0);
  return [...rows].sort(([a, one], [b, two]) => {
    const difference = order === "last change" ? last(two) - last(one) : order === "most changes" ? two.changes.length - one.changes.length : 0;
    return difference || byName(a, b);
  });
}

/** The figures of a row, the mean of FLIP first. */
export function figuresOf({ figures }: Trend): string[] {
  const names = Object.keys(figures);
  return [...names.filter((each) => each === "flip.mean"), ...names.filter((each) => each !== "flip.mean").sort()];
}
