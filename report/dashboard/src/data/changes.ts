// Where rows stand: which fail anew, still fail, are fixed, accepted or flaky; and what is worse or better than in the
// baseline.
import type { Standing } from "./history";
import type { Verdict } from "./types";

/** By the standing: since the last run of the history where there is one, else since the baseline. */
export const kStandingChanges = ["new", "fixed", "still", "flaky", "accepted"] as const;
/** By the baseline alone. */
export const kBaselineChanges = ["worse", "better", "added", "not comparable"] as const;
/** In the order of the page. A new failure may be worse too, and what is fixed better too. */
export const kChanges = [...kStandingChanges, ...kBaselineChanges] as const;
export type ChangeKind = (typeof kChanges)[number];

export const kNoChange: readonly ChangeKind[] = [];

/** A change of FLIP below it reads 0.000. */
export const kLeastChange = 0.0005;

/** "new failure", "failing for 12 nights", "fixed", "flaky", "accepted"; "" where nothing is to be said. nights: 0: not known. */
export function standingWords(standing: Standing, nights: number): string {
  if (standing === "new") return "new failure";
  if (standing === "still") return nights > 1 ? `failing for ${nights} nights` : "still failing";
  return standing === "unknown" ? "" : standing;
}

/** Over budget, or broken. */
export function isOver(verdict: Verdict | null): boolean {
  return verdict === "fail" || verdict === "error";
}

/** The part of a standing that is counted and filtered by. */
function changesOfStanding(standing: Standing): readonly ChangeKind[] {
  return standing === "" || standing === "unknown" ? kNoChange : [standing];
}

/** before: the verdict in the baseline, "new" where it has no such row; null: there is no baseline. change: of mean FLIP. */
function changesSince(verdict: Verdict, before: Verdict | "new" | null, change: number | null, notComparable: string): readonly ChangeKind[] {
  if (before === null) return kNoChange;
  if (before === "new") return ["added"];
  if (notComparable !== "") return ["not comparable"];
  if (isOver(verdict) !== isOver(before)) return [isOver(verdict) ? "worse" : "better"];
  if (Math.abs(change ?? 0) < kLeastChange) return kNoChange;
  return [(change ?? 0) > 0 ? "worse" : "better"];
}

/** notComparable: the conditions that differ from the baseline's. */
export function changesOf(verdict: Verdict, before: Verdict | "new" | null, change: number | null, notComparable: string, standing: Standing): readonly ChangeKind[] {
  const since = changesSince(verdict, before, change, notComparable);
  const own = changesOfStanding(standing);
  return own.length === 0 ? since : since.length === 0 ? own : [...own, ...since];
}

export type ChangeCounts = Record<ChangeKind, number>;

export function countChanges(rows: readonly { changes: readonly ChangeKind[] }[]): ChangeCounts {
  const counts: ChangeCounts = { new: 0, fixed: 0, still: 0, flaky: 0, accepted: 0, worse: 0, better: 0, added: 0, "not comparable": 0 };
  for (const { changes } of rows) for (const change of changes) ++counts[change];
  return counts;
}

/** "+3 new failures", "2 fixed", "12 still failing", "1 not in the baseline" */
export function changeText(change: ChangeKind, count: number): string {
  if (change === "new") return count === 0 ? "no new failure" : `+${count} new failure${count === 1 ? "" : "s"}`;
  if (change === "still") return `${count} still failing`;
  return change === "added" ? `${count} not in the baseline` : `${count} ${change}`;
}
