// One scale for the bars of a figure, so that bars of different rows compare.
import { realOf } from "./columns";
import type { Limit } from "./overview";
import { checkOf, type Row } from "./rows";

const kSteps = [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 10];

/** The least round number that is not below the value; 0 for nothing above 0. */
export function roundUp(value: number): number {
  if (!(value > 0) || !Number.isFinite(value)) return 0;
  const power = 10 ** Math.floor(Math.log10(value));
  const step = kSteps.find((each) => each * power >= value * (1 - 1e-9)) ?? 10;
  return Number((step * power).toPrecision(2));
}

/** What a full bar means: the largest value of the rows and of the limits that judge them, rounded up; never 0. */
export function barScale(rows: readonly Row[], metric: string): number {
  let [figure, limit] = [0, 0];
  const seen = new Set<readonly Limit[]>(); // rows with the same limits share them
  for (const row of rows) {
    const value = Math.abs(row.packedFigure(metric)); // or NaN
    if (value > figure) figure = value;
    if (seen.has(row.limits)) continue;
    seen.add(row.limits);
    const check = checkOf(row, metric);
    limit = Math.max(limit, check?.fail ?? check?.warn ?? 0);
  }
  return roundUp(Math.max(realOf(figure) ?? 0, limit)) || 1;
}

/** Shares of a bar's width, 0..100, for a value and its limits. */
export function barShares(
  value: number,
  limits: { warn: number | null; fail: number | null },
  most: number,
): { value: number; warn: number | null; fail: number | null } {
  const share = (x: number): number => Math.min(100, Math.max(0, (x / Math.max(most, 1e-9)) * 100));
  const mark = (x: number | null): number | null => (x === null || x > most ? null : share(x));
  return { value: share(value), warn: mark(limits.warn), fail: mark(limits.fail) };
}
