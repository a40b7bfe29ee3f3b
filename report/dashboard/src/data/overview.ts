// What the list needs of every row (report/overview.h), and where its scenes, views and rows lie in it.
import { columnsOf, unpack, type Numbers, type PackedColumn, type PackedTable } from "./columns";
import { gravityOf } from "./gravity";
import type { Check, Verdict } from "./types";

/** Of a check in the list: what it is held against, and what came of it. */
export type Limit = Pick<Check, "metric" | "warn" | "fail" | "verdict">;

/** As index.html has it. */
export interface PackedOverview {
  verdicts: Verdict[];
  texts: string[];
  lists: number[][];
  limits: Limit[][];
  scenes: PackedTable;
  views: PackedTable;
  rows: PackedTable & { figures: Record<string, PackedColumn> };
}

const kSceneColumns = ["name", "source", "error", "verdict", "warnings", "views"] as const;
const kViewColumns = ["name", "reference", "test", "width", "height", "prefix", "materials"] as const;
const kRowColumns = [
  "name", "verdict", "seenElsewhere", "reason", "accepted", "bias", "pixels", "nonFinite", "limits", "preset", "images", "notModelled", "before",
  "notComparable", "change", "cause", "noCause", "causeBefore", "causeAfter", "better", "betterVerdict", "betterFlip",
  "standing", "nights", "owner",
] as const;

/** What links call them: their names; of those alike the second has " (2)" behind it, and so on. Never "". */
export function linkNames(names: readonly string[]): string[] {
  const taken = new Set<string>();
  return names.map((name) => {
    const plain = name === "" ? "(no name)" : name;
    let link = plain;
    for (let n = 2; taken.has(link); ++n) link = `${plain} (${n})`;
    taken.add(link);
    return link;
  });
}

/** Where the parts of each whole begin, with one more for the end. */
function startsOf(counts: Numbers): Uint32Array {
  const starts = new Uint32Array(counts.length + 1);
  for (let i = 0; i < counts.length; ++i) starts[i + 1] = starts[i]! + counts[i]!;
  return starts;
}

function placesFrom(begin: number, end: number): number[] {
  return Array.from({ length: end - begin }, (_, i) => begin + i);
}

export class Overview {
  readonly verdicts: readonly Verdict[];
  readonly gravities: readonly number[]; // of the verdicts
  readonly texts: readonly string[];
  readonly limits: readonly (readonly Limit[])[];
  readonly scenes: Readonly<Record<(typeof kSceneColumns)[number], Numbers>>;
  readonly views: Readonly<Record<(typeof kViewColumns)[number], Numbers>>;
  readonly rows: Readonly<Record<(typeof kRowColumns)[number], Numbers>>;
  readonly sceneCount: number;
  /** The first view of each scene, and the first row of each view: its materials, then the whole image; one more for the end. */
  readonly viewStarts: Uint32Array;
  readonly rowStarts: Uint32Array;
  readonly sceneLinks: readonly string[];
  private readonly figures = new Map<string, Numbers | null>();
  private readonly lists = new Map<number, readonly string[]>();
  private readonly viewLinks = new Map<number, readonly string[]>(); // by scene
  private scenesByLink: Map<string, number> | null = null;
  private lowerTexts: string[] | null = null;

  constructor(private readonly packed: PackedOverview) {
    this.verdicts = packed.verdicts;
    this.gravities = packed.verdicts.map(gravityOf);
    this.texts = packed.texts;
    this.limits = packed.limits;
    this.scenes = columnsOf(packed.scenes, kSceneColumns);
    this.views = columnsOf(packed.views, kViewColumns);
    this.rows = columnsOf(packed.rows, kRowColumns);
    this.sceneCount = packed.scenes.count;
    this.viewStarts = startsOf(this.scenes.views);
    this.rowStarts = startsOf(this.views.materials.map((materials) => materials + 1));
    this.sceneLinks = linkNames(placesFrom(0, this.sceneCount).map((scene) => this.text(this.scenes.name[scene])));
  }

  text(place: number | undefined): string {
    return this.texts[place ?? 0] ?? "";
  }

  list(place: number | undefined): readonly string[] {
    const known = this.lists.get(place ?? 0);
    if (known) return known;
    const made = (this.packed.lists[place ?? 0] ?? []).map((each) => this.text(each));
    this.lists.set(place ?? 0, made);
    return made;
  }

  /** A figure of all rows, NaN where it is not known; null where no row has it. */
  figure(name: string): Numbers | null {
    const known = this.figures.get(name);
    if (known !== undefined) return known;
    const { figures, count } = this.packed.rows;
    const made = Object.hasOwn(figures, name) ? unpack(figures[name], count) : null;
    this.figures.set(name, made);
    return made;
  }

  /** Of the views of a scene, in order. */
  linksOfViews(scene: number): readonly string[] {
    const known = this.viewLinks.get(scene);
    if (known) return known;
    const made = linkNames(placesFrom(this.viewStarts[scene]!, this.viewStarts[scene + 1]!).map((view) => this.text(this.views.name[view])));
    this.viewLinks.set(scene, made);
    return made;
  }

  /** Of the materials of a view, by its place among all views, in order; also of those that have no row. */
  linksOfMaterials(view: number): string[] {
    return linkNames(placesFrom(this.rowStarts[view]!, this.rowStarts[view + 1]! - 1).map((row) => this.text(this.rows.name[row])));
  }

  /** The place of the scene that links call so; -1: none. */
  sceneOfLink(link: string): number {
    this.scenesByLink ??= new Map(this.sceneLinks.map((each, scene) => [each, scene]));
    return this.scenesByLink.get(link) ?? -1;
  }

  /** For each text whether it has the word, which is in lower case. */
  textsWith(word: string): Uint8Array {
    this.lowerTexts ??= this.texts.map((text) => text.toLowerCase());
    return Uint8Array.from(this.lowerTexts, (text) => Number(text.includes(word)));
  }

  /** "Desk: the environment is dark", of all scenes. */
  warnings(): string[] {
    return placesFrom(0, this.sceneCount).flatMap((scene) => this.list(this.scenes.warnings[scene]).map((text) => `${this.text(this.scenes.name[scene])}: ${text}`));
  }

  /** The paths that are tested, each once. */
  tests(): string[] {
    return [...new Set(this.views.test)].map((place) => this.text(place));
  }
}
