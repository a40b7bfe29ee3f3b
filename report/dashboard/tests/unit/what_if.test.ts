import { describe, expect, it } from "vitest";

import { makeRows } from "../../src/data/rows";
import type { Material, Verdict, WhatIf } from "../../src/data/types";
import { bestWhatIf, wordsWithoutVerdict } from "../../src/data/what_if";
import { makeFigures, makeMaterial, makeReport, makeScene, makeView } from "./sample";

const preset = (name: string, verdict: Verdict, flip: number): WhatIf => ({
  preset: name, words: `with ${name}: FLIP ${flip}, ${verdict}`, verdict, reason: "", figures: makeFigures(flip),
});
const gold = (verdict: Verdict, flip: number, ...whatIf: WhatIf[]): Material => makeMaterial("Gold", verdict, flip, { whatIf });

describe("the preset that would help most", () => {
  it("has the best verdict, then the least FLIP", () => {
    expect(bestWhatIf(gold("fail", 0.3, preset("a", "warn", 0.1), preset("b", "pass", 0.12), preset("c", "pass", 0.11)))?.preset).toBe("c");
    expect(bestWhatIf(gold("fail", 0.3, preset("a", "fail", 0.25), preset("b", "fail", 0.21)))?.preset).toBe("b");
  });

  it("is none where no preset improves the verdict, or FLIP by a tenth", () => {
    expect(bestWhatIf(gold("warn", 0.1, preset("a", "fail", 0.05)))).toBeNull();
    expect(bestWhatIf(gold("warn", 0.1, preset("a", "warn", 0.095)))).toBeNull();
    expect(bestWhatIf(gold("warn", 0.1, preset("a", "not judged", 0.01)))).toBeNull();
    expect(bestWhatIf(makeMaterial("Gold", "fail", 0.3))).toBeNull();
  });

  it("is known to the row of the material, and views have none", () => {
    const rows = makeRows(makeReport([makeScene("Desk", [makeView("front", [gold("fail", 0.3, preset("refit", "pass", 0.05))])])]));
    expect(rows.map((row) => row.help?.preset)).toEqual(["refit", undefined]);
  });

  it("is told in words that leave the verdict to its badge", () => {
    expect(wordsWithoutVerdict(preset("refit", "pass", 0.1))).toBe("with refit: FLIP 0.1");
  });
});
