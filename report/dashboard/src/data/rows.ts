// The report as a flat list: a row for each material in each view, for each whole image, for each scene that failed or
// was not run.
import { changesOf, kNoChange, type ChangeKind } from "./changes";
import { realOf } from "./columns";
import { gravityOf } from "./gravity";
import { kStandings, type Standing } from "./history";
import type { Limit, Overview } from "./overview";
import type { Item } from "./state";
import type { Images, Verdict } from "./types";
import { typeset } from "./wording";

export type Kind = "material" | "whole" | "scene";

/** The one term whose swap helps most. */
export interface Cause {
  term: string;
  before: number;
  after: number;
}

/** The preset of the test path that would help most, and what it gives. */
export interface Better {
  preset: string;
  verdict: Verdict;
  flip: number | null; // mean
}

/** What the overview says of it; all else is in its scene's details. */
export class Row {
  constructor(
    private readonly all: Overview,
    readonly kind: Kind,
    readonly scene: number, // places in the report; -1 where there is none
    readonly view: number,
    readonly material: number,
    readonly order: number, // in the list
    private readonly at: number, // its place in the overview's rows; of a scene -1
    private readonly viewAt: number, // of its view in the overview's views; of a scene -1
  ) {}

  /** The same by name: what a link says. */
  get link(): Item {
    const links = this.kind === "material" ? this.all.linksOfMaterials(this.viewAt) : [];
    return { scene: this.sceneLink, view: this.viewLink, material: links[this.material] ?? "" };
  }
  get sceneLink(): string {
    return this.all.sceneLinks[this.scene] ?? "";
  }
  get viewLink(): string {
    return this.view < 0 ? "" : (this.all.linksOfViews(this.scene)[this.view] ?? "");
  }

  /** Of the material, the scene and view, or the scene. */
  get name(): string {
    if (this.kind === "material") return this.all.text(this.all.rows.name[this.at]);
    return this.kind === "whole" ? `${this.sceneName} · ${this.viewName}` : this.sceneName;
  }
  /** Scene and view of a material; else what the row is. */
  get place(): string {
    if (this.kind === "material") return `${this.sceneName} · ${this.viewName}`;
    return this.kind === "whole" ? `whole view, ${this.all.views.width[this.viewAt]} × ${this.all.views.height[this.viewAt]}` : this.all.text(this.all.scenes.source[this.scene]);
  }
  get sceneName(): string {
    return this.all.text(this.all.scenes.name[this.scene]);
  }
  private get viewName(): string {
    return this.all.text(this.all.views.name[this.viewAt]);
  }

  /** Paths, by name; "" where none was rendered. */
  get reference(): string {
    return this.viewAt < 0 ? "" : this.all.text(this.all.views.reference[this.viewAt]);
  }
  get test(): string {
    return this.viewAt < 0 ? "" : this.all.text(this.all.views.test[this.viewAt]);
  }

  /** Whether it was compared: a scene that failed was not. */
  get isJudged(): boolean {
    return this.at >= 0;
  }
  get verdict(): Verdict {
    return this.all.verdicts[this.verdictPlace] ?? "error";
  }
  /** Larger is graver. */
  get gravity(): number {
    return this.all.gravities[this.verdictPlace] ?? gravityOf("error");
  }
  private get verdictPlace(): number {
    return this.at < 0 ? this.all.scenes.verdict[this.scene]! : this.all.rows.verdict[this.at]!;
  }
  get reason(): string {
    return this.at < 0 ? this.all.text(this.all.scenes.error[this.scene]) : typeset(this.all.text(this.all.rows.reason[this.at]));
  }
  /** What its budget accepts although it is no pass; "": nothing. */
  get accepted(): string {
    return typeset(this.textOf("accepted"));
  }
  get bias(): string {
    return typeset(this.textOf("bias"));
  }
  /** Of budgets. */
  get preset(): string {
    return this.textOf("preset");
  }
  get pixels(): number {
    return this.at < 0 ? 0 : this.all.rows.pixels[this.at]!;
  }
  /** Of these, how many are NaN or infinite. */
  get nonFinite(): number {
    return this.at < 0 ? 0 : this.all.rows.nonFinite[this.at]!;
  }
  /** Parts of the material that no path models: only its base layer is judged. */
  get notModelled(): readonly string[] {
    return this.at < 0 ? [] : this.all.list(this.all.rows.notModelled[this.at]);
  }
  /** The checks of its figures, not those of regressions. */
  get limits(): readonly Limit[] {
    return this.at < 0 ? [] : (this.all.limits[this.all.rows.limits[this.at]!] ?? []);
  }
  /** Materials have crops, whole images the view's pictures; null: a scene. */
  get images(): Images | null {
    if (this.at < 0) return null;
    const prefix = this.all.text(this.all.views.prefix[this.viewAt]);
    const [reference = "", test = "", flip = ""] = this.all.list(this.all.rows.images[this.at]).map((end) => (end === "" ? "" : prefix + end));
    return { reference, test, flip };
  }

  get cause(): Cause | null {
    const term = this.causeTerm;
    if (term === "") return null;
    return { term, before: realOf(this.all.rows.causeBefore[this.at]) ?? 0, after: realOf(this.all.rows.causeAfter[this.at]) ?? 0 };
  }
  /** "": there is none, or it is not known. */
  get causeTerm(): string {
    return this.textOf("cause");
  }
  /** Of a material without a cause: why it has none. */
  get noCause(): string {
    return this.textOf("noCause");
  }
  /** Null: none would help, or the run has measured none. */
  get help(): Better | null {
    const preset = this.textOf("better");
    if (preset === "") return null;
    return { preset, verdict: this.all.verdicts[this.all.rows.betterVerdict[this.at]!] ?? "error", flip: realOf(this.all.rows.betterFlip[this.at]) };
  }

