// The data blocks of a page that is no report's: a sweep's, a stress run's, or that of nightly runs.
import { sweepOf, type Sweep } from "./bench";
import type { Nights } from "./history";
import { nightsOf } from "./nights";
import { hasBlock, parseBlock, type Problem } from "./page";
import { reasonOf } from "./reason";
import type { Stress, StressTimes } from "./stress";

export type Study = { kind: "sweep"; sweep: Sweep } | { kind: "stress"; stress: Stress; times: StressTimes | null } | { kind: "nights"; nights: Nights };

/** null where the page is of a report. */
export function readStudy(document: Document): Study | Problem | null {
  try {
    if (hasBlock(document, "report")) return null;
    if (hasBlock(document, "stress"))
      return { kind: "stress", stress: parseBlock(document, "stress") as Stress, times: parseBlock(document, "stress-times") as StressTimes | null };
    if (hasBlock(document, "nights")) {
      const nights = nightsOf(parseBlock(document, "nights"));
      return "problem" in nights ? nights : { kind: "nights", nights };
    }
    if (!hasBlock(document, "bench")) return null;
    const sweep = sweepOf(parseBlock(document, "bench"), parseBlock(document, "bench-plots"));
    return sweep ? { kind: "sweep", sweep } : { problem: "This page cannot read the form of its data." };
  } catch (error) {
    return { problem: `Its data is damaged: ${reasonOf(error)}.` };
  }
}
