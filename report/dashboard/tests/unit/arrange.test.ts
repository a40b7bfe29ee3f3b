import { describe, expect, it } from "vitest";

import type { Plane } from "../../src/data/chunk";
import { kDefaultState, kModes, type ViewerState } from "../../src/data/state";
import type { View } from "../../src/data/types";
import { kFullSteps } from "../../src/data/range";
import { arrange, type Legend, type PaneModel } from "../../src/viewer/arrange";
import type { Loaded, PixelSource } from "../../src/viewer/source";
import { makeView } from "./sample";

const kWidth = 64;

function makeSource(planes: readonly string[] | string): { source: PixelSource; asked: string[] } {
  const asked: string[] = [];
  const plane = (name: string): Loaded<Plane> => {
    asked.push(name);
    if (typeof planes === "string") return { message: planes };
    if (!planes.includes(name)) return { waiting: true };
    const values = new Uint16Array(3 * kWidth * kWidth);
    return { value: { name, kind: "rgb16f", width: kWidth, height: kWidth, values } };
  };
  const source = { color: plane, term: plane, display: { value: { kind: "sRGB" } } };
  return { source: source as unknown as PixelSource, asked };
}

function makePictured(): View {
  const view = makeView("v", []);
  view.images = { reference: "images/a.png", test: "images/b.png", flip: "images/f.png" };
  return view;
}

function panes(
  state: Partial<ViewerState>,
  planes: readonly string[] | string,
  missing: string[] = [],
  view = makePictured(),
  of: { material: number; isAtRest: boolean } = { material: -1, isAtRest: true },
) {
  const { source, asked } = makeSource(planes);
  const all = {
    view,
    ...of,
    state: { ...kDefaultState, ...state },
    source,
    materials: null,
    missing: new Set(missing),
    showsTest: false,
  };
  return { models: arrange(all), asked };
}

const labels = (models: PaneModel[]): string[] => models.map((model) => model.label);
const jobs = (models: PaneModel[]): (string | undefined)[] =>
  models.flatMap((model) => model.layers.map((layer) => layer.job?.kind));

