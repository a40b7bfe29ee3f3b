import { describe, expect, it } from "vitest";

import { factsOf } from "../../src/data/facts";
import { worstOf } from "../../src/data/groups";
import { rowsOf } from "../pack_overview";
import { makeMaterial, makeReport, makeScene, makeView } from "./sample";

const by = (term: string): object => ({ attribution: { flip: 0.4, terms: [{ term, flip: 0.1 }] } });
const rows = rowsOf(
  makeReport([
    makeScene("Desk", [makeView("front", [makeMaterial("Gold", "fail", 0.4, by("skySpecular")), makeMaterial("Wood", "warn", 0.2, by("fog")), makeMaterial("Clay", "pass", 0.01), makeMaterial("Iron", "fail", 0.5)])]),
    makeScene("Broken", [], "is not a glTF"),
  ]),
);

describe("the facts of a list", () => {
  const { materials, views } = factsOf(rows).lists;

  it("count its rows; a scene that failed is in both", () => {
    expect([materials.rows, materials.over, views.rows, views.over]).toEqual([5, 3, 2, 1]);
    expect(materials.verdicts).toEqual({ fail: 2, warn: 1, pass: 1, error: 1 });
  });

  it("name causes and presets by letter", () => {
    expect([...materials.causes]).toEqual([["fog", 1], ["skySpecular", 1]]);
    expect(materials.presets).toEqual(["default"]);
  });
});

describe("the worst rows", () => {
  it("are the gravest, then those with the largest FLIP, then the first", () => {
    const names = (count: number): string[] => worstOf(rows, count).map((row) => row.name);
    expect(names(9)).toEqual(["Broken", "Iron", "Gold", "Wood", "Clay", "Desk · front"]);
    expect(names(3)).toEqual(["Broken", "Iron", "Gold"]);
    expect(names(1)).toEqual(["Broken"]);
  });
});
