// Which panes a mode has and what each shows: image files, or jobs for canvases once values are needed.
import type { Plane } from "../data/chunk";
import { pathTitle, pathWord } from "../data/paths";
import { kFullSteps } from "../data/range";
import type { ViewerState } from "../data/state";
import type { View } from "../data/types";
import type { Layer } from "./pane";
import type { Job } from "./paint";
import { autoGain, autoMost } from "./ranges";
import { messageOf, valueOf, type Loaded, type PixelSource } from "./source";
import { termLabel } from "./terms";

export interface Scenery {
  view: View;
  material: number; // place in the view; -1: the whole view is looked at
  state: ViewerState;
  source: PixelSource;
  materials: Plane | null; // which material is where, once it is known
  isAtRest: boolean; // until then only image files are shown, where these do
  missing: ReadonlySet<string>; // image files that could not be loaded
  showsTest: boolean; // in the flicker
}

export interface PaneModel {
  key: string;
  label: string;
  right: string; // of what is at the right of a divider; "": one label for all
  note: string;
  message: string; // not empty: instead of pictures
  isWaiting: boolean; // for values; until then the image file is shown, if there is one
  layers: Layer[];
  filter: string;
  split: number | null;
  legend: Legend | null; // of the colours that are no picture's
}

/** What the colours of a pane mean. isAuto: the range is what the pixels need. */
export type Legend =
  | { kind: "flip"; most: number; threshold: number; isAuto: boolean }
  | { kind: "difference"; steps: number; test: string; base: string; isAuto: boolean } // steps of 255 on either side; names in words
  | { kind: "luminance" };

/** "was...": in the baseline. */
type Picture = "reference" | "test" | "truth" | "wasReference" | "wasTest";

function isOfBaseline(picture: Picture): picture is "wasReference" | "wasTest" {
  return picture === "wasReference" || picture === "wasTest";
}

/** The name of the picture's path; of the truth its own. */
function pathOf(view: View, picture: Picture): string {
  if (isOfBaseline(picture)) return view[picture === "wasTest" ? "test" : "reference"];
  return picture === "truth" ? "truth" : view[picture];
}

/** The same within a sentence. */
function wordOf(view: View, picture: Picture): string {
  const path = pathWord(pathOf(view, picture));
  return isOfBaseline(picture) ? `${path} in the baseline` : path;
}

/** The baseline's pictures that are not as in this run. */
export function baselinePictures(view: View): ("wasReference" | "wasTest")[] {
  const images = view.whole.baseline?.images;
  return (["wasReference", "wasTest"] as const).filter((each) =>
    each === "wasTest" ? images?.test : images?.reference,
  );
}

interface Part {
  layer: Layer;
  message: string;
  isWaiting: boolean;
}

/** "+1.25 EV"; "" for none. */
export function exposureText(exposure: number): string {
  return exposure === 0 ? "" : `${exposure > 0 ? "+" : "\u2212"}${Math.abs(exposure)} EV`;
}

function imageOf({ view }: Scenery, picture: Picture): string {
  if (picture === "truth") return view.whole.truth?.images.truth ?? "";
  if (isOfBaseline(picture))
    return view.whole.baseline?.images?.[picture === "wasTest" ? "test" : "reference"] ?? "";
  return view.images[picture];
}

function planeOf({ view, state, source }: Scenery, picture: Picture): ReturnType<PixelSource["color"]> {
  if (isOfBaseline(picture)) return { message: "The report does not hold the pixel values of the baseline." };
  if (state.term === "") return source.color(pathOf(view, picture));
  if (picture === "truth") return { message: "The report does not hold the terms of the truth." };
  return source.term(`${pathOf(view, picture)}.${state.term}`);
}

/** The layer with its job once that is there; image and missing are what it falls back on. */
function makePart(scenery: Scenery, layer: Layer, needsValues: boolean, job: Job | null, message: string): Part {
  const hasImage = layer.image !== "" && !scenery.missing.has(layer.image);
  if (!hasImage) layer.image = "";
  if (!needsValues && hasImage) return { layer, message: "", isWaiting: false };
  if (message !== "") return { layer, message, isWaiting: false };
  return { layer: { ...layer, job }, message: "", isWaiting: job === null };
}

/** Says that an image file is missing, where no values can stand in for it. */
function missingText(scenery: Scenery, image: string, message: string): string {
  if (image === "") return `There is no picture. ${message}`;
  return scenery.missing.has(image) ? `${image} is missing. ${message}` : message;
}

