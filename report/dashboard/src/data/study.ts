// The data blocks of a page that is no report's: a sweep's or a stress run's.
import { sweepOf, type Sweep } from "./bench";
import { hasBlock, parseBlock, type Problem } from "./page";
import { reasonOf } from "./reason";
import type { Stress, StressTimes } from "./stress";

export type Study = { kind: "sweep"; sweep: Sweep } | { kind: "stress"; stress: Stress; times: StressTimes | null };

/** null where the page is of a report. */
export function readStudy(document: Document): Study | Problem | null {
  try {
    if (hasBlock(document, "report")) return null;
    if (hasBlock(document, "stress"))
      return { kind: "stress", stress: parseBlock(document, "stress") as Stress, times: parseBlock(document, "stress-times") as StressTimes | null };
    if (!hasBlock(document, "bench")) return null;
    const sweep = sweepOf(parseBlock(document, "bench"), parseBlock(document, "bench-plots"));
    return sweep ? { kind: "sweep", sweep } : { problem: "This page cannot read the form of its data." };
  } catch (error) {
    return { problem: `Its data is damaged: ${reasonOf(error)}.` };
  }
}
