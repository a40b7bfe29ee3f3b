// The head of the list: columns that sort, and the scale of their bars.
import { html, nothing, type TemplateResult } from "lit";

import { sortsUpAtFirst } from "../data/filter";
import { pathTitle } from "../data/paths";
import type { State } from "../data/state";
import type { Head } from "../data/page";
import { help, type Topic } from "../help";
import { hasBaseline } from "./since";

interface Column {
  key: string;
  label: string;
  topic?: Topic;
}

const kColumns: readonly Column[] = [
  { key: "gravity", label: "Verdict" },
  { key: "name", label: "Material" },
  { key: "flip.mean", label: "Mean FLIP", topic: "mean" },
  { key: "flip.p95", label: "p95", topic: "p95" },
  { key: "flip.max", label: "Max", topic: "max" },
  { key: "change", label: "Change", topic: "change" },
  { key: "bias", label: "Bias", topic: "bias" },
  { key: "cause", label: "Cause", topic: "worstTerm" },
  { key: "pixels", label: "Pixels", topic: "pixels" },
];

/** The figures that the list shows as bars. */
export const kBarFigures: readonly string[] = ["flip.mean", "flip.p95", "flip.max"];

export function listHead(
  report: Head,
  { sort, ascending, list }: State,
  scales: Readonly<Record<string, number>>,
  set: (patch: Partial<State>) => void,
): TemplateResult {
  const sortBy = (key: string) => (): void => set({ sort: key, ascending: sort === key ? !ascending : sortsUpAtFirst(key) });
  const columns = kColumns.filter(({ key }) => key !== "change" || hasBaseline(report));
  return html`<div class="list-head" role="rowgroup"><div class="row-grid" role="row" aria-rowindex="1">
    <span role="columnheader" class="cell-pictures">Pictures</span>
    ${columns.map(({ key, label, topic }) => {
      const order = sort !== key ? "none" : ascending ? "ascending" : "descending";
      const most = scales[key];
      return html`<span role="columnheader" class=${"cell-" + key.replace(".", "-")} aria-sort=${order}>
        <button type="button" class="sort" @click=${sortBy(key)}>
          ${key === "name" && list === "views" ? "View" : label}<span aria-hidden="true" class="arrow">${order === "none" ? "" : ascending ? " ▲" : " ▼"}</span>
        </button>${topic ? help(topic) : nothing}
        ${most === undefined ? nothing : html`<small class="scale" title="Scale of the bars in this column"><span>0</span><span>${most}</span></small>`}</span>`;
    })}</div></div>`;
}

/** tests: the paths that are tested. What a head of columns would say, where there is no room for one. */
export function listNote(tests: readonly string[], scales: Readonly<Record<string, number>>, compact: boolean): TemplateResult {
  const most = scales["flip.mean"];
  return html`<p class="list-note">${compact ? `Picture: ${tests.map(pathTitle).join(" or ")}. Number: mean FLIP.` : `Number and bar: mean FLIP${most === undefined ? "" : `, 0 to ${most}`}.`}</p>`;
}
