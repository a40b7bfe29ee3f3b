import { describe, expect, it } from "vitest";

import type { Stage } from "../../src/data/types";
import { stageLine, wordsOf } from "../../src/item/stages";
import { makeFigures, makeReport } from "./sample";

describe("a stage of the mobile path", () => {
  it("is a line in words, also one that the page has no words for", () => {
    expect(wordsOf("encoding")).toBe("The render target");
    expect(wordsOf("textures")).toBe("Texture compression with");
    const third: Stage = { stage: "upscaling", through: "a bicubic of half size", figures: makeFigures(0.25) };
    expect(stageLine(third, "mobile", makeReport([])).values.slice(0, 3)).toEqual(["The stage upscaling with", "a bicubic of half size", "0.2500"]);
  });
});