  /** The verdict that it had in the baseline; "new": the baseline does not have it; null: there is no baseline. */
  private get before(): Verdict | "new" | null {
    const before = this.at < 0 ? 0 : this.all.rows.before[this.at]!;
    return before === 0 ? null : before === 1 ? "new" : (this.all.verdicts[before - 2] ?? "error");
  }
  /** Whether the baseline has it. */
  get isInBaseline(): boolean {
    return this.before !== null && this.before !== "new";
  }
  /** By its standing, and since the baseline. */
  get changes(): readonly ChangeKind[] {
    const { before, standing } = this;
    if (before === null && standing === "") return kNoChange;
    return changesOf(this.verdict, before, this.change, this.notComparable, standing);
  }
  /** Among the runs before, or against the baseline; "" for a scene that was not compared. */
  get standing(): Standing {
    return this.at < 0 ? "" : (kStandings[this.all.rows.standing[this.at]!] ?? "");
  }
  /** For how many runs it fails, this one included; 0: not known. */
  get nights(): number {
    return this.at < 0 ? 0 : this.all.rows.nights[this.at]!;
  }
  /** Whom to ask: of its approval, else of its budget; "": nobody is named. */
  get owner(): string {
    return this.textOf("owner");
  }
  /** Of mean FLIP since the baseline. */
  get change(): number | null {
    return this.at < 0 ? null : realOf(this.all.rows.change[this.at]);
  }
  /** The conditions that differ from the baseline's; "": none. */
  get notComparable(): string {
    return this.textOf("notComparable");
  }

  /** NaN where it is not known. As it is packed: for sorting; figureOf gives what is shown. */
  packedFigure(name: string): number {
    return this.at < 0 ? NaN : (this.all.figure(name)?.[this.at] ?? NaN);
  }

  /** The places of its texts that a search looks at. */
  get searched(): readonly number[] {
    const { scenes, views, rows } = this.all;
    const scene = scenes.name[this.scene]!;
    if (this.at < 0) return [scene, scenes.source[this.scene]!, scenes.error[this.scene]!];
    return [scene, views.name[this.viewAt]!, rows.name[this.at]!, rows.reason[this.at]!, rows.accepted[this.at]!, rows.cause[this.at]!, rows.owner[this.at]!];
  }
  /** What a search looks at besides, in lower case. */
  get searchedWords(): string {
    if (this.at < 0) return "";
    const own = this.kind === "whole" ? `· ${this.place}` : "·";
    return `${own} ${this.all.rows.accepted[this.at] === 0 ? "" : "accepted"} ${baseLayerText(this.notModelled)}`.toLowerCase();
  }

  private textOf(column: "accepted" | "bias" | "preset" | "cause" | "noCause" | "better" | "notComparable" | "owner"): string {
    return this.at < 0 ? "" : this.all.text(this.all.rows[column][this.at]);
  }
}

/** A figure of a row, or null where it is not known. */
export function figureOf(row: Row, name: string): number | null {
  return realOf(row.packedFigure(name));
}

/** The check that judges a figure itself, not its regression. */
export function checkOf(row: Row, metric: string): Limit | null {
  return row.limits.find((check) => check.metric === metric) ?? null;
}

/** "base layer only: parity does not model subsurface"; "" where all is modelled. */
export function baseLayerText(notModelled: readonly string[]): string {
  return notModelled.length === 0 ? "" : `base layer only: parity does not model ${notModelled.join(", ")}`;
}

/** Materials not seen in a view but in another one do not count, and have no row. */
export function makeRows(all: Overview): Row[] {
  const rows: Row[] = [];
  const { seenElsewhere } = all.rows;
  for (let scene = 0; scene < all.sceneCount; ++scene) {
    if (all.scenes.error[scene] !== 0) rows.push(new Row(all, "scene", scene, -1, -1, rows.length, -1, -1));
    const first = all.viewStarts[scene]!;
    for (let view = first; view < all.viewStarts[scene + 1]!; ++view) {
      const begin = all.rowStarts[view]!;
      const whole = all.rowStarts[view + 1]! - 1;
      for (let at = begin; at < whole; ++at)
        if (seenElsewhere[at] === 0) rows.push(new Row(all, "material", scene, view - first, at - begin, rows.length, at, view));
      rows.push(new Row(all, "whole", scene, view - first, -1, rows.length, whole, view));
    }
  }
  return rows;
}

/** The row that a link leads to; null: there is none. rows: all, in their order. */
export function findRow(all: Overview, rows: readonly Row[], item: Item): Row | null {
  const scene = item.scene === "" ? -1 : all.sceneOfLink(item.scene);
  if (scene < 0) return null;
  let low = 0; // the first row of the scene
  for (let high = rows.length; low < high; ) {
    const middle = (low + high) >> 1;
    if (rows[middle]!.scene < scene) low = middle + 1;
    else high = middle;
  }
  for (let i = low; rows[i]?.scene === scene; ++i) {
    const row = rows[i]!;
    if (row.viewLink === item.view && (row.kind === "material") === (item.material !== "") && row.link.material === item.material) return row;
  }
  return null;
}
