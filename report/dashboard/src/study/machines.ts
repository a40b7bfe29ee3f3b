// Machines of the nights, and steps in the time of scenes.
import { html, nothing, type TemplateResult } from "lit";

import type { Night, Nights } from "../data/history";
import { machinesOf, shareOf, stepsOf, type Machine, type Step } from "../data/night_machines";
import { dayOf } from "../data/trends";
import { duration, fixed, signed } from "../format";
import { linkOf, type Shown } from "./night_link";
import { table } from "./table";

const kFirst = 15;

/** A table that is long only if the reader wants it. */
function shortTable<Row>(rows: readonly Row[], plural: string, tableOf: (rows: readonly Row[]) => TemplateResult): TemplateResult {
  if (rows.length <= kFirst) return tableOf(rows);
  return html`${tableOf(rows.slice(0, kFirst))}<details><summary>${rows.length - kFirst} earlier ${plural}</summary>${tableOf(rows.slice(kFirst))}</details>`;
}

export function machinesPart({ runs, timings }: Nights, shown: Shown): TemplateResult {
  const link = (night: Night | undefined): TemplateResult => (night ? html`<a class="whole" href=${linkOf({ ...shown, night: night.name })}>${dayOf(night)}</a>` : html`–`);
  const name = (text: string): string => (text === "" ? "not known" : text);
  const whole = (text: string): TemplateResult => html`<span class="whole">${text}</span>`;
  return html`<section><h2>Machines</h2>
      ${shortTable(machinesOf(runs), "machines and builds", (rows) => table<Machine>("Machines", rows, [
        { label: "machine", isText: true, value: (each) => name(each.machine), show: (each) => whole(name(each.machine)) },
        { label: "device", isText: true, value: (each) => name(each.device), show: (each) => whole(name(each.device)) },
        { label: "build", isText: true, value: (each) => each.build, show: (each) => html`<code>${name(each.build.slice(0, 8))}</code>` },
        { label: "nights", value: (each) => each.nights },
        { label: "first", isText: true, value: (each) => each.first.started, show: (each) => link(each.first) },
        { label: "last", isText: true, value: (each) => each.last.started, show: (each) => link(each.last) },
        { label: "median CPU s", value: (each) => each.cpuS, show: (each) => fixed(each.cpuS, 1) },
      ]))}</section>
    ${timings.length === 0 ? nothing : html`<section><h2>Steps in the time of scenes</h2>
      <p class="sub">CPU time of a scene that went up or down by 5 % or more, on one kind of machine. It changes no verdict.</p>
      ${shortTable(stepsOf(timings), "steps", (rows) => table<Step>("Steps in the time of scenes", rows, [
        { label: "scene", isText: true, value: (each) => each.scene },
        { label: "machine", isText: true, value: (each) => name(each.machine), show: (each) => whole(name(each.machine)) },
        { label: "since", isText: true, value: (each) => each.run, show: (each) => link(runs[each.run]) },
        { label: "before", value: (each) => each.beforeMs, show: (each) => duration(each.beforeMs) },
        { label: "now", value: (each) => each.nowMs, show: (each) => duration(each.nowMs) },
        { label: "change", value: shareOf, show: (each) => { const share = shareOf(each); return share === null ? "–" : html`<span class=${share > 0 ? "worse" : "better"}>${signed(100 * share, 0)} %</span>`; } },
      ]))}</section>`}`;
}
