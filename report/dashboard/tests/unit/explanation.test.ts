import { describe, expect, it } from "vitest";

import {
  advisedSet, barsOfRange, costChange, describeRanges, groupRanges, isOtherWay, limitAt, mainApproximation, maskedTextures, nameOfSet, percent, signedScale, topOfRanges,
} from "../../src/data/explanation";
import type { ErrorRange, MaterialCard } from "../../src/data/types";
import { makeExplanation } from "./sample";

const range = (quantity: ErrorRange["quantity"], from: number, pixels: number, flip: number): ErrorRange => ({ quantity, from, to: from + 0.1, pixels, flip });

describe("the approximation that adds most", () => {
  it("is the first, and none where nothing adds", () => {
    const explanation = makeExplanation();
    expect(mainApproximation(explanation)?.approximation).toBe("captures without parallax");
    const harmless = explanation.approximations.map((each) => ({ ...each, share: -0.1 }));
    expect(mainApproximation({ ...explanation, approximations: harmless })).toBeNull();
    expect(mainApproximation({ ...explanation, approximations: [] })).toBeNull();
  });

  it("does the opposite alone only where both have a sign to speak of", () => {
    const effect = (alone: number, share: number): boolean => isOtherWay({ approximation: "", change: "", alone, share });
    expect(effect(-0.014, 0.02)).toBe(true);
    expect(effect(0.014, -0.02)).toBe(true);
    expect(effect(0.014, 0.02)).toBe(false);
    expect(effect(-0.001, 0.02)).toBe(false);
    expect(effect(-0.014, 0.0005)).toBe(false);
    expect(effect(0, 0.02)).toBe(false);
  });
});

describe("a set of changes", () => {
  it("is named by them, and the advised one is never that of no change", () => {
    const { sets } = makeExplanation();
    expect(sets.map(nameOfSet)).toEqual(["nothing", "mobile-parallax=on", "formulas=refit + mobile-parallax=on"]);
    expect(advisedSet(makeExplanation())?.changes).toEqual(["mobile-parallax=on"]);
    expect(advisedSet(makeExplanation({ advised: 0 }))).toBeNull();
    expect(advisedSet(makeExplanation({ advised: 7 }))).toBeNull();
  });

  it("costs more or less than today", () => {
    expect(costChange(476, 421)).toBe("+13 %");
    expect(costChange(408, 421)).toBe("\u22123 %");
    expect(costChange(421, 421)).toBe("0 %");
    expect([costChange(421.5, 421), costChange(420.5, 421)]).toEqual(["0 %", "0 %"]);
    expect(costChange(1, 0)).toBe("–");
  });

  it("is judged by the limits of mean FLIP, not by those of its change", () => {
    const check = { metric: "flip.mean", regress: false, value: 0.4, warn: 0.1, fail: 0.2, verdict: "fail", note: "" } as const;
    const checks = [{ ...check, regress: true, warn: 0.01, fail: 0.02 }, check];
    expect([0.1, 0.15, 0.3].map((flip) => limitAt(flip, checks).verdict)).toEqual(["pass", "warn", "fail"]);
    expect(limitAt(0.3, [{ ...check, fail: null }])).toEqual({ metric: "flip.mean", warn: 0.1, fail: null, verdict: "warn" });
    expect(limitAt(0.3, [])).toEqual({ metric: "flip.mean", warn: null, fail: null, verdict: "not judged" });
  });
});

describe("bars on both sides of zero", () => {
  it("share one scale, and what is below lies to the left", () => {
    const scale = signedScale([0.3, -0.1, 0.05]);
    expect(scale.zero).toBeCloseTo(25);
    expect(scale.spanOf(0.3)).toEqual({ left: scale.zero, width: expect.closeTo(75) as number });
    expect(scale.spanOf(-0.1)).toEqual({ left: 0, width: expect.closeTo(25) as number });
  });

  it("begin at the left where nothing is below, and have no width without a value", () => {
    expect(signedScale([0.3, 0.1]).zero).toBe(0);
    expect(signedScale([-0.3]).zero).toBe(100);
    expect(signedScale([0, 0]).spanOf(0)).toEqual({ left: 0, width: 0 });
    expect(signedScale([]).zero).toBe(0);
  });
});

describe("the errors by quantity", () => {
  const ranges = [range("roughness", 0.1, 0.2, 0.62), range("roughness", 0.2, 0.8, 0.38), range("N.V", 0.9, 1, 1)];

  it("are grouped in the order of the report", () => {
    expect(groupRanges(ranges)).toEqual([{ quantity: "roughness", ranges: ranges.slice(0, 2) }, { quantity: "N.V", ranges: ranges.slice(2) }]);
    expect(groupRanges([])).toEqual([]);
  });

  it("have a scale that holds both shares", () => {
    const top = (...ranges: ErrorRange[]): number => topOfRanges({ quantity: "roughness", ranges });
    expect(top(ranges[0]!)).toBe(0.7);
    expect(top(ranges[0]!, ranges[1]!)).toBe(0.8);
    expect(top()).toBe(1);
  });

  it("have two bars for a tenth that do not overlap, and stay within it", () => {
    const { pixels, flip } = barsOfRange(range("roughness", 0.1, 0.2, 0.6));
    expect(pixels.left).toBeGreaterThan(10);
    expect(flip.left).toBeGreaterThan(pixels.left + pixels.width);
    expect(flip.left + flip.width).toBeLessThan(20);
  });

  it("say where most of it is", () => {
    expect(describeRanges({ quantity: "roughness", ranges: ranges.slice(0, 2) })).toBe("Most of it from 0.1 to 0.2: 62 % of the FLIP, on 20 % of the pixels.");
    expect(describeRanges({ quantity: "N.V", ranges: ranges.slice(2) })).toBe("All of its pixels lie from 0.9 to 1.");
    expect(describeRanges({ quantity: "roughness", ranges: [] })).toBe("");
    expect([0, 0.004, 0.01, 0.625, 1].map(percent)).toEqual(["0 %", "0.4 %", "1 %", "63 %", "100 %"]);
  });
});

describe("a mask", () => {
  it("belongs to an input whose texture has a picture", () => {
    const texture = { name: "", file: "", channels: "g", width: 4, height: 4, texCoord: 0, picture: "images/texture.png", least: [], most: [], mean: [] } as const;
    const card = { inputs: [{ name: "roughness", value: [1], texture }, { name: "metallic", value: [1], texture: { ...texture, picture: "" } }, { name: "specular", value: [1] }] } as unknown as MaterialCard;
    const of = (input: string): string[] => maskedTextures([{ input, picture: "images/mask.png", texels: 0.1 }], card).map(({ picture }) => picture);
    expect(of("roughness")).toEqual(["images/texture.png"]);
    expect([of("metallic"), of("specular"), of("sheen")]).toEqual([[], [], []]);
    expect(maskedTextures([{ input: "roughness", picture: "images/mask.png", texels: 0.1 }], null)).toEqual([]);
  });
});
