// All nights as a table, the newest first.
import { html, nothing, type TemplateResult } from "lit";

import type { Night } from "../data/history";
import { eventsOf, remarksOf } from "../data/nights";
import { dayOf } from "../data/trends";
import { count, fixed, significant } from "../format";
import { badge } from "../parts";
import { kindBadge } from "./change_words";
import { linkOf, type Shown } from "./night_link";
import { table } from "./table";

export const kFirstNights = 30;

function whatChanged(night: Night): TemplateResult {
  const events = eventsOf(night), remarks = remarksOf(night);
  if (events.length + remarks.length === 0) return html`<small>nothing</small>`;
  return html`<span class="what">${events.map(({ kind, count: number }) => kindBadge(kind, number))}${remarks.map((each) => html`<small>${each}</small>`)}</span>`;
}

/** runs: oldest first. more: is called when the reader asks for all of them. */
export function nightTable(runs: readonly Night[], selected: Night | undefined, shown: Shown, isAll: boolean, more: () => void): TemplateResult {
  const newest = [...runs].reverse().slice(0, isAll ? undefined : kFirstNights);
  const hasMachines = new Set(runs.map((each) => each.machine)).size > 1;
  return html`${table<Night>("Nights", newest, [
      { label: "night", isText: true, value: (each) => each.started, show: (each) => html`<a class="whole" href=${linkOf({ ...shown, night: each.name })} aria-current=${each === selected}>${dayOf(each)}</a>` },
      { label: "verdict", isText: true, value: (each) => each.verdict, show: (each) => badge(each.verdict) },
      { label: "what changed", isText: true, value: (each) => eventsOf(each).map(({ kind, count: number }) => `${kind} ${number}`).join(), show: whatChanged },
      { label: "failed", value: (each) => each.failed, show: (each) => count(each.failed) },
      { label: "warned", value: (each) => each.warned, show: (each) => count(each.warned) },
      { label: "rows", value: (each) => each.rows, show: (each) => count(each.rows) },
      { label: "worst FLIP", value: (each) => each.worst?.flip, show: (each) => (each.worst ? significant(each.worst.flip, 4) : "–") },
      { label: "of row", isText: true, value: (each) => each.worst?.row, show: (each) => html`<span class="row-name">${each.worst?.row ?? ""}</span>` },
      { label: "CPU s", value: (each) => each.cpuS, show: (each) => fixed(each.cpuS, 1) },
      { label: "commit", isText: true, value: (each) => each.commit, show: (each) => html`<code>${each.commit.slice(0, 12)}</code>` },
      { label: "build", isText: true, value: (each) => each.build, show: (each) => html`<code>${each.build.slice(0, 8)}</code>` },
      ...(hasMachines ? [{ label: "machine", isText: true, value: (each: Night) => each.machine, show: (each: Night) => html`<span class="whole">${each.machine}</span>` }] : []),
    ], (each) => (each === selected ? "plain" : ""))}
    ${newest.length < runs.length ? html`<button type="button" @click=${more}>Show all ${count(runs.length)}</button>` : nothing}`;
}
