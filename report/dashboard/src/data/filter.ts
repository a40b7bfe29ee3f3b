// Which rows are shown, and in which order.
import { figureOf, type Row } from "./rows";
import type { List, State } from "./state";

export interface Filter {
  list: List;
  query: string;
  verdicts: readonly string[]; // empty: all
  changes: readonly string[]; // since the baseline; empty: all
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

/** Every word of the query has to be in the row's text, which has plain minus signs. */
export function matches(row: Row, filter: Filter): boolean {
  if (!isListed(row, filter.list)) return false;
  if (filter.verdicts.length > 0 && !filter.verdicts.includes(row.verdict)) return false;
  if (filter.changes.length > 0 && !row.changes.some((change) => filter.changes.includes(change))) return false;
  if (filter.term !== "" && row.cause?.term !== filter.term) return false;
  if (filter.preset !== "" && row.preset !== filter.preset) return false;
  return filter.query.toLowerCase().replaceAll("\u2212", "-").split(/\s+/).every((word) => row.text.includes(word));
}

/** What a column sorts by; null sorts last, whichever way. */
export function sortValue(row: Row, key: string): number | string | null {
  switch (key) {
    case "gravity": return row.gravity;
    case "name": return row.name.toLowerCase();
    case "place": return `${row.link.scene} ${row.link.view}`.toLowerCase();
    case "pixels": return row.pixels;
    case "cause": return row.cause ? row.cause.before - row.cause.after : null;
    case "change": return row.change;
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

/** A new list. Rows that are equal by the key: the worse FLIP first, then as in the report. */
export function sortRows(rows: readonly Row[], key: string, ascending: boolean): Row[] {
  const keyed = rows.map((row) => ({ row, value: sortValue(row, key), flip: figureOf(row, "flip.mean") ?? -1 }));
  const sign = ascending ? 1 : -1;
  keyed.sort((a, b) => {
    if (a.value !== b.value) {
      if (a.value === null) return 1;
      if (b.value === null) return -1;
      return (a.value < b.value ? -1 : 1) * sign;
    }
    return b.flip - a.flip || a.row.order - b.row.order;
  });
  return keyed.map((each) => each.row);
}

/** How many rows have each verdict. */
export function countRows(rows: readonly Row[]): Record<string, number> {
  const counts: Record<string, number> = {};
  for (const row of rows) counts[row.verdict] = (counts[row.verdict] ?? 0) + 1;
  return counts;
}
