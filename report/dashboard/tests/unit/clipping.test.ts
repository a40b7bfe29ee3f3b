import { describe, expect, it } from "vitest";

import { clippingText } from "../../src/data/clipping";
import { makeFigures } from "./sample";

const textOf = (clippedBlack: number | null, clippedWhite: number | null): string =>
  clippingText(makeFigures(0, { clippedBlack, clippedWhite }));

describe("what is clipped in both pictures", () => {
  it("is a warning from a twentieth of the pixels on, black and white together", () => {
    expect(textOf(0.0499, 0)).toBe("");
    expect(textOf(0.05, 0)).toBe("5.0 % black");
    expect(textOf(0.03, 0.02)).toBe("3.0 % black, 2.0 % white");
    expect(textOf(0.02, 0.0299)).toBe("");
  });

  it("names the larger share first, and no share that is none", () => {
    expect(textOf(0.125, 0.625)).toBe("62.5 % white, 12.5 % black");
    expect(textOf(0, 1)).toBe("100.0 % white");
  });

  it("is nothing where it is not known", () => {
    expect(textOf(null, null)).toBe("");
    expect(clippingText(null)).toBe("");
  });
});
