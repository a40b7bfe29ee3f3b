// Rows gathered by material, scene or cause, with what each group adds up to.
import { isOver } from "./changes";
import { flipOf } from "./filter";
import type { Row } from "./rows";
import { kGroupings, type Grouping, type List } from "./state";

export interface Group {
  key: string; // tells it from the other groups; "" where nothing is grouped
  label: string; // name of the material or the scene; the cause's term, or why there is none
  rows: Row[];
  over: number; // rows that fail or are errors
  warned: number;
  worst: Row[]; // the worst offenders first
}

const kWorst = 3;
export const kUnknownCause = "cause not measured"; // as the program has it
const kNotCompared = "scene not compared";

/** Views have neither a material nor a cause: they are grouped by scene alone. */
export function groupingsOf(list: List): readonly Grouping[] {
  return list === "views" ? ["none", "scene"] : kGroupings;
}

function labelOf(row: Row, by: Grouping): string {
  if (by === "scene") return row.sceneLink;
  return by === "material" ? row.name : row.causeTerm || row.noCause || kNotCompared;
}

/** The gravest verdict first, then the largest mean FLIP. */
export function worstOf(rows: readonly Row[], count: number): Row[] {
  const isWorse = (a: Row, b: Row): boolean => (b.gravity - a.gravity || flipOf(b) - flipOf(a) || a.order - b.order) < 0;
  const worst: Row[] = [];
  for (const row of rows) {
    const last = worst[count - 1];
    if (last && !isWorse(row, last)) continue;
    const place = worst.findIndex((each) => isWorse(row, each));
    worst.splice(place < 0 ? worst.length : place, 0, row);
    worst.length = Math.min(worst.length, count);
  }
  return worst;
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
  if (by === "none") return [{ key: "", label: "", rows: [...rows], over: 0, warned: 0, worst: [] }]; // it has no head
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

/** A line of the list: the head of a group, or a row. */
export type Entry = { kind: "group"; group: Group; isFolded: boolean } | Row;

/** The lines that are shown: of a folded group only its head, unless it holds what is open. */
export function entriesOf(groups: readonly Group[], isFolded: (key: string) => boolean, open: Row | null): readonly Entry[] {
  const [first] = groups;
  if (groups.length === 1 && first?.key === "") return first.rows;
  return groups.flatMap((group): readonly Entry[] => {
    const hides = isFolded(group.key) && !(open !== null && group.rows.includes(open));
    const head: Entry = { kind: "group", group, isFolded: hides };
    return hides ? [head] : [head, ...group.rows];
  });
}
