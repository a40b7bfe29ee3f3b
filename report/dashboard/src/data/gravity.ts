// Verdicts by how grave they are.
import type { Verdict } from "./types";

const kVerdicts: readonly Verdict[] = ["pass", "not seen", "too small", "not judged", "warn", "fail", "not run", "error"]; // by gravity

export function gravityOf(verdict: Verdict): number {
  const place = kVerdicts.indexOf(verdict);
  return place < 0 ? kVerdicts.length - 1 : place;
}
