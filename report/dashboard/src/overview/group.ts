// The head of a group of rows: what it adds up to, and its worst offenders as links.
import { html, nothing, type TemplateResult } from "lit";

import type { Group } from "../data/groups";
import type { Head } from "../data/page";
import { figureOf, type Row } from "../data/rows";
import type { Grouping } from "../data/state";
import { countOf } from "../data/wording";
import { count, figure } from "../format";
import { termLabel } from "../viewer/terms";

/** "5 failed, 2 warned"; "" where none did. */
export function troubleText({ over, warned }: Group): string {
  return [over > 0 ? `${count(over)} failed` : "", warned > 0 ? `${count(warned)} warned` : ""].filter((each) => each !== "").join(", ");
}

/** A cause in words with its term; the name of a material or a scene as it is. */
export function groupLabel({ label, rows }: Group, by: Grouping): TemplateResult {
  if (by === "cause" && rows[0]?.causeTerm === label) return html`${termLabel(label)} <small>${label}</small>`;
  return html`<bdi>${label === "" ? "(no name)" : label}</bdi>`;
}

const kLongestName = 28;

function shortName({ name }: Row): string {
  if (name === "") return "(no name)";
  const letters = [...name];
  return letters.length > kLongestName ? `${letters.slice(0, kLongestName - 1).join("")}…` : name;
}

/** Links to the worst rows, each with its scene and its mean FLIP. */
export function worstLinks(group: Group, by: Grouping, report: Head, hashOf: (row: Row) => string, most: number): TemplateResult {
  const nameOf = (row: Row): string => (by === "material" ? row.place : by === "cause" ? `${shortName(row)} · ${row.sceneLink}` : shortName(row)).slice(0, 200);
  return html`${group.worst.slice(0, most).map(
    (row, i) => html`${i > 0 ? ", " : ""}<a href=${hashOf(row)} title=${`${row.name.slice(0, 400)}, ${row.place}`}><bdi>${nameOf(row)}</bdi></a> <span class="number">${figure(figureOf(row, "flip.mean") ?? undefined, report.statistics["flip.mean"])}</span>`,
  )}`;
}

export function groupHead(
  group: Group,
  by: Grouping,
  report: Head,
  isFolded: boolean,
  toggle: () => void,
  hashOf: (row: Row) => string,
): TemplateResult {
  const trouble = troubleText(group);
  return html`<span role="cell" class="cell-group">
    <button type="button" aria-expanded=${isFolded ? "false" : "true"} @click=${toggle}>
      <span aria-hidden="true">${isFolded ? "▸" : "▾"}</span> ${groupLabel(group, by)}
    </button>
    <span class="total">${countOf(group.rows.length, "rows")}${trouble === "" ? nothing : html`, <b class=${group.over > 0 ? "over" : "caution"}>${trouble}</b>`}</span>
    <span class="worst">Worst: ${worstLinks(group, by, report, hashOf, 3)}</span>
  </span>`;
}
