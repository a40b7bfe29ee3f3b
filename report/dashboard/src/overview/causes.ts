// What makes the rows that failed or warned differ: totals by cause, with the worst offenders.
import { html, nothing, type TemplateResult } from "lit";

import type { Group } from "../data/groups";
import type { Head } from "../data/page";
import type { Row } from "../data/rows";
import { kDefaultState, openItem, toHash } from "../data/state";
import { groupLabel, troubleText, worstLinks } from "./group";

const kWorst = 2; // of each cause: a line each; the groups of the list name one more

/** groups: causeTotals. */
export function causesNotice(report: Head, groups: readonly Group[], isOpen: boolean): TemplateResult | typeof nothing {
  if (groups.length === 0) return nothing;
  const hashOf = (row: Row): string => toHash(openItem({ ...kDefaultState }, row.link));
  return html`<details class="notice causes" ?open=${isOpen}>
    <summary>Causes of what failed or warned</summary>
    <ul>${groups.map((group) => html`<li><b>${groupLabel(group, "cause")}</b>: ${troubleText(group)}. Worst: ${worstLinks(group, "cause", report, hashOf, kWorst)}</li>`)}
      <li><a class="all" href=${toHash({ ...kDefaultState, group: "cause" })}>All rows by cause</a></li></ul>
  </details>`;
}
