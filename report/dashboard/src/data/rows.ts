// The report as a flat list: a row for each material in each view, for each whole image, for each scene that failed.
import type { Judged } from "./judged";
import type { Item } from "./state";
import type { Attribution, Check, Material, Report, Scene, Verdict, View } from "./types";

export type Kind = "material" | "whole" | "scene";

export interface Row {
  kind: Kind;
  scene: number; // places in the report; -1 where there is none
  view: number;
  material: number;
  link: Item; // the same by name: what a link says
  order: number; // in the report
  name: string; // of the material, or what the row is
  place: string; // scene and view
  reference: string; // paths, by name; "" where none was rendered
  test: string;
  verdict: Verdict;
  gravity: number; // larger is graver
  reason: string;
  bias: string;
  pixels: number;
  judged: Judged | null; // null: a scene that failed
  cause: Cause | null;
  preset: string; // of budgets
  notModelled: readonly string[]; // parts of the material that no path models: only its base layer is judged
  isNew: boolean;
  change: number | null; // of mean FLIP since the baseline
  text: string; // what a search looks at, in lower case
}

/** The one term whose swap helps most. */
export interface Cause {
  term: string;
  before: number;
  after: number;
}

const kVerdicts: readonly Verdict[] = ["pass", "not seen", "too small", "not judged", "warn", "fail", "error"]; // by gravity
/** A swap that lowers FLIP by less than this share explains nothing (compare/verdict/wording.h says the same). */
export const kLeastShare = 0.1;
const kLeastFlip = 0.0005; // below it reads 0.000: there is nothing to explain

export function gravityOf(verdict: Verdict): number {
  const place = kVerdicts.indexOf(verdict);
  return place < 0 ? kVerdicts.length - 1 : place;
}

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

function changeOf({ baseline }: Judged): number | null {
  return !baseline || baseline.new ? null : (baseline.changes["flip.mean"] ?? null);
}

/** "base layer only: no path models clearcoat, sheen"; "" where all is modelled. */
export function baseLayerText(notModelled: readonly string[]): string {
  return notModelled.length === 0 ? "" : `base layer only: no path models ${notModelled.join(", ")}`;
}

type Judgement = Omit<Row, "scene" | "view" | "material" | "link" | "order">;

function judgedRow(kind: Kind, scene: Scene, view: View, judged: Judged, name: string): Judgement {
  const { attribution, notModelled = [] } = judged as Partial<Material>;
  const cause = causeOf(attribution);
  const place = kind === "whole" ? scene.name : `${scene.name} · ${view.name}`;
  return {
    kind,
    name,
    place,
    reference: view.reference,
    test: view.test,
    verdict: judged.verdict,
    gravity: gravityOf(judged.verdict),
    reason: [judged.reason, judged.accepted && `accepted: ${judged.accepted}`].filter(Boolean).join("; "),
    bias: judged.bias,
    pixels: judged.figures?.pixels ?? 0,
    judged,
    cause,
    preset: judged.budget.preset ?? "",
    notModelled,
    isNew: judged.baseline?.new ?? false,
    change: changeOf(judged),
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
        verdict: "error", gravity: gravityOf("error"), reason: scene.error.message, bias: "", pixels: 0,
        judged: null, cause: null, preset: "", notModelled: [], isNew: false, change: null,
        text: `${scene.name} ${scene.source} ${scene.error.message}`.toLowerCase(),
      });
    scene.views.forEach((view, v) => {
      const ofView = { ...link, view: viewLinks[v] ?? "" };
      const materialLinks = linkNames(view.materials);
      view.materials.forEach((material, m) => {
        if (material.seenElsewhere) return;
        rows.push({ scene: s, view: v, material: m, link: { ...ofView, material: materialLinks[m] ?? "" }, order: rows.length, ...judgedRow("material", scene, view, material, material.name) });
      });
      rows.push({ scene: s, view: v, material: -1, link: ofView, order: rows.length, ...judgedRow("whole", scene, view, view.whole, view.name) });
    });
  });
  return rows;
}
