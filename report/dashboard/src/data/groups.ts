// Rows gathered by material, scene or cause, with what each group adds up to.
import { isOver } from "./changes";
import { figureOf, type Row } from "./rows";
import { kGroupings, type Grouping, type List } from "./state";

export interface Group {
  key: string; // tells it from the other groups; "" where nothing is grouped
  label: string; // name of the material or the scene; the cause's term, "" where there is none
  rows: Row[];
  over: number; // rows that fail or are errors
  warned: number;
  worst: Row[]; // the worst offenders first
}

const kWorst = 3;
export const kNoCause = "no single term";
export const kUnknownCause = "cause not measured";

/** Views have neither a material nor a cause: they are grouped by scene alone. */
export function groupingsOf(list: List): readonly Grouping[] {
  return list === "views" ? ["none", "scene"] : kGroupings;
}

/** What the cause is called where it is no term. */
function causeKey(row: Row): string {
  if (row.cause) return row.cause.term;
  return row.isAttributed ? kNoCause : kUnknownCause;
}

function labelOf(row: Row, by: Grouping): string {
  if (by === "scene") return row.link.scene;
  return by === "material" ? row.name : causeKey(row);
}

/** The gravest verdict first, then the largest mean FLIP. */
export function worstOf(rows: readonly Row[], count: number): Row[] {
  const flip = (row: Row): number => figureOf(row, "flip.mean") ?? -1;
  return [...rows].sort((a, b) => b.gravity - a.gravity || flip(b) - flip(a) || a.order - b.order).slice(0, count);
}

function makeGroup(key: string, label: string, rows: Row[]): Group {
  return {
    key,
    label,
    rows,
    over: rows.filter((row) => isOver(row.verdict)).length,
    warned: rows.filter((row) => row.verdict === "warn").length,
    worst: worstOf(rows, kWorst),
  };
}

/** Groups stand in the order of their first rows, so the sort key of the rows decides it. */
export function groupRows(rows: readonly Row[], by: Grouping): Group[] {
  if (by === "none") return [makeGroup("", "", [...rows])];
  const groups = new Map<string, { label: string; rows: Row[] }>();
  for (const row of rows) {
    const label = labelOf(row, by);
    const key = `${by} ${label}`;
    const group = groups.get(key);
    if (group) group.rows.push(row);
    else groups.set(key, { label, rows: [row] });
  }
  return [...groups].map(([key, { label, rows: all }]) => makeGroup(key, label, all));
}

/** A line of the list. */
export type Entry = { kind: "group"; group: Group; isFolded: boolean } | { kind: "row"; row: Row };

/** The lines that are shown: of a folded group only its head, unless it holds what is open. */
export function entriesOf(groups: readonly Group[], isFolded: (key: string) => boolean, open: Row | null): Entry[] {
  return groups.flatMap((group): Entry[] => {
    const rows = group.rows.map((row): Entry => ({ kind: "row", row }));
    if (group.key === "") return rows;
    const hides = isFolded(group.key) && !(open !== null && group.rows.includes(open));
    return [{ kind: "group", group, isFolded: hides }, ...(hides ? [] : rows)];
  });
}
