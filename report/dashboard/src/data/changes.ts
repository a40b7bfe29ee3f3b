// What has changed since the baseline: which rows fail anew, are fixed, are worse or better.
import type { Judged } from "./judged";
import type { Verdict } from "./types";

/** In the order of the page. A new failure is worse too, and what is fixed is better too. */
export const kChanges = ["new", "fixed", "worse", "better", "added", "not comparable"] as const;
export type ChangeKind = (typeof kChanges)[number];

/** A change of FLIP below it reads 0.000. */
export const kLeastChange = 0.0005;

/** Over budget, or broken. */
export function isOver(verdict: Verdict | null): boolean {
  return verdict === "fail" || verdict === "error";
}

/** Of mean FLIP since the baseline; null where the baseline has nothing to compare with. */
export function flipChangeOf({ baseline }: Judged): number | null {
  return !baseline || baseline.new ? null : (baseline.changes["flip.mean"] ?? null);
}

export function changesOf(judged: Judged): ChangeKind[] {
  const { baseline, verdict } = judged;
  if (!baseline) return [];
  if (baseline.new) return isOver(verdict) ? ["new", "added"] : ["added"];
  if (baseline.notComparable !== "") return ["not comparable"];
  if (isOver(verdict) !== isOver(baseline.verdict)) return isOver(verdict) ? ["new", "worse"] : ["fixed", "better"];
  const change = flipChangeOf(judged) ?? 0;
  if (Math.abs(change) < kLeastChange) return [];
  return [change > 0 ? "worse" : "better"];
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
