// The list of a report as report/overview.cpp writes it, made from the report itself: for reports made by hand or changed
// by a test. tests/e2e/overview_data.test.ts holds the two against each other.
import type { PackedColumn, PackedTable } from "../src/data/columns";
import { kStandings, type Standing } from "../src/data/history";
import type { Judged } from "../src/data/judged";
import { Overview, type Limit, type PackedOverview } from "../src/data/overview";
import { makeRows, type Row } from "../src/data/rows";
import type { Attribution, Images, Material, Report, TermEffect, Verdict, View, WhatIf } from "../src/data/types";

const kVerdicts: Verdict[] = ["pass", "not seen", "too small", "not judged", "warn", "fail", "not run", "error"];
const kLeastShare = 0.1; // of FLIP that a cause explains, or a preset takes off

class Places<T> {
  readonly values: T[] = [];
  private readonly places = new Map<string, number>();
  of(value: T): number {
    const key = JSON.stringify(value);
    const place = this.places.get(key) ?? this.values.push(value) - 1;
    this.places.set(key, place);
    return place;
  }
}

const base64 = (values: Uint32Array | Float32Array): string => Buffer.from(values.buffer).toString("base64");
const pack = (values: (number | null)[], isReal: boolean): PackedColumn =>
  isReal ? { f32: base64(Float32Array.from(values, (value) => value ?? NaN)) } : { u32: base64(Uint32Array.from(values, (value) => value ?? 0)) };

function table(rows: Record<string, number | null>[], names: readonly string[], reals: readonly string[] = []): PackedTable {
  return { count: rows.length, columns: Object.fromEntries(names.map((name) => [name, pack(rows.map((row) => row[name] ?? null), reals.includes(name))])) };
}

function causeOf(attribution: Attribution | undefined): TermEffect | null {
  if (!attribution || attribution.flip === null || attribution.flip < 0.0005) return null;
  const best = [...attribution.terms].sort((a, b) => (a.flip ?? Infinity) - (b.flip ?? Infinity))[0];
  return best && (best.flip ?? Infinity) <= attribution.flip * (1 - kLeastShare) ? best : null;
}

function hasFlipToExplain({ figures, verdict }: Material): boolean {
  return figures !== null && figures.nonFinite === 0 && verdict !== "error";
}

function noCauseOf(material: Material): string {
  const { figures, verdict, checks, baseline } = material;
  if (material.seenElsewhere) return "another view shows it";
  if (figures === null) return "not seen in any view";
  if (figures.nonFinite > 0) return "NaN or infinite pixels";
  if (verdict === "error") return "could not be judged";
  if (material.attribution) return "no single term explains it";
  if (!checks.some((check) => ["warn", "fail", "error"].includes(check.verdict))) {
    if ((material.notModelled ?? []).length > 0) return `base layer only: parity does not model ${(material.notModelled ?? []).join(", ")}`;
    if ((figures.clippedBlack ?? 0) + (figures.clippedWhite ?? 0) >= 0.05) return "black or white in both pictures";
    if ((baseline?.notComparable ?? "") !== "") return "not comparable to the baseline";
  }
  return "cause not measured";
}

function bestOf(material: Material): WhatIf | null {
  const flip = ({ figures }: Pick<Material, "figures">): number => figures?.metrics["flip.mean"] ?? Infinity;
  const gravity = (verdict: Verdict): number => kVerdicts.indexOf(verdict);
  const helps = (each: WhatIf): boolean => {
    const by = gravity(material.verdict) - gravity(each.verdict);
    return ["pass", "warn", "fail"].includes(each.verdict) && (by > 0 || (by === 0 && flip(each) <= flip(material) * (1 - kLeastShare)));
  };
  return (material.whatIf ?? []).filter(helps).sort((a, b) => gravity(a.verdict) - gravity(b.verdict) || flip(a) - flip(b))[0] ?? null;
}

const isFailure = (verdict: Verdict | null | undefined): boolean => verdict === "fail" || verdict === "error";

/** As report/standing.cpp has it of a report without a history. */
export function standingOf(judged: Judged): Standing {
  const { baseline } = judged;
  if (isFailure(judged.verdict)) return !baseline ? "unknown" : isFailure(baseline.verdict) ? "still" : "new";
  if ((judged.accepted ?? "") !== "") return "accepted";
  return isFailure(baseline?.verdict) && ["pass", "warn"].includes(judged.verdict) ? "fixed" : "";
}

function ownerOf({ checks, budget }: Judged): string {
  return checks.find(({ approval, verdict }) => approval && ["warn", "fail", "error"].includes(verdict))?.approval?.owner ?? budget.owner;
}

