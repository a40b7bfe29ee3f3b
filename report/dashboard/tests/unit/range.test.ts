import { describe, expect, it } from "vitest";

import { differenceRange, flipRange, kFullSteps } from "../../src/data/range";
import { barScale, barShares, roundUp } from "../../src/data/scale";
import { makeMaterial, makeReport, makeScene, makeView } from "./sample";
import { rowsOf } from "../pack_overview";

const flip = (...values: number[]): Uint16Array => Uint16Array.from(values.map((value) => Math.round(value * 65535)));
const repeat = (value: number, count: number): number[] => Array.from({ length: count }, () => value);

describe("a round number above", () => {
  it("is the least that is not below the value", () => {
    expect([0.27, 0.3, 0.31, 0.85, 1, 1.01, 0.0123, 37].map(roundUp)).toEqual([0.3, 0.3, 0.4, 1, 1, 1.2, 0.015, 40]);
    expect([0, -1, NaN, Infinity].map(roundUp)).toEqual([0, 0, 0, 0]);
  });
});

describe("the automatic range of a FLIP map", () => {
  it("holds nearly all of the pixels, and no outlier decides it", () => {
    expect(flipRange(flip(...repeat(0.19, 999), 0.9), null, -1)).toBe(0.2);
    expect(flipRange(flip(...repeat(0.19, 90), ...repeat(0.9, 10)), null, -1)).toBe(1);
  });

  it("is that of the pixels that are looked at", () => {
    const materials = Uint16Array.from([...repeat(1, 50), ...repeat(2, 50), ...repeat(0, 50)]);
    const values = flip(...repeat(0.049, 50), ...repeat(0.38, 50), ...repeat(1, 50));
    expect([flipRange(values, materials, 0), flipRange(values, materials, 1), flipRange(values, materials, -1)]).toEqual([0.05, 0.4, 0.4]);
  });

  it("is neither above 1 nor so small that it shows rounding", () => {
    expect(flipRange(flip(...repeat(1, 10)), null, -1)).toBe(1);
    expect(flipRange(flip(...repeat(0.001, 10)), null, -1)).toBe(0.02);
    expect(flipRange(flip(0.5), Uint16Array.from([0]), -1)).toBe(0.02);
  });
});

describe("the automatic range of a difference", () => {
  const pixels = (...values: number[]): Uint32Array => Uint32Array.from(values, (v) => (0xff000000 | v) >>> 0);

  it("is that of the channel that differs most, up or down", () => {
    expect(differenceRange(pixels(0x808080), pixels(0x808a80), null, -1)).toBe(10);
    expect(differenceRange(pixels(0x908080), pixels(0x808080), null, -1)).toBe(20);
    expect(differenceRange(pixels(0), pixels(0xff), null, -1)).toBe(kFullSteps);
    expect(differenceRange(pixels(7), pixels(7), null, -1)).toBe(2);
  });
});

describe("the scale of bars", () => {
  const check = (fail: number) => [{ metric: "flip.mean", regress: false, value: 0, warn: 0.1, fail, verdict: "fail" as const, note: "" }];
  const scaleOf = (...flips: number[]): number =>
    barScale(rowsOf(makeReport([makeScene("S", [makeView("v", flips.map((value, i) => makeMaterial(`m${i}`, "fail", value, { checks: check(0.2) })))])])), "flip.mean");

  it("is one for all rows, so that .27 and .85 look apart", () => {
    const most = scaleOf(0.27, 0.85, 0.02);
    expect(most).toBe(1);
    expect(barShares(0.27, { warn: 0.1, fail: 0.2 }, most)).toEqual({ value: 27, warn: 10, fail: 20 });
    expect(barShares(0.85, { warn: 0.1, fail: 0.2 }, most).value).toBe(85);
  });

  it("holds the limits where all values are below them, and is never 0", () => {
    expect(scaleOf(0.02)).toBe(0.2);
    expect(barScale([], "flip.mean")).toBe(1);
  });

  it("leaves out a limit that is beyond it", () => {
    expect(barShares(2, { warn: null, fail: 3 }, 1)).toEqual({ value: 100, warn: null, fail: null });
  });
});
