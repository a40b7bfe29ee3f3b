import { describe, expect, it } from "vitest";

import { bandColors, evOf, falseColor, kLeastEv, kMiddleGrey, kMostEv, luminanceOf } from "../../src/data/false_color";
import { legendsOf, rangeText } from "../../src/viewer/legend";

describe("false colours", () => {
  it("count EV from middle grey: twice the light is one more", () => {
    expect(evOf(kMiddleGrey)).toBe(0);
    expect(evOf(2 * kMiddleGrey)).toBeCloseTo(1, 12);
    expect(evOf(1)).toBeCloseTo(2.474, 3); // log2(1 / 0.18)
    expect(luminanceOf(1, 1, 1)).toBeCloseTo(1, 12);
  });

  it("have one colour for half an EV, each another than its neighbours", () => {
    const colors = bandColors();
    expect(colors).toHaveLength(2 * (kMostEv - kLeastEv));
    expect(new Set(colors).size).toBe(colors.length);
    expect(colors.every((color) => /^#[0-9a-f]{6}$/.test(color))).toBe(true);
    expect(falseColor(kMiddleGrey * 1.01)).toBe(falseColor(kMiddleGrey * 1.4));
    expect(falseColor(kMiddleGrey * 1.01)).not.toBe(falseColor(kMiddleGrey * 0.99));
  });

  it("are black below the range and for NaN, white above it", () => {
    expect([0, -1, NaN, kMiddleGrey * 2 ** (kLeastEv - 0.01)].map(falseColor)).toEqual(Array(4).fill(0xff000000));
    expect([Infinity, kMiddleGrey * 2 ** kMostEv].map(falseColor)).toEqual([0xffffffff, 0xffffffff]);
  });
});

describe("legends", () => {
  it("stand once for each kind of colours", () => {
    const luminance = { kind: "luminance" } as const;
    const flip = { kind: "flip", most: 1, threshold: 0, isAuto: false } as const;
    expect(legendsOf([{ legend: luminance }, { legend: luminance }, { legend: flip }, { legend: null }])).toEqual([luminance, flip]);
  });

  it("say the range and who chose it", () => {
    expect(rangeText("0", "0.3", true)).toBe("range 0 to 0.3, automatic");
    expect(rangeText("0", "1", false)).toBe("range 0 to 1, fixed");
  });
});
