// What one row of the list shows.
import { html, nothing, type TemplateResult } from "lit";

import { isOver, kLeastChange } from "../data/changes";
import { imageSource } from "../data/images";
import { pathTitle } from "../data/paths";
import { checkOf, figureOf, type Row } from "../data/rows";
import { barShares } from "../data/scale";
import type { Limit } from "../data/overview";
import type { Head } from "../data/page";
import { countOf } from "../data/wording";
import { change, count, figure } from "../format";
import { baseLayerBadge, rowBadge, standingNote } from "../parts";
import { termLabel } from "../viewer/terms";

export interface RowScene {
  report: Head;
  hash: string; // of the link
  scales: Readonly<Record<string, number>>; // of bars, by figure
  withChange: boolean; // there is a baseline
}

function thumbnail(path: string, what: string, name: string): TemplateResult {
  if (path === "") return html`<span class="thumb none" aria-hidden="true"></span>`;
  const onError = (event: Event): void => (event.target as HTMLElement).classList.add("missing");
  return html`<img class="thumb" src=${imageSource(path)} alt=${`${what} of ${name}`} loading="lazy" decoding="async" @error=${onError} />`;
}

/** Each with what it shows below it. */
export function thumbnails(row: Row): TemplateResult {
  const { images } = row;
  if (!images || images.reference === "") return html`<span class="no-picture">no picture</span>`;
  const name = row.name.slice(0, 200);
  const labelled = (path: string, label: string, what: string): TemplateResult =>
    html`<span class="labelled">${thumbnail(path, what, name)}<small aria-hidden="true">${label}</small></span>`;
  const [reference, test] = [pathTitle(row.reference), pathTitle(row.test)];
  return html`${labelled(images.reference, reference, `${reference} picture`)}${labelled(images.test, test, `${test} picture`)}${labelled(images.flip, "FLIP", "FLIP map")}`;
}

/** The value against its limits: "0.142, warns above 0.1, fails above 0.2". */
export function describeLimits(check: Pick<Limit, "warn" | "fail">): string {
  const limits = [check.warn === null ? "" : `warns at ${check.warn}`, check.fail === null ? "" : `fails at ${check.fail}`];
  return limits.filter((each) => each !== "").join(", ");
}

/** most: what a full bar means. */
export function bar(value: number, check: Limit, most: number): TemplateResult {
  const shares = barShares(Math.abs(value), check, most);
  const mark = (kind: string, share: number | null): TemplateResult | typeof nothing =>
    share === null ? nothing : html`<i class="mark ${kind}" .style=${`left:${share}%`}></i>`;
  return html`<span class="bar" title=${describeLimits(check)} aria-hidden="true">
    <i class="fill ${check.verdict.replace(" ", "-")}" .style=${`width:${shares.value}%`}></i>${mark("warn", shares.warn)}${mark("fail", shares.fail)}
  </span>`;
}

function figureCell(row: Row, { report, scales }: RowScene, name: string): TemplateResult {
  const value = figureOf(row, name);
  const check: Limit = checkOf(row, name) ?? { metric: name, warn: null, fail: null, verdict: "not judged" };
  return html`<span role="cell" class="cell-${name.replace(".", "-")} number">
    <span class="value">${figure(value ?? undefined, report.statistics[name])}</span>
    ${value === null ? nothing : html`${bar(value, check, scales[name] ?? 1)}<span class="sr">${describeLimits(check)}</span>`}
  </span>`;
}

const kChangeTags = { added: "not in the baseline", "not comparable": "not comparable" } as const;

/** What has changed since the baseline in words, besides the figure and the standing. */
function changeTags(row: Row): TemplateResult {
  const tags = (Object.keys(kChangeTags) as (keyof typeof kChangeTags)[]).filter((each) => row.changes.includes(each));
  const title = row.notComparable;
  return html`${tags.map((tag) => html`<span class="tag ${tag.replace(" ", "-")}" title=${tag === "not comparable" ? title : ""}>${kChangeTags[tag]}</span>`)}`;
}