function makePicture(scenery: Scenery, picture: Picture): Part {
  const { state, source, view } = scenery;
  const image = state.term === "" ? imageOf(scenery, picture) : "";
  const needsValues =
    ((state.exposure !== 0 || state.falseColor) && !isOfBaseline(picture)) || image === "" || scenery.missing.has(image);
  const layer: Layer = { key: picture, label: labelOf(scenery, picture), image, job: null };
  if (!needsValues) return makePart(scenery, layer, false, null, "");
  const plane = planeOf(scenery, picture);
  const exposureEv = view.exposureEv + state.exposure;
  const [values, display] = [valueOf(plane), valueOf(source.display)];
  let job: Job | null = values && display ? { kind: "display", plane: values, display, exposureEv } : null;
  if (state.falseColor) {
    layer.image = ""; // no other colours pass for these
    job = values && { kind: "luminance", plane: values, exposureEv };
  }
  const message = messageOf(plane) || messageOf(source.display);
  return makePart(
    scenery,
    layer,
    true,
    job,
    message && state.term === "" ? missingText(scenery, image, message) : message,
  );
}

function labelOf({ view, state }: Scenery, picture: Picture): string {
  const title = pathTitle(pathOf(view, picture)) + (isOfBaseline(picture) ? " in the baseline" : "");
  return state.term === "" ? title : `${title}, ${termLabel(state.term)}`;
}

/** The plane of the FLIP that judges what is looked at: each material's own, or that of the whole pictures. */
export function flipPlaneOf(material: number): "materialFlip" | "flip" {
  return material < 0 ? "flip" : "materialFlip";
}

/** The job of a FLIP map, in the range that is asked for. */
function flipJob({ state, materials, material }: Scenery, plane: Plane): Job {
  const most = state.autoRange ? autoMost(plane, materials, material) : 1;
  return { kind: "flip", plane, threshold: state.threshold, most };
}

/** The whole pictures' map: the image file, which has the full range, until values say a better one. */
function makeFlip(scenery: Scenery): Part {
  const { state, source, view, isAtRest } = scenery;
  const image = view.images.flip;
  const layer: Layer = { key: "flip", label: "FLIP map", image, job: null };
  const needsValues = state.threshold !== 0 || image === "" || scenery.missing.has(image);
  if (!needsValues && !(state.autoRange && isAtRest)) return makePart(scenery, layer, false, null, "");
  const plane = source.color("flip");
  const values = valueOf(plane);
  const job = values && flipJob(scenery, values);
  if (!needsValues) return { layer: { ...layer, job }, message: "", isWaiting: false };
  const message = messageOf(plane);
  return makePart(scenery, layer, true, job, message && missingText(scenery, image, message));
}

/** Where no values are, the whole pictures' map says less, and says so. */
function flipPane(scenery: Scenery): PaneModel {
  const { state, source, material } = scenery;
  const exposure = exposureText(state.exposure) && "at the report's exposure";
  const pane = (note: string, part: Part): PaneModel => {
    const { job } = part.layer;
    const [most, isAuto] = job?.kind === "flip" ? [job.most, state.autoRange] : [1, false];
    const legend: Legend = { kind: "flip", most, threshold: state.threshold, isAuto };
    return onePane("flip", "FLIP map", [note, exposure].filter(Boolean).join(", "), [part], { legend });
  };
  const whole = (note: string): PaneModel => pane(note, makeFlip(scenery));
  if (material < 0) return whole("");
  const plane: Loaded<Plane> = scenery.isAtRest ? source.color(flipPlaneOf(material)) : { waiting: true };
  if (messageOf(plane) !== "") return whole("of the whole pictures; the own map of each material needs pixel values");
  const values = valueOf(plane);
  const job = values && flipJob(scenery, values);
  const layer: Layer = { key: "flip", label: "FLIP map", image: "", job };
  return pane("by material", { layer, message: "", isWaiting: job === null });
}

/** What stands at the reference's place where two pictures share a pane. */
function baseOf({ view, state }: Scenery): Picture {
  if (state.showBaseline && baselinePictures(view).includes("wasTest")) return "wasTest";
  return state.showTruth && view.whole.truth !== undefined ? "truth" : "reference";
}

/** What a pane says of its picture. */
function noteOf({ view, state }: Scenery, picture: Picture): string {
  if (!isOfBaseline(picture)) return exposureText(state.exposure);
  const differs = view.whole.baseline?.notComparable ?? "";
  const notes = [exposureText(state.exposure) && "at the report's exposure", differs && `not comparable: ${differs}`];
  return notes.filter(Boolean).join(", ");
}