describe("panes of the comparison", () => {
  it("shows image files, and asks for no values, as the report judged them", () => {
    for (const mode of kModes.filter((each) => each !== "difference")) {
      const { models, asked } = panes({ mode, autoRange: false }, "none");
      expect(asked).toEqual([]);
      expect(models.every((model) => model.message === "" && model.layers.every((layer) => layer.image !== ""))).toBe(
        true,
      );
    }
    expect(labels(panes({}, "none").models)).toEqual(["High-end", "Mobile", "FLIP map"]);
  });

  it("paints what another exposure or a threshold needs, and keeps the image until it can", () => {
    const ready = panes({ exposure: 1, threshold: 0.1 }, ["highend", "mobile", "flip"]);
    expect(jobs(ready.models)).toEqual(["display", "display", "flip"]);
    const waiting = panes({ exposure: 1, threshold: 0.1 }, []);
    expect(jobs(waiting.models)).toEqual([undefined, undefined, undefined]);
    expect(waiting.models.every((model) => model.isWaiting && model.message === "")).toBe(true);
  });

  it("does not pass off the pictures at the report's exposure for others", () => {
    const { models } = panes({ exposure: 1 }, "no values");
    expect(models.map((model) => model.message)).toEqual(["no values", "no values", ""]);
  });

  it("paints from values what image file is missing, and says so where there are none", () => {
    expect(jobs(panes({}, ["mobile"], ["images/b.png"]).models)).toEqual([undefined, "display", undefined]);
    const { models } = panes({}, "no values", ["images/b.png", "images/f.png"]);
    expect(models.map((model) => model.message)).toEqual([
      "",
      "images/b.png is missing. no values",
      "images/f.png is missing. no values",
    ]);
  });

  it("shows a difference of the image files while there are no values", () => {
    const filtered = panes({ mode: "difference", gain: 8 }, "no values").models[0]!;
    expect([filtered.message, filtered.filter]).toEqual(["", "contrast(16)"]);
    expect(jobs(panes({ mode: "difference" }, ["highend", "mobile"]).models)).toEqual(["difference"]);
    expect(panes({ mode: "difference", exposure: 1 }, "no values").models[0]!.message).toBe("no values");
  });

  it("shows a term of both paths and their difference", () => {
    const { models, asked } = panes({ term: "fog" }, ["highend.fog", "mobile.fog"]);
    expect(jobs(models)).toEqual(["display", "display", "difference"]);
    expect(new Set(asked)).toEqual(new Set(["highend.fog", "mobile.fog"]));
    expect(panes({ term: "fog" }, "black").models.map((model) => model.message)).toEqual(["black", "black", "black"]);
  });

  it("has the truth only where there is one", () => {
    expect(labels(panes({ showTruth: true }, "none").models)).toEqual(["High-end", "Mobile", "FLIP map"]);
    const view = makePictured();
    view.whole.truth = {
      figures: null,
      terms: [],
      notes: [],
      images: { truth: "images/t.png", referenceFlip: "", testFlip: "" },
    };
    expect(labels(panes({ showTruth: true }, "none", [], view).models)).toEqual([
      "High-end",
      "Mobile",
      "Truth",
      "FLIP map",
    ]);
    const slider = panes({ showTruth: true, mode: "slider" }, "none", [], view).models[0]!;
    expect([slider.label, slider.right]).toEqual(["Truth", "Mobile"]);
  });

  it("has the baseline's pictures only where they are not as in this run", () => {
    expect(labels(panes({ showBaseline: true }, "none").models)).toEqual(["High-end", "Mobile", "FLIP map"]);
    const view = makePictured();
    const images = { reference: "", test: "baseline/a.png" };
    view.whole.baseline = { new: false, verdict: "pass", notComparable: "", changes: {}, images };
    expect(labels(panes({}, "none", [], view).models)).toEqual(["High-end", "Mobile", "FLIP map"]);
    const side = panes({ showBaseline: true }, "none", [], view).models;
    expect(labels(side)).toEqual(["High-end", "Mobile", "Mobile in the baseline", "FLIP map"]);
    expect(side[2]!.layers[0]!.image).toBe("baseline/a.png");
    const slider = panes({ showBaseline: true, mode: "slider" }, "none", [], view).models[0]!;
    expect([slider.label, slider.right]).toEqual(["Mobile in the baseline", "Mobile"]);
    const difference = panes({ showBaseline: true, mode: "difference" }, "none", [], view).models[0]!;
    expect([difference.message, difference.note]).toEqual(["", "mobile minus mobile in the baseline"]);
    images.reference = "baseline/b.png";
    view.whole.baseline.notComparable = "device was a, is b";
    const both = panes({ showBaseline: true, exposure: 1 }, ["highend", "mobile", "flip"], [], view).models;
    expect(labels(both)).toEqual([
      "High-end",
      "Mobile",
      "High-end in the baseline",
      "Mobile in the baseline",
      "FLIP map",
    ]);
    expect(both[3]!.note).toBe("at the report's exposure, not comparable: device was a, is b");
    const term = panes({ showBaseline: true, term: "fog" }, "none", [], view).models[3]!;
    expect(term.message).toBe("The report does not hold the pixel values of the baseline.");
  });
});

