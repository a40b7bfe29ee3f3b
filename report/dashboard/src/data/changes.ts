// What has changed since the baseline: which rows fail anew, are fixed, are worse or better.
import type { Verdict } from "./types";

/** In the order of the page. A new failure is worse too, and what is fixed is better too. */
export const kChanges = ["new", "fixed", "worse", "better", "added", "not comparable"] as const;
export type ChangeKind = (typeof kChanges)[number];

export const kNoChange: readonly ChangeKind[] = [];

/** A change of FLIP below it reads 0.000. */
export const kLeastChange = 0.0005;

/** Over budget, or broken. */
export function isOver(verdict: Verdict | null): boolean {
  return verdict === "fail" || verdict === "error";
}

/**
 * before: the verdict in the baseline, "new" where it has no such row; null: there is no baseline. change: of mean FLIP.
 * notComparable: the conditions that differ.
 */
export function changesOf(verdict: Verdict, before: Verdict | "new" | null, change: number | null, notComparable: string): readonly ChangeKind[] {
  if (before === null) return kNoChange;
  if (before === "new") return isOver(verdict) ? ["new", "added"] : ["added"];
  if (notComparable !== "") return ["not comparable"];
  if (isOver(verdict) !== isOver(before)) return isOver(verdict) ? ["new", "worse"] : ["fixed", "better"];
  if (Math.abs(change ?? 0) < kLeastChange) return kNoChange;
  return [(change ?? 0) > 0 ? "worse" : "better"];
}

export type ChangeCounts = Record<ChangeKind, number>;

export function countChanges(rows: readonly { changes: readonly ChangeKind[] }[]): ChangeCounts {
  const counts: ChangeCounts = { new: 0, fixed: 0, worse: 0, better: 0, added: 0, "not comparable": 0 };
  for (const { changes } of rows) for (const change of changes) ++counts[change];
  return counts;
}

/** "+3 new failures", "12 fixed", "1 not in the baseline" */
export function changeText(change: ChangeKind, count: number): string {
  if (change === "new") return count === 0 ? "no new failure" : `+${count} new failure${count === 1 ? "" : "s"}`;
  return change === "added" ? `${count} not in the baseline` : `${count} ${change}`;
}
