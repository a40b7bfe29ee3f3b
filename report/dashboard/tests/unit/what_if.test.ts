import { describe, expect, it } from "vitest";

import type { WhatIf } from "../../src/data/types";
import { wordsWithoutVerdict } from "../../src/data/what_if";
import { rowsOf } from "../pack_overview";
import { makeFigures, makeMaterial, makeReport, makeScene, makeView } from "./sample";

const preset: WhatIf = { preset: "refit", words: "with refit: FLIP 0.05, pass", verdict: "pass", reason: "", figures: makeFigures(0.05) };

describe("another preset", () => {
  it("that would help is known to the row of the material, and views have none", () => {
    const rows = rowsOf(makeReport([makeScene("Desk", [makeView("front", [makeMaterial("Gold", "fail", 0.3, { whatIf: [preset] })])])]));
    expect(rows.map((row) => row.help)).toEqual([{ preset: "refit", verdict: "pass", flip: 0.05 }, null]);
  });

  it("is told in words that leave the verdict to its badge", () => {
    expect(wordsWithoutVerdict(preset)).toBe("with refit: FLIP 0.05");
  });
});
