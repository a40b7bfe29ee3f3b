// Which rows are shown, and in which order.
import type { Overview } from "./overview";
import { figureOf, type Row } from "./rows";
import { finderOf } from "./search";
import type { List, State } from "./state";

export interface Filter {
  list: List;
  query: string;
  verdicts: readonly string[]; // empty: all
  changes: readonly string[]; // standings, and changes since the baseline; empty: all
  term: string;
  preset: string;
}

export function filterOf(state: State): Filter {
  return { list: state.list, query: state.query, verdicts: state.verdicts, changes: state.changes, term: state.causedBy, preset: state.preset };
}

/** Scenes that failed are in both lists. */
export function isListed(row: Row, list: List): boolean {
  return row.kind === "scene" || (row.kind === "material") === (list === "materials");
}

/** What tells whether a row is shown. Every word of the query has to be in the row's texts. */
export function matcherOf(all: Overview, filter: Filter): (row: Row) => boolean {
  const finds = finderOf(all, filter.query);
  return (row) => {
    if (!isListed(row, filter.list)) return false;
    if (filter.verdicts.length > 0 && !filter.verdicts.includes(row.verdict)) return false;
    if (filter.changes.length > 0 && !row.changes.some((change) => filter.changes.includes(change))) return false;
    if (filter.term !== "" && row.causeTerm !== filter.term) return false;
    if (filter.preset !== "" && row.preset !== filter.preset) return false;
    return finds(row);
  };
}

/** Mean FLIP; below all others where it is not known. */
export function flipOf(row: Row): number {
  const flip = row.packedFigure("flip.mean");
  return Number.isNaN(flip) ? -1 : flip;
}

/** What a column sorts by; null sorts last, whichever way. */
export function sortValue(row: Row, key: string): number | string | null {
  switch (key) {
    case "gravity": return row.gravity;
    case "name": return row.name.toLowerCase();
    case "place": return `${row.sceneLink} ${row.viewLink}`.toLowerCase();
    case "pixels": return row.pixels;
    case "cause": return row.cause ? row.cause.before - row.cause.after : null;
    case "change": return row.change;
    case "nights": return row.nights > 0 ? row.nights : null;
    case "order": return row.order;
    case "bias": {
      const ev = figureOf(row, "bias.ev");
      return ev === null ? null : Math.abs(ev);
    }
    default: return figureOf(row, key);
  }
}

/** Text ascends and numbers descend at first: what is worst stands on top. */
export function sortsUpAtFirst(key: string): boolean {
  return key === "name" || key === "place" || key === "order";
}

/** Numbers in the order of the values, texts by their place among all; what is not known is last. sign: 1 ascends, -1 descends. */
function ranksOf(values: readonly (number | string | null)[], sign: 1 | -1): Float64Array {
  const texts = [...new Set(values.filter((value) => typeof value === "string"))].sort();
  const places = new Map(texts.map((text, i) => [text, i]));
  return Float64Array.from(values, (value) => (value === null ? Number.MAX_VALUE : sign * (typeof value === "string" ? places.get(value)! : value)));
}

/** A new list. Rows that are equal by the key: the worse FLIP first, then as in the report. rows: as in the report. */
export function sortRows(rows: readonly Row[], key: string, ascending: boolean): Row[] {
  const values = rows.map((row) => sortValue(row, key));
  const ranks = ranksOf(values, ascending ? 1 : -1);
  const flips = Float32Array.from(rows, flipOf);
  const places = Uint32Array.from(rows.keys());
  places.sort((a, b) => ranks[a]! - ranks[b]! || flips[b]! - flips[a]! || a - b);
  return Array.from(places, (place) => rows[place]!);
}

/** How many rows have each verdict. */
export function countRows(rows: readonly Row[]): Record<string, number> {
  const counts: Record<string, number> = {};
  for (const row of rows) counts[row.verdict] = (counts[row.verdict] ?? 0) + 1;
  return counts;
}
