// Every figure of a row, and what the run did for its scene: for whoever has to know exactly.
import { html, nothing, type TemplateResult } from "lit";
import { customElement, property } from "lit/decorators.js";

import type { Judged } from "../data/judged";
import type { Head, Page } from "../data/page";
import { pathTitle, pathWord } from "../data/paths";
import type { Row } from "../data/rows";
import type { SceneDetails } from "../data/scenes";
import { countOf } from "../data/wording";
import type { Check, Scene, Truth } from "../data/types";
import { PageElement } from "../element";
import { change, count, duration, figure, figureIn, fixed } from "../format";
import { help } from "../help";
import { badge, copyable, definitions } from "../parts";
import { sceneNamed } from "../study/scene";
import { termLabel } from "../viewer/terms";
import { limitsOf } from "./checks";
import { approvePart } from "./approve";
import { acceptCommands, againCommand } from "./commands";
import { stageLine } from "./stages";

/** The limits of a figure and what its checks came to; of its change since the baseline, too. */
function limitCell(checks: readonly Check[], metric: string, report: Head): TemplateResult {
  return html`<td class="limits">${checks.filter((check) => check.metric === metric).map((check) => html`<div>${badge(check.verdict)} ${check.regress ? "against the baseline: " : ""}${limitsOf(check, report)}</div>`)}</td>`;
}

/** Of the pixels that are NaN or infinite: how many the budget accepts. */
function nonFiniteLimit({ budget }: Judged): string {
  return budget.maxNonFinite === undefined ? "" : `its budget accepts at most ${count(budget.maxNonFinite)}`;
}

function figureTable(judged: Judged, { kind, reference, test }: Row, report: Head): TemplateResult {
  const { figures, baseline, checks } = judged;
  if (!figures) return html`<p class="aside">There are no figures, because no pixel of this view shows it.</p>`;
  const since = baseline && !baseline.new ? baseline.changes : null;
  const share = (value: number | null): string => (value === null ? "–" : `${fixed(100 * value, 1)} %`);
  const further: [string, string, string?][] = [
    ["pixels", count(figures.pixels)],
    ["pixels that are NaN or infinite", count(figures.nonFinite), nonFiniteLimit(judged)],
    ["white in both pictures", share(figures.clippedWhite)],
    ["black in both pictures", share(figures.clippedBlack)],
    [`mean luma of ${pathWord(reference)}, displayed`, fixed(figures.referenceLuma, 4)],
    [`mean luma of ${pathWord(test)}, displayed`, fixed(figures.testLuma, 4)],
    [`mean luminance of ${pathWord(reference)}, linear as exposed`, fixed(figures.referenceLuminance, 4)],
    [`mean luminance of ${pathWord(test)}, linear as exposed`, fixed(figures.testLuminance, 4)],
  ];
  return html`<div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
    <caption>${kind === "material" ? html`The ${pathWord(reference)} picture against a copy in which only this material has the colours of ${pathWord(test)}${help("materialFlip")}` : html`${pathTitle(test)} against ${pathWord(reference)}${help("wholeFlip")}`}</caption>
    <thead><tr><th scope="col">figure</th><th scope="col">value</th><th scope="col">verdict and limits</th>${since ? html`<th scope="col">since the baseline${help("baseline")}</th>` : nothing}</tr></thead>
    <tbody>
      ${Object.keys(figures.metrics).map((name) => html`<tr><th scope="row">${report.statistics[name]?.label ?? name} <code>${name}</code></th>
        <td class="number">${figureIn(figures, name, report.statistics)}</td>
        ${limitCell(checks, name, report)}
        ${since ? html`<td class="number">${change(since[name], report.statistics[name])}</td>` : nothing}</tr>`)}
      ${further.map(([name, value, limit = ""]) => html`<tr><th scope="row">${name}</th><td class="number">${value}</td><td class="limits">${limit}</td>${since ? html`<td></td>` : nothing}</tr>`)}
    </tbody></table></div>`;
}

function truthTables(truth: Truth, { reference, test }: Row, report: Head): TemplateResult {
  const { figures } = truth;
  if (!figures) return html`<p class="aside">The truth is unknown here, because there are no pixels.</p>`;
  const names = [...new Set([...Object.keys(figures.reference.metrics), ...Object.keys(figures.test.metrics)])];
  const ofTerm = (value: number | null | undefined): string => figure(value ?? undefined, report.statistics["flip.mean"]);
  return html`<section><h3>Both paths against the truth ${help("truth")}</h3>
    <div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
      <thead><tr><th scope="col">figure</th><th scope="col">${pathWord(reference)}</th><th scope="col">${pathWord(test)}</th></tr></thead>
      <tbody>${names.map((name) => html`<tr><th scope="row">${report.statistics[name]?.label ?? name}</th><td class="number">${figureIn(figures.reference, name, report.statistics)}</td><td class="number">${figureIn(figures.test, name, report.statistics)}</td></tr>`)}</tbody>
    </table></div>
    <p class="aside">Standard error of the truth's pixels: median ${fixed((figures.error.median ?? NaN) * 100, 2)} %, worst ${fixed((figures.error.worst ?? NaN) * 100, 2)} %${figures.nonFinite > 0 ? html`; <b>${figures.nonFinite} of its pixels ${figures.nonFinite === 1 ? "is" : "are"} NaN or infinite</b>` : nothing}.</p>
    ${truth.terms.length === 0 ? nothing : html`<div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
      <caption>Mean light by term${help("termLight")}</caption>
      <thead><tr><th scope="col">term</th><th scope="col">truth</th><th scope="col">${pathWord(reference)}</th><th scope="col">${pathWord(test)}</th><th scope="col">FLIP ${pathWord(reference)}</th><th scope="col">FLIP ${pathWord(test)}</th></tr></thead>
      <tbody>${truth.terms.map((term) => html`<tr><th scope="row">${term.term} <small>${termLabel(term.term)}</small></th><td class="number">${fixed(term.luminance.truth, 4)}</td><td class="number">${fixed(term.luminance.reference, 4)}</td><td class="number">${fixed(term.luminance.test, 4)}</td>
          <td class="number">${ofTerm(term.figures?.reference["flip.mean"])}</td><td class="number">${ofTerm(term.figures?.test["flip.mean"])}</td></tr>`)}</tbody></table></div>`}
    ${truth.notes.length > 0 ? html`<ul class="notes">${truth.notes.map((note) => html`<li>${note}</li>`)}</ul>` : nothing}
  </section>`;
}

