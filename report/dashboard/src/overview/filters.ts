// What narrows the list down and orders it: words, verdicts, standings, changes, budgets' presets, terms, groups.
import { html, nothing, type TemplateResult } from "lit";

import { kBaselineChanges, kChanges, kStandingChanges, type ChangeCounts, type ChangeKind } from "../data/changes";
import type { Facts, ListFacts } from "../data/facts";
import { sortsUpAtFirst } from "../data/filter";
import { groupingsOf } from "../data/groups";
import type { EarlierRuns } from "../data/history";
import type { Head } from "../data/page";
import type { Grouping, List, State } from "../data/state";
import { countOf } from "../data/wording";
import { count } from "../format";
import { termLabel } from "../viewer/terms";
import { hasBaseline } from "./since";

/** In the order of the keys 1 to 9; "": all. */
export const kCategories = [
  { verdict: "", label: "All" },
  { verdict: "fail", label: "Failed" },
  { verdict: "warn", label: "Warned" },
  { verdict: "error", label: "Errors" },
  { verdict: "not judged", label: "Not judged" },
  { verdict: "too small", label: "Too small" },
  { verdict: "not seen", label: "Not seen" },
  { verdict: "pass", label: "Passed" },
  { verdict: "not run", label: "Not run" },
] as const;

const kChangeNames: Readonly<Record<ChangeKind, string>> = {
  new: "New failures", fixed: "Fixed", still: "Still failing", flaky: "Flaky", accepted: "Accepted", worse: "Worse", better: "Better", added: "Not in the baseline", "not comparable": "Not comparable",
};
const kGroupNames: Readonly<Record<Grouping, string>> = { none: "nothing", material: "material", scene: "scene", cause: "cause" };

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

const kSorts: readonly (readonly [string, string])[] = [
  ["gravity", "verdict"], ["flip.mean", "mean FLIP"], ["flip.p95", "p95 FLIP"], ["flip.max", "max FLIP"],
  ["bias", "brightness difference"], ["cause", "share that the cause explains"], ["pixels", "pixels"],
  ["change", "change since the baseline"], ["nights", "nights failing"], ["name", "name"], ["place", "scene and view"], ["order", "order in the report"],
];

/** Every number of the rows, by the names that the report gives its figures. */
export function sortsOf(report: Head, history: EarlierRuns | null): (readonly [string, string])[] {
  const usual = kSorts.filter(([key]) => (key !== "change" || hasBaseline(report)) && (key !== "nights" || history !== null));
  const others = Object.entries(report.statistics).filter(([key]) => !kSorts.some(([each]) => each === key));
  return [...usual, ...others.map(([key, { label }]) => [key, label] as const)];
}

/** Whether a value is in a list, and what the list is with it taken out or put in. */
function toggled(values: readonly string[], value: string): string[] {
  return values.includes(value) ? values.filter((each) => each !== value) : [...values, value];
}

function verdictChips(listed: ListFacts, state: State, set: (patch: Partial<State>) => void): TemplateResult {
  return html`<div class="chips" role="group" aria-label="Verdicts">
    ${kCategories.map(({ verdict, label }, index) => {
      const all = verdict === "";
      const number = all ? listed.rows : (listed.verdicts[verdict] ?? 0);
      if (!all && number === 0) return nothing;
      const pressed = all ? state.verdicts.length === 0 : state.verdicts.includes(verdict);
      return html`<button type="button" class="chip ${verdict.replace(" ", "-")}" aria-pressed=${pressed ? "true" : "false"}
        title=${index < 9 ? `Key ${index + 1}` : ""} @click=${() => set({ verdicts: all ? [] : toggled(state.verdicts, verdict) })}>${label} <b>${count(number)}</b></button>`;
    })}
  </div>`;
}

function chipsOf(name: string, of: readonly ChangeKind[], counts: ChangeCounts, state: State, set: (patch: Partial<State>) => void): TemplateResult | typeof nothing {
  const shown = of.filter((change) => counts[change] > 0 || state.changes.includes(change));
  if (shown.length === 0) return nothing;
  return html`<div class="chips changes" role="group" aria-label=${name}><span class="chips-name" aria-hidden="true">${name}</span>
    ${shown.map((change) => {
      const pressed = state.changes.includes(change);
      return html`<button type="button" class="chip ${change.replace(" ", "-")}" aria-pressed=${pressed ? "true" : "false"}
        @click=${() => set({ changes: toggled(state.changes, change) })}>${kChangeNames[change]} <b>${count(counts[change])}</b></button>`;
    })}
  </div>`;
}

