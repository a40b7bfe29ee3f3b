// All that the page shows, as the URL's hash: a link shows what its sender saw.

export const kModes = ["side", "slider", "onion", "flicker", "difference", "flip"] as const;
export type Mode = (typeof kModes)[number];
export const kTabs = ["compare", "terms", "numbers", "history"] as const; // history: where earlier runs are known
export const kLists = ["materials", "views"] as const;
export type List = (typeof kLists)[number];
export const kGroupings = ["none", "material", "scene", "cause"] as const;
export type Grouping = (typeof kGroupings)[number];
export type Tab = (typeof kTabs)[number];

/** The comparison view's part of the state. */
export interface ViewerState {
  mode: Mode;
  exposure: number; // EV, on top of the scene's; 0: the pictures as the report judged them
  threshold: number; // FLIP below it is shown as alike; 0: all of the map
  autoRange: boolean; // of FLIP and difference maps: what their pixels need; else all of FLIP, and the gain
  gain: number; // of the difference, where its range is fixed
  split: number; // of the slider, 0..1 of the pane's width
  opacity: number; // of mobile in the onion skin, 0..1
  zoom: number; // 1: the picture fits its pane
  panX: number; // what is at the pane's centre, 0..1 of the picture
  panY: number;
  pixelX: number; // inspected pixel; -1: none
  pixelY: number;
  term: string; // "": the colour; else the term whose images are shown
  falseColor: boolean; // luminance in place of colours
  showTruth: boolean;
  showBaseline: boolean; // its pictures, where they are not as in this run
  dimOthers: boolean; // all but the chosen material
}

/** What is open, by the names that links have for it (linkNames in data/rows.ts). */
export interface Item {
  scene: string; // "": nothing is open
  view: string; // "": the scene as a whole
  material: string; // "": the view's whole image
}

export interface State extends ViewerState, Item {
  tab: Tab;
  list: List;
  query: string;
  verdicts: string[]; // shown; empty: all
  changes: string[]; // shown: standings, and changes since the baseline; empty: all
  causedBy: string; // the overview's filter: only rows that this term explains; "": all
  preset: string; // "": all
  group: Grouping;
  folded: boolean; // groups show their heads alone
  sort: string; // "gravity", "name", "order", or a column's figure: "flip.mean"
  ascending: boolean;
}

export const kDefaultState: Readonly<State> = {
  mode: "side",
  exposure: 0,
  threshold: 0,
  autoRange: true,
  gain: 4,
  split: 0.5,
  opacity: 0.5,
  zoom: 1,
  panX: 0.5,
  panY: 0.5,
  pixelX: -1,
  pixelY: -1,
  term: "",
  falseColor: false,
  showTruth: false,
  showBaseline: false,
  dimOthers: true,
  scene: "",
  view: "",
  material: "",
  tab: "compare",
  list: "materials",
  query: "",
  verdicts: [],
  changes: [],
  causedBy: "",
  preset: "",
  group: "none",
  folded: false,
  sort: "gravity",
  ascending: false,
};

type Bounds = readonly [least: number, most: number];
const kBounds: Partial<Record<keyof State, Bounds>> = {
  exposure: [-16, 16],
  threshold: [0, 1],
  gain: [1, 64],
  split: [0, 1],
  opacity: [0, 1],
  zoom: [0.25, 64],
  panX: [-1, 2],
  panY: [-1, 2],
  pixelX: [-1, 65535],
  pixelY: [-1, 65535],
};
/** Keys whose value is one of these words. */
const kWords: Partial<Record<keyof State, readonly string[]>> = { mode: kModes, list: kLists, tab: kTabs, group: kGroupings };
const kWhole = new Set<keyof State>(["pixelX", "pixelY"]);

/** What an item shows when it is opened: how it is compared stays, where one looked and what was pointed at does not. */
export function openItem(state: State, item: Item): State {
  const { zoom, panX, panY, pixelX, pixelY, term } = kDefaultState;
  return { ...state, zoom, panX, panY, pixelX, pixelY, term, ...item };
}

export function isSameItem(a: Item, b: Item): boolean {
  return a.scene === b.scene && a.view === b.view && a.material === b.material;
}

/** Only what differs from the default, in a fixed order. */
export function toHash(state: State): string {
  const parameters = new URLSearchParams();
  for (const key of Object.keys(kDefaultState) as (keyof State)[]) {
    const value = state[key];
    if (Array.isArray(value)) {
      if (value.length > 0) parameters.set(key, value.join(","));
    } else if (value !== kDefaultState[key]) {
      parameters.set(key, typeof value === "number" ? String(Number(value.toFixed(4))) : String(value));
    }
  }
  const text = parameters.toString();
  return text === "" ? "" : "#" + text;
}

/** What the hash does not say, or says wrongly, is as by default. */
export function fromHash(hash: string): State {
  const parameters = new URLSearchParams(hash.replace(/^#/, ""));
  const state: State = { ...kDefaultState, verdicts: [], changes: [] };
  const target = state as unknown as Record<string, unknown>;
  for (const key of Object.keys(kDefaultState) as (keyof State)[]) {
    const text = parameters.get(key);
    if (text === null) continue;
    const usual = kDefaultState[key];
    if (Array.isArray(usual)) target[key] = text.split(",").filter((each) => each !== "");
    else if (typeof usual === "boolean") target[key] = text === "true";
    else if (typeof usual === "number") {
      const value = text.trim() === "" ? NaN : Number(text);
      const [least, most] = kBounds[key] ?? [-Infinity, Infinity];
      if (Number.isFinite(value) && value >= least && value <= most && (!kWhole.has(key) || Number.isInteger(value)))
        target[key] = value;
    } else if (kWords[key]?.includes(text) ?? true) target[key] = text;
  }
  return state;
}