function passTable(scene: Scene): TemplateResult {
  return html`<section><h3>Passes done and skipped ${help("skipped")}</h3><div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
    <thead><tr><th scope="col">pass</th><th scope="col">done</th><th scope="col">reason for skipping</th></tr></thead>
    <tbody>${scene.passes.map((pass) => html`<tr class=${pass.skipped === null ? "" : "skipped"}><th scope="row">${pass.name}</th><td class="number">${pass.skipped === null ? countOf(pass.count, pass.unit) : "–"}</td><td>${pass.skipped ?? ""}</td></tr>`)}</tbody>
  </table></div></section>`;
}

function permutationTable(scene: Scene): TemplateResult {
  const costs = scene.permutations.some((each) => each.cost);
  return html`<section><h3>Shaders that ran ${help("permutations")}</h3><div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
    <thead><tr><th scope="col">path</th><th scope="col">textures</th><th scope="col">made for</th><th scope="col">pixels</th><th scope="col">samplers</th>${costs ? html`<th scope="col">fp32</th><th scope="col">fp16</th><th scope="col">fetches</th>` : nothing}</tr></thead>
    <tbody>${scene.permutations.map((each) => html`<tr><th scope="row">${each.path}</th><td>${each.textures}</td><td>${each.features}</td><td class="number">${count(each.pixels)}</td><td class="number">${each.samplers}</td>${costs ? html`<td class="number">${each.cost?.fp32 ?? "–"}</td><td class="number">${each.cost?.fp16 ?? "–"}</td><td class="number">${each.cost?.fetches ?? "–"}</td>` : nothing}</tr>`)}</tbody>
  </table></div></section>`;
}

@customElement("parity-numbers")
export class ParityNumbers extends PageElement {
  @property({ attribute: false }) page!: Page;
  @property({ attribute: false }) details!: SceneDetails;
  @property({ attribute: false }) judged!: Judged;
  @property({ attribute: false }) row!: Row;

  protected override render(): TemplateResult {
    const { report, run, bench } = this.page;
    const { judged } = this;
    const { scene } = this.details;
    const seconds = run?.sceneTimes?.find((each) => each.scene === scene.name)?.seconds;
    return html`<div class="numbers">
      ${figureTable(judged, this.row, report)}
      ${judged.stages.map((stage) => stageLine(stage, this.row.test, report))}
      ${judged.truth ? truthTables(judged.truth, this.row, report) : nothing}
      ${bench ? html`<section><h3>Error against time ${help("pareto")}</h3>${sceneNamed(bench, scene.name, scene.views[this.row.view]?.name ?? "")}</section>` : nothing}
      <section><h3>Repeat the comparison</h3>
        ${run ? html`<p class="aside">Run these commands in the folder where parity ran.</p>` : nothing}
        ${run && run.commandLine !== "" ? html`<p>The whole report:</p>${copyable(run.commandLine, "the command of the report")}` : nothing}
        ${againPart(this.details, this.row)}
        <h3>Accept the result</h3>
        <p class="aside">Run these commands in the folder of this report, which has report.json.</p>${acceptCommands().map(({ what, command }) => html`<p class="aside">${what}</p>${copyable(command, what)}`)}
      </section>
      ${approvePart(this.row, judged, scene.views[this.row.view]?.name ?? "")}
      ${passTable(scene)}${permutationTable(scene)}
      <section><h3>The run</h3>
        ${definitions([
          ["Source", scene.source], ["Environment", scene.environment], ["Sun", scene.sun], ["Light", scene.light ?? ""],
          ["Device", report.device], ["Version", `${report.tool} ${report.version}`], ["Started", run?.startedAt ?? ""],
          ["Shaders compiled", run ? String(run.compiledShaders) : ""],
          ["From the cache", run && run.cachedScenes.includes(scene.name) ? "this scene, unchanged" : ""],
          ["Time of this scene", seconds === undefined ? "" : duration(1000 * seconds)],
        ])}
        ${run ? html`<div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table><caption>Times${help("timings")}</caption><thead><tr><th scope="col">stage</th><th scope="col">time</th></tr></thead><tbody>${run.timings.map(({ stage, timeMs }) => html`<tr><th scope="row">${stage}</th><td class="number">${duration(timeMs)}</td></tr>`)}</tbody></table></div>` : nothing}
      </section>
    </div>`;
  }
}

function againPart({ again, scene }: SceneDetails, of: Row): TemplateResult | typeof nothing {
  const command = againCommand(again, scene, of);
  return command === null ? nothing : html`<p>To see this ${of.kind === "material" ? "material" : "view"} again, as a table:</p>${copyable(command, "the command for this row")}`;
}
