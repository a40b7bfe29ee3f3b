// The top of the page: verdict, what was compared on what, and what concerns the whole run.
import { html, nothing, type TemplateResult } from "lit";

import { isWhole } from "../data/embedded";
import type { Facts } from "../data/facts";
import type { EarlierRuns } from "../data/history";
import type { Head, RunHead } from "../data/page";
import { count } from "../format";
import { badge, definitions } from "../parts";
import { themeButton, type Theme } from "../theme";
import { causesNotice } from "./causes";
import { sinceLines } from "./since";

const kMostLines = 200; // of thousands nobody reads more

function warnings(title: string, texts: readonly string[], isFolded = false): TemplateResult | typeof nothing {
  if (texts.length === 0) return nothing;
  return html`<details class="notice" ?open=${texts.length <= 3 && !isFolded}>
    <summary>${title} (${texts.length})</summary>
    <ul>${texts.slice(0, kMostLines).map((text) => html`<li><bdi>${text}</bdi></li>`)}</ul>
    ${texts.length > kMostLines ? html`<p>and ${count(texts.length - kMostLines)} more in report.json</p>` : nothing}
  </details>`;
}

function baselineNotice(report: Head, isFolded: boolean): TemplateResult | typeof nothing {
  const baseline = report.baseline;
  if (!baseline) return nothing;
  const gone = baseline.gone.map(({ scene, view, material }) => [material, view, scene].filter((each) => each !== "").join(", in "));
  return html`
    ${baseline.error === "" ? nothing : html`<p class="notice error" role="alert"><b>The baseline was not used:</b> ${baseline.error}</p>`}
    ${warnings("Gone since the baseline", gone, isFolded)}
  `;
}

export interface HeaderScene {
  report: Head;
  run: RunHead | null;
  history: EarlierRuns | null;
  facts: Facts;
  warnings: readonly string[]; // of the run, and of each scene, with its name
  isBrief: boolean; // beside an open item: without what concerns the whole run
  isPhone: boolean; // what is long is folded
  lost: string; // what a link names, but this report does not have; "": nothing
  theme: Theme;
  openKeys: () => void;
}

export function header(scene: HeaderScene): TemplateResult {
  const { report, run, isBrief, theme, openKeys } = scene;
  const when = run && run.startedAt !== "" ? html` · <time datetime=${run.startedAt}>${run.startedAt.replace("T", " ").replace("Z", " UTC")}</time>` : nothing;
  return html`<header class="page-head ${report.verdict.replace(" ", "-")} ${isBrief ? "brief" : ""}">
    ${report.suite === "" || isBrief ? nothing : html`<p class="suite">Suite <bdi>${report.suite}</bdi></p>`}
    <div class="head-line">
      <h1>${badge(report.verdict)} <span>${report.headline}</span></h1>
      <div class="head-buttons">
        ${themeButton(theme)}
        <button type="button" @click=${openKeys} aria-label="Keys, and how to read this page">?<span class="word"> keys</span></button>
      </div>
    </div>
    ${isBrief ? nothing : html`${sinceLines(report, scene.history, scene.facts)}
      <p class="sub">${report.device}${when} · ${report.tool} ${report.version}${isWhole() ? nothing : html` · <a href="report.json">report.json</a>`}</p>
      ${notices(scene)}`}
  </header>`;
}

function notices({ report, facts, warnings: texts, isPhone, lost }: HeaderScene): TemplateResult {
  const problems = (report.problems ?? []).map(({ verdict, reason }) => html`<p class="notice error" role="alert"><b>${verdict}:</b> <bdi>${reason}</bdi></p>`);
  return html`${lost === "" ? nothing : html`<p class="notice error" role="alert">The link leads to <bdi>${lost}</bdi>, which this report does not have.</p>`}
    ${problems}
    <div class="notices">${causesNotice(report, facts.causes, !isPhone)}${baselineNotice(report, isPhone)}${warnings("Warnings", texts, isPhone)}
    <details class="notice quiet">
      <summary>Settings</summary>
      ${definitions([
        ...report.settings.map(({ name, value }) => [name, value] as const),
        ["baseline", report.baseline ? `${report.baseline.source} (${report.baseline.version}, ${report.baseline.device})` : ""],
      ])}
    </details></div>`;
}
