// Commands to copy: the same comparison again, and how to accept what it found.
import type { Judged } from "../data/judged";
import type { Row } from "../data/rows";
import type { AgainCommand, Scene } from "../data/types";

/** A word as a POSIX shell takes it. */
export function shellWord(text: string): string {
  return /^[A-Za-z0-9_@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}

/**
 * A name as a glob (base/text/glob.h) that means it, as report/view_choice.h makes it: what would be a wildcard becomes
 * "?", and what a terminal must not get "*".
 */
export function globOf(name: string): string {
  // eslint-disable-next-line no-control-regex -- these are what is looked for
  return name.replace(/[*?[]/g, "?").replace(/[\u0000-\u001f\u007f-\u009f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufffd]/gu, "*");
}

/** The command for this row alone, from those of its scene; null where there is none. */
export function againCommand(again: readonly AgainCommand[], scene: Scene, row: Pick<Row, "kind" | "name" | "view">): string | null {
  const view = scene.views[row.view];
  // A view by a further path has that path's name behind its own.
  const found = view && again.find((each) => each.scene === scene.name && (each.view === view.name || `${each.view} (${view.test})` === view.name));
  if (!found) return null;
  // The run's own --material stays: what else it shows is part of the picture.
  if (row.kind !== "material" || row.name === "" || found.command.includes(" --material")) return found.command;
  const glob = globOf(row.name);
  return `${found.command} --material${glob.startsWith("-") ? "=" : " "}${shellWord(glob)}`;
}

export interface Approvable extends Pick<Judged, "verdict" | "checks" | "figures">, Pick<Row, "kind" | "name"> {
  scene: string; // by name
  view: string;
}

/**
 * The command that approves this row with the figures that it has; what is in capitals is for the reader to fill in. null:
 * no figure of it is beyond a limit, or parity approve refuses it.
 */
export function approveCommand({ verdict, checks, figures, kind, name, scene, view }: Approvable): string | null {
  const isBeyond = (verdict === "fail" || verdict === "warn") && checks.some((check) => check.verdict === "fail" || check.verdict === "warn");
  if (!isBeyond || (figures?.nonFinite ?? 1) > 0 || kind === "scene" || (kind === "material" && name === "")) return null;
  const option = (word: string, of: string): string => {
    const glob = globOf(of);
    return `${word}${glob.startsWith("-") ? "=" : " "}${shellWord(glob)}`;
  };
  const row = kind === "material" ? option("--material", name) : "--whole";
  return ["parity approve .", option("--scene", scene), option("--view", view), row, ...(verdict === "warn" ? ["--warnings"] : []), "--owner WHO --until DATE --reason 'TEXT' -o approvals.toml"].join(" ");
}

/** The ways to accept a report as it is. */
export function acceptCommands(): { what: string; command: string }[] {
  return [
    { what: "Make new limits from the figures of this report:", command: "parity budget suggest report.json -o budgets.toml" },
    { what: "Keep this report as the baseline of later runs:", command: "cp -r . ../baseline && parity report ... --baseline ../baseline" },
  ];
}
