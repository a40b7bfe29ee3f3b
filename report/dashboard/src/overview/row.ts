// What one row of the list shows.
import { html, nothing, type TemplateResult } from "lit";

import { imageSource } from "../data/images";
import { pathTitle } from "../data/paths";
import { checkOf, figureOf, type Row } from "../data/rows";
import type { Check, Images, Report } from "../data/types";
import { count, figure } from "../format";
import { badge, baseLayerBadge } from "../parts";
import { termLabel } from "../viewer/terms";

/** The pictures of a row; materials have crops, whole images the view's. */
export function imagesOf(row: Row, report: Report): Images | null {
  const view = report.scenes[row.scene]?.views[row.view];
  if (!view) return null;
  return row.kind === "material" ? (view.materials[row.material]?.crops ?? null) : view.images;
}

function thumbnail(path: string, what: string, name: string): TemplateResult {
  if (path === "") return html`<span class="thumb none" aria-hidden="true"></span>`;
  const onError = (event: Event): void => (event.target as HTMLElement).classList.add("missing");
  return html`<img class="thumb" src=${imageSource(path)} alt=${`${what} of ${name}`} loading="lazy" decoding="async" @error=${onError} />`;
}

export function thumbnails(row: Row, report: Report): TemplateResult {
  const images = imagesOf(row, report);
  if (!images || images.reference === "") return html`<span class="no-picture">no picture</span>`;
  const name = row.name.slice(0, 200);
  return html`${thumbnail(images.reference, `${pathTitle(row.reference)} picture`, name)}${thumbnail(images.test, `${pathTitle(row.test)} picture`, name)}${thumbnail(images.flip, "FLIP map", name)}`;
}

/** Shares of a bar's width, 0..100, for a value and its limits. */
export function barShares(value: number, check: Check): { value: number; warn: number | null; fail: number | null } {
  const most = Math.max(value, (check.fail ?? check.warn ?? value) * 1.25, 1e-9);
  const share = (x: number | null): number | null => (x === null ? null : Math.min(100, Math.max(0, (x / most) * 100)));
  return { value: share(value) ?? 0, warn: share(check.warn), fail: share(check.fail) };
}

/** The value against its limits: "0.142, warns above 0.1, fails above 0.2". */
export function describeLimits(check: Check): string {
  const limits = [check.warn === null ? "" : `warns at ${check.warn}`, check.fail === null ? "" : `fails at ${check.fail}`];
  return limits.filter((each) => each !== "").join(", ");
}

export function bar(value: number, check: Check): TemplateResult {
  const shares = barShares(Math.abs(value), check);
  const mark = (kind: string, share: number | null): TemplateResult | typeof nothing =>
    share === null ? nothing : html`<i class="mark ${kind}" .style=${`left:${share}%`}></i>`;
  return html`<span class="bar" title=${describeLimits(check)} aria-hidden="true">
    <i class="fill ${check.verdict.replace(" ", "-")}" .style=${`width:${shares.value}%`}></i>${mark("warn", shares.warn)}${mark("fail", shares.fail)}
  </span>`;
}

function figureCell(row: Row, report: Report, name: string): TemplateResult {
  const value = figureOf(row, name);
  const check = checkOf(row, name);
  return html`<span role="cell" class="cell-${name.replace(".", "-")} number">
    <span class="value">${figure(value ?? undefined, report.statistics[name])}</span>
    ${value !== null && check ? html`${bar(value, check)}<span class="sr">${describeLimits(check)}</span>` : nothing}
  </span>`;
}

export function fullRow(row: Row, report: Report, hash: string): TemplateResult {
  return html`
    <span role="cell" class="cell-pictures">${thumbnails(row, report)}</span>
    <span role="cell" class="cell-gravity">${badge(row.verdict)}${baseLayerBadge(row.notModelled)}${row.isNew ? html`<span class="tag">new</span>` : nothing}</span>
    <span role="cell" class="cell-name">
      <a class="name" href=${hash}><bdi>${row.name === "" ? "(no name)" : row.name}</bdi></a>
      <small class="place"><bdi>${row.place}</bdi></small>
      ${row.reason === "" ? nothing : html`<small class="reason" title=${row.reason}>${row.reason}</small>`}
    </span>
    ${figureCell(row, report, "flip.mean")}${figureCell(row, report, "flip.p95")}${figureCell(row, report, "flip.max")}
    <span role="cell" class="cell-bias">${row.bias}</span>
    <span role="cell" class="cell-cause">${
      row.cause
        ? html`<b title=${termLabel(row.cause.term)}>${row.cause.term}</b><small>${figure(row.cause.before, report.statistics["flip.mean"])} → ${figure(row.cause.after, report.statistics["flip.mean"])}</small>`
        : nothing
    }</span>
    <span role="cell" class="cell-pixels number">${row.judged ? count(row.pixels) : ""}</span>
  `;
}

export function compactRow(row: Row, report: Report, hash: string, open: boolean): TemplateResult {
  const images = imagesOf(row, report);
  return html`
    <span role="cell" class="cell-pictures">${images ? thumbnail(images.test, `${pathTitle(row.test)} picture`, row.name.slice(0, 200)) : nothing}</span>
    <span role="cell" class="cell-name">
      <a class="name" href=${hash} aria-current=${open ? "true" : "false"}><bdi>${row.name === "" ? "(no name)" : row.name}</bdi></a>
      <small class="place"><bdi>${row.place}</bdi></small>
    </span>
    <span role="cell" class="cell-gravity">${badge(row.verdict, true)}<span class="value">${figure(figureOf(row, "flip.mean") ?? undefined, report.statistics["flip.mean"])}</span></span>
  `;
}