function onePane(key: string, label: string, note: string, parts: Part[], more: Partial<PaneModel> = {}): PaneModel {
  return {
    key,
    label,
    right: "",
    note,
    message: parts.find((part) => part.message !== "")?.message ?? "",
    isWaiting: parts.some((part) => part.isWaiting),
    layers: parts.map((part) => part.layer),
    filter: "",
    split: null,
    legend: null,
    ...more,
  };
}

/** Signed, from values; of the image files, by the browser's own filters, until the values are there. */
function differencePane(scenery: Scenery): PaneModel {
  const { state, source, view } = scenery;
  const base = baseOf(scenery);
  const [first, second] = [planeOf(scenery, base), planeOf(scenery, "test")];
  const [reference, test, display] = [valueOf(first), valueOf(second), valueOf(source.display)];
  const label = "Difference";
  const legendOf = (gain: number, isAuto: boolean): Legend => ({
    kind: "difference",
    steps: kFullSteps / gain,
    test: wordOf(view, "test"),
    base: wordOf(view, base),
    isAuto,
  });
  const note = [`${pathWord(view.test)} minus ${wordOf(view, base)}`, exposureText(state.exposure)];
  const exposureEv = view.exposureEv + state.exposure;
  let job: Job | null = null;
  if (reference && test && display) {
    const pair = { reference, test, display, exposureEv };
    const gain = state.autoRange ? autoGain(pair, scenery.materials, scenery.material) : state.gain;
    job = { kind: "difference", ...pair, gain };
  }
  const layer: Layer = { key: "difference", label, image: "", job };
  const message = messageOf(first) || messageOf(second) || messageOf(source.display);
  const images = [imageOf(scenery, base), imageOf(scenery, "test")];
  const hasImages = images.every((image) => image !== "" && !scenery.missing.has(image));
  if (job !== null || state.exposure !== 0 || state.term !== "" || !hasImages) {
    const part = { layer, message, isWaiting: job === null && message === "" };
    const legend = job?.kind === "difference" ? legendOf(job.gain, state.autoRange) : null;
    return onePane("difference", label, note.filter(Boolean).join(", "), [part], { legend });
  }
  // Half of the one over the inverted other is grey where they are alike; the contrast enlarges what is not.
  const layers: Layer[] = [
    { key: "base", label: labelOf(scenery, base), image: images[0]!, job: null, filter: "invert(1)" },
    { key: "test", label: pathTitle(view.test), image: images[1]!, job: null, opacity: 0.5 },
  ];
  return onePane("difference", label, note[0]!, [], {
    layers,
    filter: `contrast(${2 * state.gain})`,
    isWaiting: message === "",
    legend: legendOf(state.gain, false),
  });
}

/** The panes of the state's mode, in the order of the page. */
export function arrange(scenery: Scenery): PaneModel[] {
  const { state, view } = scenery;
  const exposure = exposureText(state.exposure);
  const legend: Legend | null = state.falseColor ? { kind: "luminance" } : null;
  const pane = (picture: Picture): PaneModel =>
    onePane(picture, labelOf(scenery, picture), noteOf(scenery, picture), [makePicture(scenery, picture)], {
      legend: isOfBaseline(picture) ? null : legend,
    });
  const base = baseOf(scenery);
  const pair = (
    key: string,
    label: string,
    change: (layer: Layer) => Partial<Layer>,
    more: Partial<PaneModel> = {},
  ) => {
    const test = makePicture(scenery, "test");
    test.layer = { ...test.layer, ...change(test.layer) };
    return [onePane(key, label, exposure, [makePicture(scenery, base), test], { legend, ...more })];
  };
  switch (state.mode) {
    case "side": {
      const truth = state.showTruth && view.whole.truth !== undefined ? [pane("truth")] : [];
      const before = state.showBaseline ? baselinePictures(view).map(pane) : [];
      return [pane("reference"), pane("test"), ...before, ...truth, state.term === "" ? flipPane(scenery) : differencePane(scenery)];
    }
    case "slider":
      return pair("slider", labelOf(scenery, base), () => ({ isRight: true }), {
        split: state.split,
        right: labelOf(scenery, "test"),
      });
    case "onion":
      return pair("onion", `${labelOf(scenery, "test")} over ${labelOf(scenery, base)}`, () => ({
        opacity: state.opacity,
      }));
    case "flicker":
      return pair("flicker", labelOf(scenery, scenery.showsTest ? "test" : base), () => ({
        opacity: scenery.showsTest ? 1 : 0,
      }));
    case "difference":
      return [differencePane(scenery)];
    case "flip":
      return [flipPane(scenery)];
  }
}
