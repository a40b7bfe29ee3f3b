// What narrows the list down: words, verdicts, budgets' presets, terms.
import { html, nothing, type TemplateResult } from "lit";

import { countRows, isListed, sortsUpAtFirst } from "../data/filter";
import type { Row } from "../data/rows";
import type { List, State } from "../data/state";
import type { Report } from "../data/types";
import { count } from "../format";

/** In the order of the keys 1 to 9, the last has none; "": all. */
export const kCategories = [
  { verdict: "", label: "All" },
  { verdict: "fail", label: "Failed" },
  { verdict: "warn", label: "Warned" },
  { verdict: "error", label: "Errors" },
  { verdict: "not judged", label: "Not judged" },
  { verdict: "too small", label: "Too small" },
  { verdict: "not seen", label: "Not seen" },
  { verdict: "pass", label: "Passed" },
  { verdict: "new", label: "New" },
  { verdict: "not run", label: "Not run" },
] as const;

function select(
  label: string,
  value: string,
  values: readonly string[],
  name: (value: string) => string,
  changed: (value: string) => void,
): TemplateResult | typeof nothing {
  if (values.length < 1) return nothing;
  const all = value !== "" && !values.includes(value) ? [...values, value] : values;
  return html`<label class="select">${label}
    <select @change=${(event: Event) => changed((event.target as HTMLSelectElement).value)}>
      <option value="" ?selected=${value === ""}>all</option>
      ${all.map((each) => html`<option value=${each} ?selected=${each === value}>${name(each)}</option>`)}
    </select></label>`;
}

function distinct(values: Iterable<string>): string[] {
  return [...new Set(values)].filter((each) => each !== "").sort();
}

const kSorts: readonly (readonly [string, string])[] = [
  ["gravity", "verdict"], ["flip.mean", "mean FLIP"], ["flip.p95", "p95 FLIP"], ["flip.max", "max FLIP"],
  ["bias", "brightness difference"], ["cause", "share that the cause explains"], ["pixels", "pixels"],
  ["change", "change since the baseline"], ["name", "name"], ["place", "scene and view"], ["order", "order in the report"],
];

/** Every number of the rows, by the names that the report gives its figures. */
export function sortsOf(report: Report): (readonly [string, string])[] {
  const usual = kSorts.filter(([key]) => key !== "change" || report.baseline);
  const others = Object.entries(report.statistics).filter(([key]) => !kSorts.some(([each]) => each === key));
  return [...usual, ...others.map(([key, { label }]) => [key, label] as const)];
}

export function filters(report: Report, rows: readonly Row[], shown: number, state: State, set: (patch: Partial<State>) => void): TemplateResult {
  const listed = rows.filter((row) => isListed(row, state.list));
  const counts = countRows(listed);
  const list = (each: List, label: string): TemplateResult => {
    const of = rows.filter((row) => isListed(row, each));
    const over = of.filter((row) => row.verdict === "fail" || row.verdict === "error").length;
    return html`<button type="button" aria-pressed=${state.list === each ? "true" : "false"} @click=${() => set({ list: each })}>${label} <b>${count(of.length)}</b>${over > 0 ? html`<span class="over" title="failed or errors">✕ ${count(over)}<span class="sr"> failed or errors</span></span>` : nothing}</button>`;
  };
  const toggle = (verdict: string): void => {
    if (verdict === "") return set({ verdicts: [] });
    const has = state.verdicts.includes(verdict);
    set({ verdicts: has ? state.verdicts.filter((each) => each !== verdict) : [...state.verdicts, verdict] });
  };
  return html`<div class="filters" role="search">
    <div class="lists" role="group" aria-label="List">${list("materials", "Materials")}${list("views", "Views")}</div>
    <input
      id="search" type="search" placeholder="Search materials, scenes, reasons" aria-label="Search materials, scenes, reasons"
      .value=${state.query} @input=${(event: Event) => set({ query: (event.target as HTMLInputElement).value })}
    />
    <div class="chips" role="group" aria-label="Verdicts">
      ${kCategories.map(({ verdict, label }, index) => {
        const all = verdict === "";
        const number = all ? listed.length : (counts[verdict] ?? 0);
        if (!all && number === 0) return nothing;
        const pressed = all ? state.verdicts.length === 0 : state.verdicts.includes(verdict);
        return html`<button type="button" class="chip ${verdict.replace(" ", "-")}" aria-pressed=${pressed ? "true" : "false"}
          title=${index < 9 ? `Key ${index + 1}` : ""} @click=${() => toggle(verdict)}>${label} <b>${count(number)}</b></button>`;
      })}
    </div>
    ${select("Cause", state.causedBy, distinct(listed.map((row) => row.cause?.term ?? "")), (term) => term, (causedBy) => set({ causedBy }))}
    ${select("Budget", state.preset, distinct(listed.map((row) => row.preset)), (preset) => preset, (preset) => set({ preset }))}
    <label class="select">Sort
      <select @change=${(event: Event) => {
        const sort = (event.target as HTMLSelectElement).value;
        set({ sort, ascending: sortsUpAtFirst(sort) });
      }}>
        ${sortsOf(report).map(([key, label]) => html`<option value=${key} ?selected=${key === state.sort}>${label}</option>`)}
      </select></label>
    <span class="shown" role="status">${shown === listed.length ? `${count(shown)} rows` : `${count(shown)} of ${count(listed.length)} rows`}</span>
  </div>`;
}