export interface OverRuns {
  standing?: Standing;
  nights?: number;
}

/** overRuns: what a history says of the rows, by their place among all. */
export function packOverview(report: Report, overRuns: Readonly<Record<number, OverRuns>> = {}): PackedOverview {
  const texts = new Places<string>();
  const lists = new Places<number[]>();
  const limits = new Places<Limit[]>();
  texts.of("");
  lists.of([]);
  const list = (all: readonly string[]): number => lists.of(all.map((text) => texts.of(text)));
  const paths = ({ reference, test, flip }: Images): number => list([reference, test, flip]);
  const figures: (Judged["figures"])[] = [];

  const rowOf = (judged: Judged, material: Material | null, images: Images): Record<string, number | null> => {
    const { baseline } = judged;
    const cause = material && hasFlipToExplain(material) ? causeOf(material.attribution) : null;
    const better = material && bestOf(material);
    const over = overRuns[figures.length] ?? {};
    figures.push(judged.figures);
    return {
      standing: kStandings.indexOf(over.standing ?? standingOf(judged)), nights: over.nights ?? 0, owner: texts.of(ownerOf(judged)),
      name: texts.of(material?.name ?? ""), verdict: kVerdicts.indexOf(judged.verdict), seenElsewhere: Number(material?.seenElsewhere ?? false),
      reason: texts.of(judged.reason), accepted: texts.of(judged.accepted ?? ""), bias: texts.of(judged.bias), pixels: judged.figures?.pixels ?? 0,
      nonFinite: judged.figures?.nonFinite ?? 0, preset: texts.of(judged.budget.preset), images: paths(images), notModelled: list(material?.notModelled ?? []),
      limits: limits.of(judged.checks.filter((check) => !check.regress).map(({ metric, warn, fail, verdict }) => ({ metric, warn, fail, verdict }))),
      before: !baseline ? 0 : baseline.new ? 1 : 2 + kVerdicts.indexOf(baseline.verdict ?? "pass"), notComparable: texts.of(baseline?.notComparable ?? ""),
      change: baseline?.changes["flip.mean"] ?? null, noCause: texts.of(material && !cause ? noCauseOf(material) : ""),
      cause: texts.of(cause?.term ?? ""), causeBefore: cause ? (material?.attribution?.flip ?? null) : null, causeAfter: cause?.flip ?? null,
      better: texts.of(better?.preset ?? ""), betterVerdict: better ? kVerdicts.indexOf(better.verdict) : 0, betterFlip: better?.figures?.metrics["flip.mean"] ?? null,
    };
  };
  const views: View[] = report.scenes.flatMap((scene) => scene.views);
  const rows = views.flatMap((view) => [...view.materials.map((material) => rowOf(material, material, material.crops)), rowOf(view.whole, null, view.images)]);
  const names = new Set(figures.flatMap((each) => Object.keys(each?.metrics ?? {})));
  const viewRows = views.map((view) => ({
    name: texts.of(view.name), reference: texts.of(view.reference), test: texts.of(view.test), width: view.width, height: view.height, prefix: 0, materials: view.materials.length,
  }));
  const sceneRows = report.scenes.map((scene) => ({
    name: texts.of(scene.name), source: texts.of(scene.source), error: texts.of(scene.error?.message ?? ""), views: scene.views.length, warnings: list(scene.warnings),
    verdict: scene.error === null ? 0 : kVerdicts.indexOf(scene.error.exitCode > 128 ? "not run" : "error"),
  }));
  const whole = ["name", "verdict", "seenElsewhere", "reason", "accepted", "bias", "pixels", "nonFinite", "preset", "images", "notModelled", "limits", "before", "notComparable", "cause", "noCause", "better", "betterVerdict", "standing", "nights", "owner"];
  const reals = ["change", "causeBefore", "causeAfter", "betterFlip"];
  return {
    verdicts: kVerdicts, texts: texts.values, lists: lists.values, limits: limits.values,
    scenes: table(sceneRows, ["name", "source", "error", "verdict", "warnings", "views"]),
    views: table(viewRows, ["name", "reference", "test", "width", "height", "prefix", "materials"]),
    rows: { ...table(rows, [...whole, ...reals], reals), figures: Object.fromEntries([...names].map((name) => [name, pack(figures.map((each) => each?.metrics[name] ?? null), true)])) },
  };
}

export function overviewOf(report: Report, overRuns: Readonly<Record<number, OverRuns>> = {}): Overview {
  return new Overview(packOverview(report, overRuns));
}

export function rowsOf(report: Report, overRuns: Readonly<Record<number, OverRuns>> = {}): Row[] {
  return makeRows(overviewOf(report, overRuns));
}
