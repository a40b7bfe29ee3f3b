// What the earlier runs say of one row: found in its scene's file, and in words.
import { isOver } from "./changes";
import type { EarlierRun, RowTrend, SceneTrends, Standing, TrendChange, VerdictSpan } from "./history";
import { runInText } from "./trends";
import type { Verdict } from "./types";
import { countOf } from "./wording";

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

const isSpan = (value: unknown): boolean => Array.isArray(value) && Number.isInteger(value[0]) && Number.isInteger(value[1]);

/** A row's trend, checked as far as the page relies on it; null where it is none. */
function trendOf(value: unknown): RowTrend | null {
  if (!isObject(value)) return null;
  const { figures, verdicts, changes, approved } = value;
  if (!isObject(figures) || !Object.values(figures).every((spans) => Array.isArray(spans) && spans.every(isSpan))) return null;
  if (!Array.isArray(verdicts) || !verdicts.every(isSpan) || !Array.isArray(changes) || !changes.every(isObject)) return null;
  if (approved !== undefined && !(isObject(approved) && Number.isInteger(approved["run"]) && isObject(approved["images"]))) return null;
  return value as unknown as RowTrend;
}

/** What the file of a scene says of the runs; null where it says nothing, or not in this form. Of a damaged row nothing is known. */
export function trendsOf(value: unknown): SceneTrends | null {
  if (!isObject(value) || !Array.isArray(value["views"]) || !value["views"].every(Array.isArray)) return null;
  return { views: (value["views"] as unknown[][]).map((rows) => rows.map(trendOf)) };
}

/** Of a row: its view's materials come first, then its whole image. material: -1: the whole image. */
export function rowTrendOf(trends: SceneTrends | null, view: number, material: number, materials: number): RowTrend | null {
  return trends?.views[view]?.[material < 0 ? materials : material] ?? null;
}

/** The figures, the one that budgets usually limit first. */
export function figuresOf(trend: RowTrend): string[] {
  const names = Object.keys(trend.figures);
  return names.includes("flip.mean") ? ["flip.mean", ...names.filter((name) => name !== "flip.mean")] : names;
}

/** The first run of those, up to the last one, in which the row was seen and failed; -1: it did not fail when it was seen last. */
export function failsSince(verdicts: readonly VerdictSpan[]): number {
  let since = -1;
  for (const [first, , verdict] of [...verdicts].reverse()) {
    if (!isOver(verdict)) break;
    since = first;
  }
  return since;
}

/** Why it fails since a run: that run's gravest change; null: not known. */
export function causeAt(changes: readonly TrendChange[], run: number): TrendChange | null {
  const there = changes.filter((change) => change.run === run);
  return there.find(({ kind, cause }) => cause !== "" && kind !== "changed") ?? there.find(({ cause }) => cause !== "") ?? there[0] ?? null;
}

/** "Fails for 12 nights, since 2026-11-21 (010e2b14a553); cause: asset." */
export function trendSentence(row: { standing: Standing; nights: number; verdict: Verdict }, trend: RowTrend, runs: readonly EarlierRun[]): string {
  const { standing, nights, verdict } = row;
  const since = failsSince(trend.verdicts);
  const last = trend.verdicts.at(-1);
  const lastSeen = last === undefined ? "" : `, in the run of ${runInText(runs[last[1]])}`;
  if (isOver(verdict)) {
    const flaky = standing === "flaky" ? "Flaky: the same inputs gave other results, or crashed, in one of the last runs. " : "";
    if (since < 0) return `${flaky}Fails since this run: ${last === undefined ? "no earlier run has a verdict of it" : `it did not fail before${lastSeen}`}.`;
    const cause = causeAt(trend.changes, since)?.cause ?? "";
    const howLong = nights > 0 ? ` for ${countOf(nights, "nights")}, since` : " since";
    return `${flaky}Fails${howLong} ${since === 0 ? "the first run that is known, " : ""}${runInText(runs[since])}${cause === "" ? "" : `; cause: ${cause}`}.`;
  }
  if (since >= 0) return standing === "accepted" ? `Accepted now: it failed before${lastSeen}.` : `Does not fail any more: it failed before${lastSeen}.`;
  const change = trend.changes.filter(({ kind }) => kind !== "new").at(-1);
  if (change === undefined) return "Has not changed in the runs that are known.";
  return `Last change: ${runInText(runs[change.run])}, ${change.kind}${change.cause === "" ? "" : `, cause: ${change.cause}`}.`;
}
