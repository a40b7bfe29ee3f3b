// What the head of the page and the filters say of all rows: counted once, because of a hundred thousand rows it takes
// a while.
import { countChanges, isOver, type ChangeCounts } from "./changes";
import { countRows, isListed } from "./filter";
import { kUnknownCause, groupRows, type Group } from "./groups";
import type { Row } from "./rows";
import type { List } from "./state";

/** Of one list. */
export interface ListFacts {
  rows: number;
  over: number; // that failed or are errors
  verdicts: Readonly<Record<string, number>>; // rows by verdict
  changes: ChangeCounts;
  causes: ReadonlyMap<string, number>; // rows by the term of their cause, by name
  presets: readonly string[]; // of budgets, by name
}

export interface Facts {
  lists: Readonly<Record<List, ListFacts>>;
  causes: readonly Group[]; // causeTotals
  materials: ChangeCounts;
  isComparable: boolean; // isComparable of the materials
}

function factsOfList(rows: readonly Row[], list: List): ListFacts {
  const listed = rows.filter((row) => isListed(row, list));
  const causes = new Map<string, number>();
  const presets = new Set<string>();
  for (const { causeTerm, preset } of listed) {
    if (causeTerm !== "") causes.set(causeTerm, (causes.get(causeTerm) ?? 0) + 1);
    if (preset !== "") presets.add(preset);
  }
  return {
    rows: listed.length,
    over: listed.filter((row) => isOver(row.verdict)).length,
    verdicts: countRows(listed),
    changes: countChanges(listed),
    causes: new Map([...causes].sort(([a], [b]) => (a < b ? -1 : 1))),
    presets: [...presets].sort(),
  };
}

/** Of materials that failed or warned; the cause of most failures first. */
export function causeTotals(rows: readonly Row[]): Group[] {
  const troubled = rows.filter((row) => row.kind === "material" && (isOver(row.verdict) || row.verdict === "warn"));
  return groupRows(troubled, "cause").sort(
    // What is not known helps least, as in the terminal's table.
    (a, b) => Number(a.label === kUnknownCause) - Number(b.label === kUnknownCause) || b.over - a.over || b.rows.length - a.rows.length,
  );
}

/** Whether the baseline has any of these rows under the same conditions; where it has none of them at all, nothing says otherwise. */
export function isComparable(rows: readonly Row[]): boolean {
  const common = rows.filter((row) => row.isInBaseline);
  return common.length === 0 || common.some((row) => !row.changes.includes("not comparable"));
}

export function factsOf(rows: readonly Row[]): Facts {
  const materials = rows.filter((row) => row.kind === "material");
  return {
    lists: { materials: factsOfList(rows, "materials"), views: factsOfList(rows, "views") },
    causes: causeTotals(rows),
    materials: countChanges(materials),
    isComparable: isComparable(materials),
  };
}
