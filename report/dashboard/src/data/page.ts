// The data blocks of index.html, checked as far as the page relies on them.
import { reasonOf } from "./reason";
import { sweepOf, type Sweep } from "./bench";
import type { EarlierRuns } from "./history";
import { Overview, type PackedOverview } from "./overview";
import { kSchema, type Report, type Run } from "./types";

/** The report without its scenes, and its run without their commands, which lie in files of their own (data/scenes). */
export type Head = Omit<Report, "scenes">;
export type RunHead = Omit<Run, "again">;

export interface Page {
  report: Head;
  overview: Overview;
  run: RunHead | null;
  bench: Sweep | null;
  history: EarlierRuns | null; // the runs before this one; null: none is known
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

/** The report of this page, or why it cannot be shown. A run, a bench or a history that cannot be read is left out. */
export function readPage(document: Document): Page | Problem {
  let report: unknown;
  let packed: unknown;
  try {
    report = parseBlock(document, "report");
    packed = parseBlock(document, "overview");
  } catch (error) {
    return { problem: `Its data is damaged: ${reasonOf(error)}.` };
  }
  const problem = problemOf(report, packed);
  if (problem !== "") return { problem };
  let overview: Overview;
  try {
    overview = new Overview(packed as PackedOverview);
  } catch (error) {
    return { problem: `The list of its rows is damaged: ${reasonOf(error)}.` };
  }
  const optional = (id: string): unknown => {
    try {
      return parseBlock(document, id);
    } catch {
      return null;
    }
  };
  (report as Head).statistics ??= {};
  const run = optional("run");
  return { report: report as Head, overview, run: isObject(run) ? (run as unknown as RunHead) : null, bench: sweepOf(optional("bench"), optional("bench-plots")), history: historyOf(optional("history")) };
}

/** The runs before this one; null where there are none, or they are not of this form. */
export function historyOf(value: unknown): EarlierRuns | null {
  if (!isObject(value) || value["format"] !== 1 || !Array.isArray(value["runs"]) || value["runs"].length === 0) return null;
  const isRun = (run: unknown): boolean => isObject(run) && ["name", "started", "commit", "verdict"].every((key) => typeof run[key] === "string");
  if (!value["runs"].every(isRun) || typeof value["branch"] !== "string") return null;
  return value as unknown as EarlierRuns;
}

function isTable(value: unknown): boolean {
  return isObject(value) && typeof value["count"] === "number" && isObject(value["columns"]);
}

/** Why it is no report that this page can show; "" if it is one. */
export function problemOf(report: unknown, overview: unknown): string {
  if (!isObject(report)) return "This page holds no report.";
  if (report["schema"] !== kSchema)
    return `It has schema version ${JSON.stringify(report["schema"]) ?? "unknown"}; this page reads version ${kSchema}. Open it with the version of parity that wrote it.`;
  if (!Array.isArray(report["settings"]) || !isObject(report["counts"])) return "Its data is not complete.";
  if (!isObject(overview) || !["verdicts", "texts", "lists", "limits"].every((key) => Array.isArray(overview[key])) || !["scenes", "views", "rows"].every((key) => isTable(overview[key])))
    return "The list of its rows is not complete.";
  return "";
}
