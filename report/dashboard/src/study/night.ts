// One night: what ran, and what changed, by kind.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";

import type { Night, NightChange, Nights } from "../data/history";
import { changesOf, eventsOf, kKinds, remarksOf, timeOf } from "../data/nights";
import { countOf } from "../data/wording";
import { PageElement } from "../element";
import { count, duration, fixed, significant } from "../format";
import { badge, definitions } from "../parts";
import { causeOf, figureChange, kindBadge, otherFigures } from "./change_words";
import { linkOf } from "./night_link";
import { table } from "./table";

const kFirst = 50; // changes that are shown at first

@customElement("parity-night")
export class ParityNight extends PageElement {
  @property({ attribute: false }) nights!: Nights;
  @property({ attribute: false }) night!: Night;
  @state() private kinds: ReadonlySet<string> = new Set(); // none: all
  @state() private isAll = false;

  protected override willUpdate(changed: PropertyValues<this>): void {
    if (!changed.has("night")) return;
    this.kinds = new Set();
    this.isAll = false;
  }

  private toggle(kind: string): void {
    const kinds = new Set(this.kinds);
    if (!kinds.delete(kind)) kinds.add(kind);
    this.kinds = kinds;
  }

  private chips(): TemplateResult | typeof nothing {
    const events = eventsOf(this.night);
    if (events.length < 2) return nothing;
    return html`<div class="chips" role="group" aria-label="Kinds of changes">
      ${events.map(({ kind, count: number }) => html`<button type="button" class="chip kind-${kind}" aria-pressed=${this.kinds.has(kind)} @click=${() => this.toggle(kind)}>${kind} ${count(number)}</button>`)}
    </div>`;
  }

  /** A row that the page has the runs of is a link to them. */
  private rowName(row: string): TemplateResult {
    return Object.hasOwn(this.nights.rows, row) ? html`<a href=${linkOf({ night: this.night.name, row, figure: "" })}>${row}</a>` : html`${row}`;
  }

  private changes(): TemplateResult {
    const { listed, more } = changesOf(this.night, this.kinds);
    if (listed.length === 0 && more === 0) return html`<p>${remarksOf(this.night).length === 0 ? "Nothing changed." : "No changes: it was not compared, or nothing changed."}</p>`;
    const shown = this.isAll ? listed : listed.slice(0, kFirst);
    const { statistics } = this.nights;
    return html`${this.chips()}
      ${table<NightChange>("Changes of the night", shown, [
        { label: "row", isText: true, value: (each) => each.row, show: (each) => html`<span class="row-name">${this.rowName(each.row)}</span>` },
        { label: "what happened", isText: true, value: (each) => (kKinds as readonly string[]).indexOf(each.kind), show: (each) => kindBadge(each.kind) },
        { label: "figure that changed most", isText: true, value: (each) => each.metric, show: (each) => figureChange(each, statistics) },
        { label: "others", isText: true, value: (each) => each.figures, show: (each) => html`<span class="whole">${otherFigures(each)}</span>` },
        { label: "cause", isText: true, value: causeOf },
      ])}
      ${shown.length < listed.length ? html`<button type="button" @click=${() => (this.isAll = true)}>Show all ${count(listed.length)}</button>` : nothing}
      ${more > 0 ? html`<p class="aside">And ${count(more)} more, which this page does not list.</p>` : nothing}`;
  }

  protected override render(): TemplateResult {
    const { night } = this;
    const cache = night.scenes > 0 ? `${count(night.cachedScenes)} of ${countOf(night.scenes, "scenes")}` : "";
    return html`<h2 tabindex="-1">Night of ${timeOf(night)} ${badge(night.verdict)}</h2>
      ${remarksOf(night).map((each) => html`<p class="caution">${each === "first run" ? "The first run of its suite and branch: there was no run to compare it with." : each === "incomplete" ? "Incomplete: it says nothing of the scenes that it lacks." : "A part of the scenes: it is compared with no run."}</p>`)}
      ${definitions([
        ["Commit", night.commit.slice(0, 12)],
        ["Rows", `${count(night.rows)}, ${count(night.failed)} failed, ${count(night.warned)} warned`],
        ["Worst row, by mean FLIP", night.worst ? `${night.worst.row}: ${significant(night.worst.flip, 4)}` : ""],
        ["Cost", night.cpuS === null ? "" : `${fixed(night.cpuS, 1)} s of CPU time${night.wallS === null ? "" : `, ${duration(night.wallS * 1000)} in all`}`],
        ["From the cache", cache],
        ["Machine", [night.machine, night.device].filter((each) => each !== "").join(", ")],
        ["Build", [night.version && `parity ${night.version}`, night.build.slice(0, 8)].filter((each) => each !== "").join(", ")],
        ["Run", night.name],
      ])}
      ${this.changes()}`;
  }
}
