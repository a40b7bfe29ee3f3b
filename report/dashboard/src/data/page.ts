// The data blocks of index.html, checked as far as the page relies on them.
import { reasonOf } from "./reason";
import { sweepOf, type Sweep } from "./bench";
import { kSchema, type Report, type Run } from "./types";

export interface Page {
  report: Report;
  run: Run | null;
  bench: Sweep | null;
}
export type Problem = { problem: string };

export function hasBlock(document: Document, id: string): boolean {
  return document.getElementById(id) !== null;
}

export function parseBlock(document: Document, id: string): unknown {
  const block = document.getElementById(id);
  return block ? JSON.parse(block.textContent ?? "") : null;
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** The report of this page, or why it cannot be shown. A run or a bench that cannot be read is left out. */
export function readPage(document: Document): Page | Problem {
  let report: unknown;
  try {
    report = parseBlock(document, "report");
  } catch (error) {
    return { problem: `Its data is damaged: ${reasonOf(error)}.` };
  }
  const problem = problemOf(report);
  if (problem !== "") return { problem };
  const optional = (id: string): unknown => {
    try {
      return parseBlock(document, id);
    } catch {
      return null;
    }
  };
  (report as Report).statistics ??= {};
  const run = optional("run");
  return { report: report as Report, run: isObject(run) ? (run as unknown as Run) : null, bench: sweepOf(optional("bench"), optional("bench-plots")) };
}

/** Why it is no report that this page can show; "" if it is one. */
export function problemOf(report: unknown): string {
  if (!isObject(report)) return "This page holds no report.";
  if (report["schema"] !== kSchema)
    return `It has schema version ${JSON.stringify(report["schema"]) ?? "unknown"}; this page reads version ${kSchema}. Open it with the version of parity that wrote it.`;
  if (!Array.isArray(report["scenes"]) || !Array.isArray(report["settings"]) || !isObject(report["counts"]))
    return "Its data is not complete.";
  return "";
}