function changeCell(row: Row, report: Head): TemplateResult {
  const isChanged = row.change !== null && Math.abs(row.change) >= kLeastChange;
  const kind = !isChanged || row.change === null ? "" : row.change > 0 ? "worse" : "better";
  const sign = kind === "worse" ? "▲ " : kind === "better" ? "▼ " : "";
  const text = row.change === null ? "" : isChanged ? change(row.change, report.statistics["flip.mean"]) : "no change";
  return html`<span role="cell" class="cell-change number">
    ${text === "" ? nothing : html`<span class="value ${kind}"><span aria-hidden="true">${sign}</span>${text}</span>`}${changeTags(row)}
  </span>`;
}

/** What is accepted comes first, because it is what makes the row pass. */
function whyOf({ reason, accepted }: Row): string {
  return [accepted === "" ? "" : `accepted: ${accepted}`, reason].filter((each) => each !== "").join("; ");
}

/** The cause, or why a material that failed or warned has none; and the preset that would help most. */
function causeCell({ cause, help, kind, verdict, noCause }: Row, report: Head): TemplateResult {
  const flip = (value: number | null | undefined): string => figure(value ?? undefined, report.statistics["flip.mean"]);
  const isTroubled = kind === "material" && (isOver(verdict) || verdict === "warn");
  const none = isTroubled ? html`<small class="none">${noCause}</small>` : nothing;
  const then = help ? flip(help.flip) : "";
  return html`<span role="cell" class="cell-cause">
    ${cause ? html`<small class="word">Cause</small><b title=${termLabel(cause.term)}>${cause.term}</b><small>${flip(cause.before)} → ${flip(cause.after)}</small>` : none}
    ${help ? html`<small class="would-help" title=${`Would help: preset ${help.preset} (FLIP ${then}, ${help.verdict})`}>with ${help.preset} ${then}</small>` : nothing}
  </span>`;
}

export function fullRow(row: Row, scene: RowScene): TemplateResult {
  const { report, hash } = scene;
  const why = whyOf(row);
  const { nonFinite } = row;
  return html`
    <span role="cell" class="cell-pictures">${thumbnails(row)}</span>
    <span role="cell" class="cell-gravity">${rowBadge(row)}${baseLayerBadge(row.notModelled)}${nonFinite === 0 ? nothing : html`<small class="non-finite">${countOf(nonFinite, "pixels")} NaN</small>`}${standingNote(row)}</span>
    <span role="cell" class="cell-name">
      <a class="name" href=${hash}><bdi>${row.name === "" ? "(no name)" : row.name}</bdi></a>
      <small class="place"><bdi>${row.place}</bdi></small>
      ${why === "" ? nothing : html`<small class="reason" title=${why}>${why}</small>`}
    </span>
    ${figureCell(row, scene, "flip.mean")}${figureCell(row, scene, "flip.p95")}${figureCell(row, scene, "flip.max")}
    ${scene.withChange ? changeCell(row, report) : nothing}
    <span role="cell" class="cell-bias">${row.bias}</span>
    ${causeCell(row, report)}
    <span role="cell" class="cell-pixels number">${row.isJudged ? count(row.pixels) : ""}</span>
  `;
}

export function compactRow(row: Row, { report, hash }: RowScene, open: boolean): TemplateResult {
  const { images } = row;
  return html`
    <span role="cell" class="cell-pictures">${images ? thumbnail(images.test, `${pathTitle(row.test)} picture`, row.name.slice(0, 200)) : nothing}</span>
    <span role="cell" class="cell-name">
      <a class="name" href=${hash} aria-current=${open ? "true" : "false"}><bdi>${row.name === "" ? "(no name)" : row.name}</bdi></a>
      <small class="place"><bdi>${row.place}</bdi></small>
    </span>
    <span role="cell" class="cell-gravity">${rowBadge(row, true)}<span class="value">${figure(figureOf(row, "flip.mean") ?? undefined, report.statistics["flip.mean"])}</span></span>
  `;
}
