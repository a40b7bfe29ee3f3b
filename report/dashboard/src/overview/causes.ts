// What makes the rows that failed or warned differ: totals by cause, with the worst offenders.
import { html, nothing, type TemplateResult } from "lit";

import { groupRows, kUnknownCause, type Group } from "../data/groups";
import { isOver } from "../data/changes";
import type { Row } from "../data/rows";
import { kDefaultState, openItem, toHash } from "../data/state";
import type { Report } from "../data/types";
import { groupLabel, troubleText, worstLinks } from "./group";

const kWorst = 2; // of each cause: a line each; the groups of the list name one more

/** Of materials that failed or warned; the cause of most failures first. */
export function causeTotals(rows: readonly Row[]): Group[] {
  const troubled = rows.filter((row) => row.kind === "material" && (isOver(row.verdict) || row.verdict === "warn"));
  return groupRows(troubled, "cause").sort(
    // What is not known helps least, as in the terminal's table.
    (a, b) => Number(a.label === kUnknownCause) - Number(b.label === kUnknownCause) || b.over - a.over || b.rows.length - a.rows.length,
  );
}

export function causesNotice(report: Report, rows: readonly Row[], isOpen: boolean): TemplateResult | typeof nothing {
  const groups = causeTotals(rows);
  if (groups.length === 0) return nothing;
  const hashOf = (row: Row): string => toHash(openItem({ ...kDefaultState }, row.link));
  return html`<details class="notice causes" ?open=${isOpen}>
    <summary>Causes of what failed or warned</summary>
    <ul>${groups.map((group) => html`<li><b>${groupLabel(group, "cause")}</b>: ${troubleText(group)}. Worst: ${worstLinks(group, "cause", report, hashOf, kWorst)}</li>`)}
      <li><a class="all" href=${toHash({ ...kDefaultState, group: "cause" })}>All rows by cause</a></li></ul>
  </details>`;
}
