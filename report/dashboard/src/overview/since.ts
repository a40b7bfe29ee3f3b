// What has changed since the last run of the history, or since the baseline, in lines whose parts are links to the rows
// that they count.
import { html, nothing, type TemplateResult } from "lit";

import { changeText, kBaselineChanges, kChanges, kStandingChanges, type ChangeKind } from "../data/changes";
import type { Facts } from "../data/facts";
import type { EarlierRuns } from "../data/history";
import type { Head } from "../data/page";
import { kDefaultState, toHash } from "../data/state";
import { countOf } from "../data/wording";

/** Whether the rows were held against a baseline. */
export function hasBaseline(report: Head): boolean {
  return report.baseline !== null && report.baseline !== undefined && report.baseline.error === "";
}

/** Those that are said: new and fixed always, so that "no new failure" is said, too. */
export function saidChanges(counts: Readonly<Record<ChangeKind, number>>, of: readonly ChangeKind[] = kChanges): ChangeKind[] {
  return of.filter((change) => change === "new" || change === "fixed" || counts[change] > 0);
}

function link(change: ChangeKind, text: string): TemplateResult {
  return html`<a class=${change.replace(" ", "-")} href=${toHash({ ...kDefaultState, changes: [change] })}>${text}</a>`;
}

function parts(changes: readonly ChangeKind[], counts: Readonly<Record<ChangeKind, number>>): TemplateResult[] {
  return changes.map((change, i) => {
    const text = changeText(change, counts[change]);
    return html`${i > 0 ? ", " : ""}${counts[change] === 0 ? html`<span>${text}</span>` : link(change, text)}`;
  });
}

function sinceBaseline(of: readonly ChangeKind[], { materials: counts, isComparable }: Facts): TemplateResult | typeof nothing {
  if (!isComparable) {
    const number = counts["not comparable"];
    const others = saidChanges(counts, of).filter((change) => change !== "not comparable" && counts[change] > 0);
    return html`<p class="since"><span>Nothing can be compared with the baseline:</span> ${link("not comparable", `${countOf(number, "rows")} ${number === 1 ? "was" : "were"} made under other conditions`)}${others.length > 0 ? ", " : ""}${parts(others, counts)}</p>`;
  }
  const said = saidChanges(counts, of);
  return said.length === 0 ? nothing : html`<p class="since"><span>Since the baseline</span> ${parts(said, counts)}</p>`;
}

/** With a history the failures are held against its last run, and only how far apart the paths are against the baseline. */
export function sinceLines(report: Head, history: EarlierRuns | null, facts: Facts): TemplateResult | typeof nothing {
  if (history === null) return hasBaseline(report) ? sinceBaseline(kChanges, facts) : nothing;
  const { branch } = history;
  const { materials: counts } = facts;
  return html`<p class="since over-runs"><span>Since the last run${branch === "" ? nothing : html` of <bdi>${branch}</bdi>`}:</span> ${parts(saidChanges(counts, kStandingChanges), counts)}</p>
    ${hasBaseline(report) ? sinceBaseline(kBaselineChanges, facts) : nothing}`;
}
