// What is shown in place of the report where it cannot be read.
import { html, nothing, type TemplateResult } from "lit";

import { isWhole } from "./data/embedded";

export function failurePage(problem: string): TemplateResult {
  return html`<section class="failure" role="alert">
    <h1>This report cannot be shown</h1>
    <p>${problem}</p>
    ${isWhole() ? nothing : html`<p>Its figures are in <a href="report.json">report.json</a>.</p>`}
  </section>`;
}
