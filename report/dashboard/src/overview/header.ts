// The top of the page: verdict, what was compared on what, and what concerns the whole run.
import { html, nothing, type TemplateResult } from "lit";

import { isWhole } from "../data/embedded";
import type { Report, Run } from "../data/types";
import { badge, definitions } from "../parts";
import { themeButton, type Theme } from "../theme";

function warnings(title: string, texts: readonly string[]): TemplateResult | typeof nothing {
  if (texts.length === 0) return nothing;
  return html`<details class="notice" ?open=${texts.length <= 3}>
    <summary>${title} (${texts.length})</summary>
    <ul>${texts.map((text) => html`<li><bdi>${text}</bdi></li>`)}</ul>
  </details>`;
}

/** Warnings of the run and of each scene, with its name. */
function allWarnings(report: Report): string[] {
  return [...report.warnings, ...report.scenes.flatMap((scene) => scene.warnings.map((text) => `${scene.name}: ${text}`))];
}

function baselineNotice(report: Report): TemplateResult | typeof nothing {
  const baseline = report.baseline;
  if (!baseline) return nothing;
  const gone = baseline.gone.map(({ scene, view, material }) => [material, view, scene].filter((each) => each !== "").join(", in "));
  return html`
    ${baseline.error === "" ? nothing : html`<p class="notice error" role="alert"><b>The baseline was not used:</b> ${baseline.error}</p>`}
    ${warnings("Gone since the baseline", gone)}
  `;
}

/** brief: beside an open item, without what concerns the whole run. */
export function header(report: Report, run: Run | null, brief: boolean, theme: Theme, openKeys: () => void): TemplateResult {
  return html`<header class="page-head ${report.verdict.replace(" ", "-")}">
    <div class="head-line">
      <h1>${badge(report.verdict)} <span>${report.headline}</span></h1>
      <div class="head-buttons">
        ${themeButton(theme)}
        <button type="button" @click=${openKeys} aria-label="Keys, and how to read this page">? keys</button>
      </div>
    </div>
    <p class="sub">${report.device}${run && run.startedAt !== "" ? html` · <time datetime=${run.startedAt}>${run.startedAt.replace("T", " ").replace("Z", " UTC")}</time>` : nothing} · ${report.tool} ${report.version}${isWhole() ? nothing : html` · <a href="report.json">report.json</a>`}</p>
    ${brief ? nothing : notices(report)}
  </header>`;
}

function notices(report: Report): TemplateResult {
  const problems = (report.problems ?? []).map(({ verdict, reason }) => html`<p class="notice error" role="alert"><b>${verdict}:</b> <bdi>${reason}</bdi></p>`);
  return html`${problems}${baselineNotice(report)}${warnings("Warnings", allWarnings(report))}
    <details class="notice quiet">
      <summary>Settings</summary>
      ${definitions([
        ...report.settings.map(({ name, value }) => [name, value] as const),
        ["baseline", report.baseline ? `${report.baseline.source} (${report.baseline.version}, ${report.baseline.device})` : ""],
      ])}
    </details>`;
}