/** With a history and a baseline there are two groups, because they are held against different runs. */
function changeChips({ report, history, facts, state, set }: FilterScene): TemplateResult {
  const counts = facts.lists[state.list].changes;
  const chips = (name: string, of: readonly ChangeKind[]): TemplateResult | typeof nothing => chipsOf(name, of, counts, state, set);
  if (history !== null) return html`${chips("Over the runs", kStandingChanges)}${chips("Since the baseline", kBaselineChanges)}`;
  return html`${chips(hasBaseline(report) ? "Since the baseline" : "Standing", kChanges)}`;
}

function groupChoice(state: State, set: (patch: Partial<State>) => void): TemplateResult {
  const groupings = groupingsOf(state.list);
  const shown = groupings.includes(state.group) ? state.group : "none";
  return html`<label class="select">Group by
      <select class="grouping" @change=${(event: Event) => set({ group: (event.target as HTMLSelectElement).value as Grouping })}>
        ${groupings.map((each) => html`<option value=${each} ?selected=${each === shown}>${kGroupNames[each]}</option>`)}
      </select></label>
    ${shown === "none" ? nothing : html`<button type="button" class="fold-all" aria-pressed=${state.folded ? "true" : "false"} @click=${() => set({ folded: !state.folded })}>Totals only</button>`}`;
}

function sortChoice({ report, history, state, set }: FilterScene): TemplateResult {
  return html`<label class="select">Sort
    <select @change=${(event: Event) => {
      const sort = (event.target as HTMLSelectElement).value;
      set({ sort, ascending: sortsUpAtFirst(sort) });
    }}>
      ${sortsOf(report, history).map(([key, label]) => html`<option value=${key} ?selected=${key === state.sort}>${label}</option>`)}
    </select></label>`;
}

export interface FilterScene {
  report: Head;
  history: EarlierRuns | null;
  facts: Facts;
  shown: number;
  state: State;
  fold: Fold | null; // all but the search folds away; null: there is room for all
  set: (patch: Partial<State>) => void;
}

export interface Fold {
  isFolded: boolean;
  toggle: () => void;
}

export function filters(scene: FilterScene): TemplateResult {
  const { facts, shown, state, fold, set } = scene;
  const listed = facts.lists[state.list];
  const list = (each: List, label: string): TemplateResult => {
    const { rows, over } = facts.lists[each];
    return html`<button type="button" aria-pressed=${state.list === each ? "true" : "false"} @click=${() => set({ list: each })}>${label} <b>${count(rows)}</b>${over > 0 ? html`<span class="over" title="failed or errors">✕ ${count(over)}<span class="sr"> failed or errors</span></span>` : nothing}</button>`;
  };
  const active = [state.verdicts.length > 0, state.changes.length > 0, state.causedBy !== "", state.preset !== "", state.group !== "none"].filter(Boolean).length;
  const causeName = (term: string): string => `${term}: ${termLabel(term)} (${count(listed.causes.get(term) ?? 0)})`;
  return html`<div class="filters" role="search">
    <div class="lists" role="group" aria-label="List">${list("materials", "Materials")}${list("views", "Views")}</div>
    <input
      id="search" type="search" placeholder="Search materials, scenes, reasons" aria-label="Search materials, scenes, reasons"
      .value=${state.query} @input=${(event: Event) => set({ query: (event.target as HTMLInputElement).value })}
    />
    ${fold === null ? nothing : html`<button type="button" class="fold" aria-expanded=${fold.isFolded ? "false" : "true"} aria-controls="filter-choices" @click=${fold.toggle}>
      Filter, group, sort${active > 0 ? ` (${active})` : ""} <span aria-hidden="true">${fold.isFolded ? "▾" : "▴"}</span></button>`}
    <div class="choices" id="filter-choices" ?hidden=${fold?.isFolded ?? false}>
      ${select("Cause", state.causedBy, [...listed.causes.keys()], causeName, (causedBy) => set({ causedBy }))}
      ${select("Budget", state.preset, listed.presets, (preset) => preset, (preset) => set({ preset }))}
      ${groupChoice(state, set)} ${sortChoice(scene)} ${verdictChips(listed, state, set)}
      ${changeChips(scene)}
    </div>
    <span class="shown" role="status">${shown === listed.rows ? countOf(shown, "rows") : `${count(shown)} of ${countOf(listed.rows, "rows")}`}</span>
  </div>`;
}
