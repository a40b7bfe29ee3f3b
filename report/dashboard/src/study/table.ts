// A table that is sorted by any of its columns.
import { html, nothing, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";

import { PageElement } from "../element";
import { help, type Topic } from "../help";

type Value = string | number | null | undefined;

export interface Column<Row> {
  label: string;
  group?: string; // over neighbours of the same
  topic?: Topic;
  value: (row: Row) => Value; // by which it is sorted; null and undefined come last
  show?: (row: Row) => unknown; // in place of the value
  isText?: boolean;
}

/** The rows by a column; equal ones, and those without a value, as they were. */
export function sorted<Row>(rows: readonly Row[], value: (row: Row) => Value, ascending: boolean): Row[] {
  const isMissing = (each: Value): boolean => each === null || each === undefined || each === "";
  return [...rows].sort((first, second) => {
    const a = value(first), b = value(second);
    if (isMissing(a) || isMissing(b)) return Number(isMissing(a)) - Number(isMissing(b));
    const order = typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en", { numeric: true });
    return ascending ? order : -order;
  });
}

@customElement("parity-table")
export class ParityTable<Row> extends PageElement {
  @property() label = "";
  @property({ attribute: false }) columns: readonly Column<Row>[] = [];
  @property({ attribute: false }) rows: readonly Row[] = [];
  @property({ attribute: false }) rowClass: (row: Row) => string = () => "";
  @state() private by = -1; // -1: as they are given
  @state() private ascending = true;

  /** Up, down, and as they were. */
  private sortBy(index: number): void {
    if (this.by === index && !this.ascending) {
      this.by = -1;
      this.ascending = true;
    } else {
      this.ascending = this.by !== index;
      this.by = index;
    }
  }

  private head(column: Column<Row>, index: number): TemplateResult {
    const order = this.by !== index ? "none" : this.ascending ? "ascending" : "descending";
    return html`<th scope="col" class=${column.isText ? "" : "number"} aria-sort=${order}>
      <button type="button" class="sort" @click=${() => this.sortBy(index)}>${column.label}<span aria-hidden="true">${order === "none" ? "" : this.ascending ? " ▲" : " ▼"}</span></button>${column.topic ? help(column.topic) : nothing}
    </th>`;
  }

  private groups(): TemplateResult | typeof nothing {
    if (this.columns.every((each) => each.group === undefined)) return nothing;
    const cells: { group: string; span: number }[] = [];
    for (const { group = "" } of this.columns) {
      const last = cells.at(-1);
      if (last && last.group === group) ++last.span;
      else cells.push({ group, span: 1 });
    }
    return html`<tr>${cells.map(({ group, span }) => (group === "" ? html`<td colspan=${span}></td>` : html`<th scope="colgroup" class="group" colspan=${span}>${group}</th>`))}</tr>`;
  }

  protected override render(): TemplateResult {
    const column = this.columns[this.by];
    const rows = column ? sorted(this.rows, column.value, this.ascending) : this.rows;
    const shown = (each: Column<Row>, row: Row): unknown => (each.show ? each.show(row) : (each.value(row) ?? "–"));
    return html`<div class="table-scroll" tabindex="0" role="group" aria-label=${this.label}><table>
      <thead>${this.groups()}<tr>${this.columns.map((each, index) => this.head(each, index))}</tr></thead>
      <tbody>${rows.map((row) => html`<tr class=${this.rowClass(row)}>${this.columns.map((each, index) =>
        index === 0 ? html`<th scope="row"><bdi>${shown(each, row)}</bdi></th>` : html`<td class=${each.isText ? "" : "number"}>${shown(each, row)}</td>`)}</tr>`)}</tbody>
    </table></div>`;
  }
}

export function table<Row>(label: string, rows: readonly Row[], columns: readonly Column<Row>[], rowClass: (row: Row) => string = () => ""): TemplateResult {
  return html`<parity-table .label=${label} .columns=${columns} .rows=${rows} .rowClass=${rowClass}></parity-table>`;
}
