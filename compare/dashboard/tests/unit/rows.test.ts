import { describe, expect, it } from "vitest";

import { countRows, filterOf, matches, sortRows } from "../../src/data/filter";
import { causeOf, checkOf, figureOf, makeRows } from "../../src/data/rows";
import { kDefaultState } from "../../src/data/state";
import type { Check, Figures } from "../../src/data/types";
import { makeMaterial, makeReport, makeScene, makeView } from "./sample";

const attribution = { region: "interior" as const, flip: 0.4, terms: [{ term: "skySpecular", flip: 0.1 }, { term: "sunDiffuse", flip: 0.39 }] };
const report = makeReport([
  makeScene("Desk", [
    makeView("front", [
      makeMaterial("Gold", "fail", 0.4, { attribution, reason: "mean FLIP is above" }),
      makeMaterial("Wood", "pass", 0.02),
      makeMaterial("Inside", "not seen", null),
      makeMaterial("Elsewhere", "not seen", null, { seenElsewhere: true }),
    ]),
  ]),
  makeScene("Broken", [], "is not a glTF"),
]);
const rows = makeRows(report);
const shown = (patch: object): string[] => rows.filter((row) => matches(row, filterOf({ ...kDefaultState, ...patch }))).map((row) => row.name);

describe("rows", () => {
  it("has one for each material that counts, each whole image and each scene that failed", () => {
    expect(rows.map((row) => [row.kind, row.name])).toEqual([
      ["material", "Gold"], ["material", "Wood"], ["material", "Inside"], ["whole", "front"], ["scene", "Broken"],
    ]);
  });

  it("takes the interior's figures, and counts all pixels", () => {
    expect(rows[0]).toMatchObject({ region: "interior", pixels: 120 });
    expect(rows[2]).toMatchObject({ region: "", pixels: 0 });
  });
});

describe("a row's figures", () => {
  const figures = (flip: number): Figures => ({ pixels: 9, nonFinite: 0, metrics: { "flip.mean": flip }, referenceLuma: 0, testLuma: 0 });
  const check = (region: string, value: number): Check => ({ metric: "flip.mean", region, regress: false, value, warn: 0.1, fail: 0.2, verdict: "pass", note: "" });
  const judged = { figures: { interior: figures(0.15), all: figures(0.05) }, checks: [check("all", 0.05), check("interior", 0.15)] };
  const view = makeView("front", [makeMaterial("Gold", "pass", 0, judged)]);
  Object.assign(view.whole, judged);
  const [material, whole] = makeRows(makeReport([makeScene("Desk", [view])]));
  if (!material || !whole) throw new Error("two rows");

  it("are of a material's interior, and of all pixels of a whole image: what the limits are for", () => {
    expect([figureOf(material, "flip.mean"), material.region]).toEqual([0.15, "interior"]);
    expect([figureOf(whole, "flip.mean"), whole.region]).toEqual([0.05, "all"]);
  });

  it("are held against the check of their own region", () => {
    expect(checkOf(material, "flip.mean")?.value).toBe(0.15);
    expect(checkOf(whole, "flip.mean")?.value).toBe(0.05);
    expect(checkOf(whole, "flip.p95")).toBeNull();
  });
});

describe("the cause", () => {
  it("is the term whose swap lowers FLIP most", () => {
    expect(rows[0]?.cause).toEqual({ term: "skySpecular", before: 0.4, after: 0.1 });
  });

  it("is none where no swap lowers FLIP by a tenth, or nothing is known", () => {
    expect(causeOf({ ...attribution, terms: [{ term: "fog", flip: 0.361 }] })).toBeNull();
    expect(causeOf({ ...attribution, terms: [{ term: "fog", flip: 0.36 }] })?.term).toBe("fog");
    expect(causeOf({ ...attribution, flip: null })).toBeNull();
    expect(causeOf(undefined)).toBeNull();
    expect(causeOf({ region: "interior", flip: 0, terms: [{ term: "emissive", flip: 0 }] })).toBeNull();
  });
});

describe("the filter", () => {
  it("shows materials or views, and scenes that failed in both", () => {
    expect(shown({})).toEqual(["Gold", "Wood", "Inside", "Broken"]);
    expect(shown({ list: "views" })).toEqual(["front", "Broken"]);
  });

  it("needs every word, in the name, the place, the reason or the cause", () => {
    expect(shown({ query: "desk GOLD" })).toEqual(["Gold"]);
    expect(shown({ query: "above" })).toEqual(["Gold"]);
    expect(shown({ query: "skyspec" })).toEqual(["Gold"]);
    expect(shown({ query: "gold wood" })).toEqual([]);
  });

  it("narrows by verdict, cause and preset", () => {
    expect(shown({ verdicts: ["fail", "not seen"] })).toEqual(["Gold", "Inside"]);
    expect(shown({ causedBy: "skySpecular" })).toEqual(["Gold"]);
    expect(shown({ causedBy: "fog" })).toEqual([]);
    expect(shown({ preset: "default" })).toEqual(["Gold", "Wood", "Inside"]);
  });

  it("counts by verdict", () => {
    expect(countRows(rows)).toEqual({ fail: 1, pass: 2, "not seen": 1, error: 1 });
  });
});

describe("the order", () => {
  const names = (key: string, ascending = false): string[] => sortRows(rows, key, ascending).map((row) => row.name);

  it("has the gravest first, and the worse FLIP first among equals", () => {
    expect(names("gravity")).toEqual(["Broken", "Gold", "Inside", "Wood", "front"]);
  });

  it("has what is not known last, whichever way", () => {
    expect(names("flip.mean").slice(0, 3)).toEqual(["Gold", "Wood", "front"]);
    expect(names("flip.mean", true).slice(0, 3)).toEqual(["front", "Wood", "Gold"]);
  });

  it("sorts names by letter and keeps the list it was given", () => {
    expect(names("name", true)).toEqual(["Broken", "front", "Gold", "Inside", "Wood"]);
    expect(rows[0]?.name).toBe("Gold");
  });
});