describe("the legend", () => {
  const legends = (state: Partial<ViewerState>, planes: readonly string[] | string): (Legend | null)[] =>
    panes(state, planes).models.map((model) => model.legend);
  const flip = (most: number, isAuto: boolean): Legend => ({ kind: "flip", most, threshold: 0, isAuto });

  it("says the range of the map that is shown: the full one of an image file, the automatic one of values", () => {
    expect(legends({ mode: "flip" }, "no values")).toEqual([flip(1, false)]);
    expect(legends({ mode: "flip" }, [])).toEqual([flip(1, false)]);
    expect(legends({ mode: "flip" }, ["flip"])).toEqual([flip(0.02, true)]); // no pixel differs
    expect(legends({ mode: "flip", autoRange: false, threshold: 0.1 }, ["flip"])).toEqual([{ ...flip(1, false), threshold: 0.1 }]);
  });

  it("keeps the image file of the whole map until values say a better range, and does not call that waiting", () => {
    const model = panes({ mode: "flip" }, []).models[0]!;
    expect([model.isWaiting, model.layers[0]!.image]).toEqual([false, "images/f.png"]);
    const passing = panes({ mode: "flip" }, ["flip"], [], makePictured(), { material: -1, isAtRest: false });
    expect([passing.asked, jobs(passing.models)]).toEqual([[], [undefined]]);
  });

  it("of a difference says how many steps of 255 it spans, and of which paths", () => {
    const of = (gain: number, isAuto: boolean) => [
      { kind: "difference", steps: kFullSteps / gain, test: "mobile", base: "high-end", isAuto },
    ];
    expect(legends({ mode: "difference", gain: 8 }, "no values")).toEqual(of(8, false));
    expect(legends({ mode: "difference", autoRange: false, gain: 8 }, ["highend", "mobile"])).toEqual(of(8, false));
    expect(legends({ mode: "difference" }, ["highend", "mobile"])).toEqual(of(kFullSteps / 2, true)); // equal pictures
    expect(legends({ mode: "difference", exposure: 1 }, "no values")).toEqual([null]);
  });

  it("of false colours stands for pictures alone", () => {
    expect(legends({ falseColor: true, autoRange: false }, "none").map((each) => each?.kind)).toEqual(["luminance", "luminance", "flip"]);
    expect(legends({ falseColor: true, mode: "slider" }, "none")).toEqual([{ kind: "luminance" }]);
    expect(legends({}, "none").map((each) => each?.kind)).toEqual([undefined, undefined, "flip"]);
  });
});

describe("false colours", () => {
  it("are painted from values, and no picture stands in for them", () => {
    const ready = panes({ falseColor: true, mode: "slider" }, ["highend", "mobile"]);
    expect(jobs(ready.models)).toEqual(["luminance", "luminance"]);
    const waiting = panes({ falseColor: true, mode: "slider" }, []).models[0]!;
    expect([waiting.isWaiting, waiting.layers.map((layer) => layer.image)]).toEqual([true, ["", ""]]);
    expect(panes({ falseColor: true, mode: "slider" }, "no values").models[0]!.message).toContain("no values");
  });
});

describe("the FLIP map of a material", () => {
  const ofMaterial = (state: Partial<ViewerState>, planes: readonly string[] | string, missing: string[] = []) =>
    panes({ mode: "flip", ...state }, planes, missing, makePictured(), { material: 0, isAtRest: true });

  it("is painted from each material's own FLIP, never from the whole pictures'", () => {
    const { models, asked } = ofMaterial({}, ["flip", "materialFlip"]);
    expect(asked).toEqual(["materialFlip"]);
    const layer = models[0]!.layers[0]!;
    expect([layer.image, layer.job?.kind, models[0]!.note]).toEqual(["", "flip", "by material"]);
    expect(layer.job?.kind === "flip" && layer.job.plane.name).toBe("materialFlip");
    expect(panes({ mode: "flip", threshold: 0.1 }, ["flip", "materialFlip"]).asked).toEqual(["flip"]);
  });

  it("shows nothing of another map while its values are on their way, and asks for none before the view rests", () => {
    const waiting = ofMaterial({}, []).models[0]!;
    expect([waiting.isWaiting, waiting.layers[0]!.image, waiting.layers[0]!.job]).toEqual([true, "", null]);
    const of = { material: 0, isAtRest: false };
    const passing = panes({ mode: "flip" }, ["materialFlip"], [], makePictured(), of);
    expect([passing.asked, passing.models[0]!.isWaiting]).toEqual([[], true]);
  });

  it("falls back on the whole pictures' map where there are no values, and says so", () => {
    const { models } = ofMaterial({}, "no values");
    expect([models[0]!.layers[0]!.image, models[0]!.message]).toEqual(["images/f.png", ""]);
    expect(models[0]!.note).toContain("of the whole pictures");
    expect(ofMaterial({ threshold: 0.1 }, "no values").models[0]!.message).toBe("no values");
    expect(ofMaterial({}, "no values", ["images/f.png"]).models[0]!.message).toBe("images/f.png is missing. no values");
  });

  it("says that it is not at the exposure of the pictures beside it", () => {
    expect(ofMaterial({ exposure: 1 }, ["materialFlip"]).models[0]!.note).toBe(
      "by material, at the report's exposure",
    );
  });
});
