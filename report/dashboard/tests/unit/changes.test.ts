import { describe, expect, it } from "vitest";

import { changesOf, changeText, countChanges, kBaselineChanges, kStandingChanges, standingWords } from "../../src/data/changes";
import { isComparable } from "../../src/data/facts";
import { filterOf, matcherOf } from "../../src/data/filter";
import { kDefaultState } from "../../src/data/state";
import type { Change, Material, Verdict } from "../../src/data/types";
import { saidChanges } from "../../src/overview/since";
import { overviewOf, rowsOf } from "../pack_overview";
import { makeMaterial, makeReport, makeScene, makeView } from "./sample";

function since(before: Verdict | null, change: number | null, notComparable = ""): Change {
  return { new: before === null, verdict: before, notComparable, changes: notComparable === "" && before !== null ? { "flip.mean": change } : {} };
}
const changes = (verdict: Verdict, before: Verdict | null, change: number | null, notComparable = ""): readonly string[] =>
  changesOf(verdict, before ?? "new", change, notComparable, "");

describe("changes since the baseline", () => {
  it("are worse and better by the verdicts", () => {
    expect(changes("fail", "warn", 0.1)).toEqual(["worse"]);
    expect(changes("error", "pass", null)).toEqual(["worse"]);
    expect(changes("warn", "fail", -0.1)).toEqual(["better"]);
    expect(changes("fail", "fail", 0.1)).toEqual(["worse"]);
    expect(changes("fail", "error", -0.1)).toEqual(["better"]);
  });

  it("are worse or better by mean FLIP, and none where the change reads 0.000", () => {
    expect(changes("pass", "pass", 0.0005)).toEqual(["worse"]);
    expect(changes("pass", "pass", -0.0005)).toEqual(["better"]);
    expect(changes("pass", "pass", 0.0004)).toEqual([]);
    expect(changes("pass", "pass", null)).toEqual([]);
  });

  it("are told of what the baseline lacks, which may be a new failure, and never of what does not compare", () => {
    expect(changes("pass", null, null)).toEqual(["added"]);
    expect(changes("fail", null, null)).toEqual(["added"]);
    expect(changes("fail", "pass", null, "size")).toEqual(["not comparable"]);
    expect(changesOf("fail", null, null, "", "")).toEqual([]);
  });

  it("have the standing before them, which needs no baseline", () => {
    expect(changesOf("fail", null, null, "", "new")).toEqual(["new"]);
    expect(changesOf("fail", "warn", 0.1, "", "new")).toEqual(["new", "worse"]);
    expect(changesOf("fail", "fail", 0.1, "", "still")).toEqual(["still", "worse"]);
    expect(changesOf("fail", "new", null, "", "flaky")).toEqual(["flaky", "added"]);
    expect(changesOf("pass", null, null, "", "accepted")).toEqual(["accepted"]);
    expect(changesOf("fail", null, null, "", "unknown")).toEqual([]);
  });
});

describe("the headline of the changes", () => {
  const material = (name: string, verdict: Verdict, before: Verdict | null, change: number): Material =>
    makeMaterial(name, verdict, 0.2, { baseline: since(before, change) });
  const report = makeReport([
    makeScene("Desk", [
      makeView("front", [
        material("Gold", "fail", "pass", 0.2),
        material("Iron", "fail", "pass", 0.1),
        material("Wood", "pass", "fail", -0.2),
        material("Wax", "warn", "warn", -0.01),
      ]),
    ]),
  ]);
  const rows = rowsOf(report);
  const counts = countChanges(rows);

  it("counts each kind", () => {
    expect(counts).toEqual({ new: 2, fixed: 1, still: 0, flaky: 0, accepted: 0, worse: 2, better: 2, added: 0, "not comparable": 0 });
    expect(saidChanges(counts)).toEqual(["new", "fixed", "worse", "better"]);
    expect(saidChanges({ ...counts, new: 0, fixed: 0, worse: 0, better: 0 })).toEqual(["new", "fixed"]);
    expect(saidChanges({ ...counts, still: 3 }, kStandingChanges)).toEqual(["new", "fixed", "still"]);
    expect(saidChanges(counts, kBaselineChanges)).toEqual(["worse", "better"]);
  });

  it("knows where nothing can be compared", () => {
    const of = (...baselines: (Change | null)[]) =>
      rowsOf(makeReport([makeScene("Desk", [makeView("front", baselines.map((baseline, i) => makeMaterial(String(i), "fail", 0.2, { baseline })))])])).filter((row) => row.kind === "material");
    expect(isComparable(of(since("pass", null, "size"), since("fail", null, "size"), since(null, null)))).toBe(false);
    expect(isComparable(of(since("pass", null, "size"), since("fail", 0.1)))).toBe(true);
    expect(isComparable(of(since(null, null)))).toBe(true);
  });

  it("reads as a sentence", () => {
    expect([changeText("new", 3), changeText("new", 1), changeText("new", 0)]).toEqual(["+3 new failures", "+1 new failure", "no new failure"]);
    expect([changeText("fixed", 12), changeText("added", 1), changeText("not comparable", 2)]).toEqual(["12 fixed", "1 not in the baseline", "2 not comparable"]);
    expect([changeText("still", 12), changeText("flaky", 1), changeText("accepted", 3)]).toEqual(["12 still failing", "1 flaky", "3 accepted"]);
    expect([standingWords("new", 1), standingWords("still", 12), standingWords("still", 0), standingWords("flaky", 3), standingWords("unknown", 0)]).toEqual(["new failure", "failing for 12 nights", "still failing", "flaky", ""]);
  });

  it("leads to the rows that it counts: any of the chosen changes", () => {
    const shown = (...chosen: string[]): string[] =>
      rows.filter(matcherOf(overviewOf(report), filterOf({ ...kDefaultState, changes: chosen }))).map((row) => row.name);
    expect(shown("new")).toEqual(["Gold", "Iron"]);
    expect(shown("new", "fixed")).toEqual(["Gold", "Iron", "Wood"]);
    expect(shown("better")).toEqual(["Wood", "Wax"]);
    expect(shown("added")).toEqual([]);
  });
});
