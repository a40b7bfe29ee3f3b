// What is shown in place of the report where it cannot be read.
import { html, type TemplateResult } from "lit";

export function failurePage(problem: string): TemplateResult {
  return html`<section class="failure" role="alert">
    <h1>This report cannot be shown</h1>
    <p>${problem}</p>
    <p>Its figures are in <a href="report.json">report.json</a>.</p>
  </section>`;
}
