// What has changed since the baseline, in a line whose parts are links to the rows that they count.
import { html, nothing, type TemplateResult } from "lit";

import { changeText, countChanges, kChanges, type ChangeKind } from "../data/changes";
import type { Row } from "../data/rows";
import { kDefaultState, toHash } from "../data/state";
import type { Report } from "../data/types";

/** Whether the rows were held against a baseline. */
export function hasBaseline(report: Report): boolean {
  return report.baseline !== null && report.baseline !== undefined && report.baseline.error === "";
}

/** Those that are said: the first two always, so that "no new failure" is said, too. */
export function saidChanges(counts: Readonly<Record<ChangeKind, number>>): ChangeKind[] {
  return kChanges.filter((change) => change === "new" || change === "fixed" || counts[change] > 0);
}

export function sinceBaseline(report: Report, rows: readonly Row[]): TemplateResult | typeof nothing {
  if (!hasBaseline(report)) return nothing;
  const counts = countChanges(rows.filter((row) => row.kind === "material"));
  const part = (change: ChangeKind): TemplateResult => {
    const text = changeText(change, counts[change]);
    if (counts[change] === 0) return html`<span>${text}</span>`;
    return html`<a class=${change.replace(" ", "-")} href=${toHash({ ...kDefaultState, changes: [change] })}>${text}</a>`;
  };
  return html`<p class="since"><span>Since the baseline</span> ${saidChanges(counts).map((change, i) => html`${i > 0 ? ", " : ""}${part(change)}`)}</p>`;
}
