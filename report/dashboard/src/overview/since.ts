// What has changed since the baseline, in a line whose parts are links to the rows that they count.
import { html, nothing, type TemplateResult } from "lit";

import { changeText, kChanges, type ChangeKind } from "../data/changes";
import type { Facts } from "../data/facts";
import type { Head } from "../data/page";
import { kDefaultState, toHash } from "../data/state";
import { countOf } from "../data/wording";

/** Whether the rows were held against a baseline. */
export function hasBaseline(report: Head): boolean {
  return report.baseline !== null && report.baseline !== undefined && report.baseline.error === "";
}

/** Those that are said: the first two always, so that "no new failure" is said, too. */
export function saidChanges(counts: Readonly<Record<ChangeKind, number>>): ChangeKind[] {
  return kChanges.filter((change) => change === "new" || change === "fixed" || counts[change] > 0);
}

export function sinceBaseline(report: Head, { materials: counts, isComparable }: Facts): TemplateResult | typeof nothing {
  if (!hasBaseline(report)) return nothing;
  const link = (change: ChangeKind, text: string): TemplateResult => html`<a class=${change.replace(" ", "-")} href=${toHash({ ...kDefaultState, changes: [change] })}>${text}</a>`;
  const part = (change: ChangeKind): TemplateResult => {
    const text = changeText(change, counts[change]);
    if (counts[change] === 0) return html`<span>${text}</span>`;
    return link(change, text);
  };
  if (!isComparable) {
    const number = counts["not comparable"];
    const others = saidChanges(counts).filter((change) => change !== "not comparable" && counts[change] > 0);
    return html`<p class="since"><span>Nothing can be compared with the baseline:</span> ${link("not comparable", `${countOf(number, "rows")} ${number === 1 ? "was" : "were"} made under other conditions`)}${others.map((change) => html`, ${part(change)}`)}</p>`;
  }
  return html`<p class="since"><span>Since the baseline</span> ${saidChanges(counts).map((change, i) => html`${i > 0 ? ", " : ""}${part(change)}`)}</p>`;
}
