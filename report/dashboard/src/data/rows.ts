// The report as a flat list: a row for each material in each view, for each whole image, for each scene that failed or was not run.
import { changesOf, flipChangeOf, type ChangeKind } from "./changes";
import { gravityOf } from "./gravity";
import type { Judged } from "./judged";
import type { Item } from "./state";
import type { Attribution, Check, Material, Report, Scene, Verdict, View, WhatIf } from "./types";
import { bestWhatIf } from "./what_if";
import { typeset } from "./wording";

export type Kind = "material" | "whole" | "scene";

export interface Row {
  kind: Kind;
  scene: number; // places in the report; -1 where there is none
  view: number;
  material: number;
  link: Item; // the same by name: what a link says
  order: number; // in the report
  name: string; // of the material, the scene and view, or the scene
  place: string; // scene and view of a material; else what the row is
  reference: string; // paths, by name; "" where none was rendered
  test: string;
  verdict: Verdict;
  gravity: number; // larger is graver
  reason: string;
  accepted: string; // what its budget accepts although it is no pass; "": nothing
  bias: string;
  pixels: number;
  judged: Judged | null; // null: a scene that failed
  cause: Cause | null;
  help: WhatIf | null; // the preset of the test path that would help most, if the run has measured one
  preset: string; // of budgets
  notModelled: readonly string[]; // parts of the material that no path models: only its base layer is judged
  isAttributed: boolean; // the report looked for its cause
  changes: readonly ChangeKind[]; // since the baseline
  change: number | null; // of mean FLIP since the baseline
  text: string; // what a search looks at, in lower case
}

/** The one term whose swap helps most. */
export interface Cause {
  term: string;
  before: number;
  after: number;
}

/** A swap that lowers FLIP by less than this share explains nothing (compare/verdict/wording.h says the same). */
export const kLeastShare = 0.1;
const kLeastFlip = 0.0005; // below it reads 0.000: there is nothing to explain

/** The term that lowers FLIP most, where it does so by a tenth at least. */
export function causeOf(attribution: Attribution | undefined): Cause | null {
  if (!attribution || attribution.flip === null || attribution.flip < kLeastFlip) return null;
  let best: Cause | null = null;
  for (const each of attribution.terms)
    if (each.flip !== null && each.flip <= attribution.flip * (1 - kLeastShare) && (!best || each.flip < best.after))
      best = { term: each.term, before: attribution.flip, after: each.flip };
  return best;
}

/** A figure of a row, or null where it is not known. */
export function figureOf(row: Row, name: string): number | null {
  return row.judged?.figures?.metrics[name] ?? null;
}

/** The check that judges a figure itself, not its regression. */
export function checkOf(row: Row, metric: string): Check | null {
  return row.judged?.checks.find((check) => check.metric === metric && !check.regress) ?? null;
}

/** Of a scene that has one: "not run" where a signal ended the run before it was done. */
function ownVerdict({ exitCode }: NonNullable<Scene["error"]>): Verdict {
  return exitCode > 128 ? "not run" : "error";
}

/** "base layer only: no path models clearcoat, sheen"; "" where all is modelled. */
export function baseLayerText(notModelled: readonly string[]): string {
  return notModelled.length === 0 ? "" : `base layer only: no path models ${notModelled.join(", ")}`;
}

type Judgement = Omit<Row, "scene" | "view" | "material" | "link" | "order">;

function judgedRow(kind: Kind, scene: Scene, view: View, judged: Judged, name: string): Judgement {
  const { attribution, notModelled = [] } = judged as Partial<Material>;
  const cause = causeOf(attribution);
  const place = kind === "whole" ? `whole view, ${view.width} × ${view.height}` : `${scene.name} · ${view.name}`;
  return {
    kind,
    name,
    place,
    reference: view.reference,
    test: view.test,
    verdict: judged.verdict,
    gravity: gravityOf(judged.verdict),
    reason: typeset(judged.reason),
    accepted: typeset(judged.accepted ?? ""),
    bias: typeset(judged.bias),
    pixels: judged.figures?.pixels ?? 0,
    judged,
    cause,
    help: kind === "material" ? bestWhatIf(judged as Material) : null,
    preset: judged.budget.preset ?? "",
    notModelled,
    isAttributed: attribution !== undefined,
    changes: changesOf(judged),
    change: flipChangeOf(judged),
    text: `${name} ${place} ${judged.reason} ${judged.accepted ? "accepted" : ""} ${judged.accepted ?? ""} ${cause?.term ?? ""} ${baseLayerText(notModelled)}`.toLowerCase(),
  };
}

/** What links call them: their names; of those alike the second has " (2)" behind it, and so on. Never "". */
export function linkNames(named: readonly { name: string }[]): string[] {
  const taken = new Set<string>();
  return named.map(({ name }) => {
    const plain = name === "" ? "(no name)" : name;
    let link = plain;
    for (let n = 2; taken.has(link); ++n) link = `${plain} (${n})`;
    taken.add(link);
    return link;
  });
}

/** Materials not seen in a view but in another one do not count, and have no row. */
export function makeRows(report: Report): Row[] {
  const rows: Row[] = [];
  const sceneLinks = linkNames(report.scenes);
  report.scenes.forEach((scene, s) => {
    const link: Item = { scene: sceneLinks[s] ?? "", view: "", material: "" };
    const viewLinks = linkNames(scene.views);
    if (scene.error)
      rows.push({
        kind: "scene", scene: s, view: -1, material: -1, link, order: rows.length, name: scene.name, place: scene.source, reference: "", test: "",
        verdict: ownVerdict(scene.error), gravity: gravityOf(ownVerdict(scene.error)), reason: scene.error.message, accepted: "", bias: "", pixels: 0,
        judged: null, cause: null, help: null, preset: "", notModelled: [], isAttributed: false, changes: [], change: null,
        text: `${scene.name} ${scene.source} ${scene.error.message}`.toLowerCase(),
      });
    scene.views.forEach((view, v) => {
      const ofView = { ...link, view: viewLinks[v] ?? "" };
      const materialLinks = linkNames(view.materials);
      view.materials.forEach((material, m) => {
        if (material.seenElsewhere) return;
        rows.push({ scene: s, view: v, material: m, link: { ...ofView, material: materialLinks[m] ?? "" }, order: rows.length, ...judgedRow("material", scene, view, material, material.name) });
      });
      rows.push({ scene: s, view: v, material: -1, link: ofView, order: rows.length, ...judgedRow("whole", scene, view, view.whole, `${scene.name} · ${view.name}`) });
    });
  });
  return rows;
}
