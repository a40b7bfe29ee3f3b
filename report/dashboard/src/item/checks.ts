// The budget checks of a row, each as a bar with its limits.
import { html, nothing, type TemplateResult } from "lit";

import type { Judged } from "../data/judged";
import type { Head } from "../data/page";
import type { Approval, Check, Statistic } from "../data/types";
import { countOf, typeset } from "../data/wording";
import { change, figure } from "../format";
import { help } from "../help";
import { bar } from "../overview/row";
import { badge } from "../parts";

/** Limits as the figure reads: "warns above 0.100, fails above 0.200"; below for a figure of which more is better. */
export function limitsOf(check: Check, report: Head): string {
  const statistic = report.statistics[check.metric];
  const beyond = statistic?.better === "higher" && !check.regress ? "below" : statistic?.better === "near zero" ? "beyond ±" : "above";
  const limit = (verb: string, value: number | null): string =>
    value === null ? "" : `${verb} ${beyond}${beyond.endsWith("±") ? "" : " "}${figure(value, statistic).replace(/^\+/, "")}`;
  return [limit("warns", check.warn), limit("fails", check.fail)].filter((each) => each !== "").join(", ");
}

/** "approved up to 0.142 by characters, until 2027-02-01 (68 days left): refit in sprint 12" */
export function approvalText({ value, slack, until, daysLeft, owner, reason, state, words }: Approval, statistic: Statistic | undefined): string {
  const days = daysLeft < 0 ? `${countOf(-daysLeft, "days")} ago` : daysLeft === 0 ? "the last day" : `${countOf(daysLeft, "days")} left`;
  const sign = statistic?.better === "higher" ? -1 : 1;
  const most = statistic?.better === "near zero" ? `±${figure(Math.abs(value) + slack, statistic).replace(/^\+/, "")}` : figure(value + sign * slack, statistic);
  const what = state === "lapsed" ? "approval does not hold" : `approved ${sign < 0 ? "down" : "up"} to ${most}`;
  return `${what}, by ${owner}, until ${until} (${days}): ${reason}${words === "" ? "" : `; ${typeset(words)}`}`;
}

/** What a full bar means: the scale of the list where it has one, else a quarter more than the limit. */
function scaleOf(check: Check, scales: Readonly<Record<string, number>>): number {
  const scale = check.regress ? undefined : scales[check.metric];
  return scale ?? Math.max(Math.abs(check.value ?? 0), 1.25 * (check.fail ?? check.warn ?? 0));
}

export function checkTable(judged: Judged, report: Head, scales: Readonly<Record<string, number>>): TemplateResult {
  const { budget } = judged;
  if (judged.checks.length === 0) return html`<p class="aside">No budget was checked.</p>`;
  return html`<section class="checks">
    <h3>Budget ${help("budget")}</h3>
    <div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
      <thead><tr><th scope="col">figure</th><th scope="col">value</th><th scope="col">limits</th><th scope="col">verdict</th></tr></thead>
      <tbody>${judged.checks.map((check) => {
        const statistic = report.statistics[check.metric];
        const value = check.regress ? change(check.value, statistic) : figure(check.value ?? undefined, statistic);
        return html`<tr>
          <th scope="row">${statistic?.label ?? check.metric}${check.regress ? ", against the baseline" : ""}</th>
          <td class="number">${value}</td>
          <td class="limits">${check.value === null || statistic?.better === "higher" ? nothing : bar(Math.max(0, check.regress ? check.value : Math.abs(check.value)), check, scaleOf(check, scales))}<small>${limitsOf(check, report)}${check.note === "" ? nothing : html` (${typeset(check.note)})`}</small>${check.approval ? html`<small class="approval ${check.approval.state}"><bdi>${approvalText(check.approval, statistic)}</bdi></small>` : nothing}</td>
          <td>${badge(check.verdict)}</td></tr>`;
      })}</tbody></table></div>
    ${judged.verdict === "too small" ? html`<p class="aside">The material has fewer than ${countOf(budget.minPixels, "pixels")} (<code>min_pixels</code> of its budget), so no check counts.</p>` : nothing}
    ${judged.verdict === "not judged" ? html`<p class="aside">Most of its pixels are clipped in both pictures, so a check that passes means nothing.</p>` : nothing}
    <p class="aside">${budget.rule === "" ? "No rule matched." : html`Rule: <bdi>${budget.rule}</bdi>`}${budget.preset === "" ? nothing : html`, preset <bdi>${budget.preset}</bdi>`}${budget.reason === "" ? nothing : html`. Reason: <bdi>${budget.reason}</bdi>`}${budget.owner === "" ? nothing : html`. Owner: <bdi>${budget.owner}</bdi>`}</p>
  </section>`;
}
