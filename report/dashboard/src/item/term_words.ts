// What a term's light, and a swap of it, come to in words.
import type { TermLight } from "../data/types";
import { fixed } from "../format";

/** log2(test/reference); null where either is dark. */
export function termBiasEv(term: TermLight): number | null {
  if (term.reference === null || term.test === null || term.reference <= 1e-6 || term.test <= 1e-6) return null;
  return Math.log2(term.test / term.reference);
}

/** How a term's light differs, in words. test: the path's name. */
export function describeTerm(term: TermLight, test: string): string {
  const dark = (value: number | null): boolean => value === null || value <= 1e-6;
  if (dark(term.reference) && dark(term.test)) return "black in both";
  if (dark(term.test)) return `${test} has none`;
  if (dark(term.reference)) return `only ${test} has it`;
  const ev = termBiasEv(term) ?? 0;
  return Math.abs(ev) < 0.005 ? "equal" : `${test} ${fixed(Math.abs(ev), 2)} EV ${ev < 0 ? "darker" : "brighter"}`;
}

/** Whether a swap helps; a change of less than half a percent is none. */
export function effectOf(after: number | null, before: number | null): "better" | "worse" | "same" {
  if (after === null || before === null || Math.abs(after - before) < 0.005 * before) return "same";
  return after < before ? "better" : "worse";
}
