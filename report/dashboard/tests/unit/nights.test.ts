import { describe, expect, it } from "vitest";

import type { Trend, TrendChange } from "../../src/data/history";
import { costLines, countLines, flipLines, lanesOf, trendPath } from "../../src/data/night_lines";
import { machinesOf, shareOf, stepsOf } from "../../src/data/night_machines";
import { changesOf, directionOf, eventsOf, figuresOf, inOrder, nightsOf, rowsWith, spanOf, summaryOf, titleOf } from "../../src/data/nights";
import { readStudy } from "../../src/data/study";
import { linkOf, shownBy } from "../../src/study/night_link";
import { makeNight, makeNights } from "../make_nights";

const nights = makeNights(40, 100, 0.02);

/** A page that has this text in its block "nights". */
function pageWith(text: string): Document {
  return { getElementById: (id: string) => (id === "nights" ? { textContent: text } : null) } as unknown as Document;
}

describe("the block of nights", () => {
  it("is read as it was written, also without any night", () => {
    for (const each of [nights, makeNights(0, 10), makeNights(1, 10)]) expect(readStudy(pageWith(JSON.stringify(each)))).toEqual({ kind: "nights", nights: each });
  });

  it("of another format is refused in words that name both", () => {
    expect(nightsOf({ ...nights, format: 2 })).toEqual({ problem: expect.stringContaining("format 2; this page reads format 1.") as string });
    expect(nightsOf({ ...nights, format: undefined })).toEqual({ problem: expect.stringContaining("format unknown") as string });
  });

  it("that is something else, or damaged, is a problem in words", () => {
    for (const value of [null, 3, "x", []]) expect(nightsOf(value)).toHaveProperty("problem", "This page holds no nights.");
    for (const broken of [{ runs: {} }, { rows: [] }, { timings: null }, { statistics: 1 }]) expect(nightsOf({ ...nights, ...broken })).toHaveProperty("problem", "Its data is not complete.");
    for (const night of [null, {}, { ...makeNight(0), changes: null }, { ...makeNight(0), started: 3 }]) expect(nightsOf({ ...nights, runs: [night] })).toHaveProperty("problem", "A night of it is not complete.");
    expect(nightsOf({ ...nights, rows: { a: { figures: {} } } })).toHaveProperty("problem", "A row of it is not complete.");
    expect(readStudy(pageWith("{,"))).toHaveProperty("problem", expect.stringContaining("damaged"));
  });
});

describe("a night in words", () => {
  it("has its events by gravity, kinds that are not known last, and none that did not happen", () => {
    expect(eventsOf({ events: { odd: 1, gone: 2, fixed: 0, crashed: 3, nondeterministic: 4 } })).toEqual([{ kind: "nondeterministic", count: 4 }, { kind: "crashed", count: 3 }, { kind: "gone", count: 2 }, { kind: "odd", count: 1 }]);
  });

  it("says what limits it", () => {
    expect(summaryOf(makeNight(3))).toBe("nothing changed");
    expect(summaryOf(makeNight(0))).toBe("first run");
    expect(summaryOf(makeNight(3, { isWhole: false }))).toBe("a part of the scenes");
    expect(summaryOf(makeNight(3, { isComplete: false, events: { changed: 2, regressed: 1 } }))).toBe("1 regressed, 2 changed (incomplete)");
  });

  it("is the title of the page if it is the last one", () => {
    const of = (...runs: ReturnType<typeof makeNight>[]): string => titleOf({ ...nights, runs });
    expect(of()).toBe("nightly, main: no nights");
    expect(of(makeNight(0, { failed: 2 }))).toBe("nightly, main: 1 night; last: first run, 2 failing");
    expect(of(makeNight(0), makeNight(1, { failed: 12, events: { regressed: 3, crashed: 1 } }))).toBe("nightly, main: 2 nights; last: 1 crashed, 3 new failures, 12 failing");
    expect(of(makeNight(0), makeNight(1))).toBe("nightly, main: 2 nights; last: no new failure, 0 failing");
    expect(titleOf({ ...nights, suite: "", branch: "", runs: [] })).toBe("History: no nights");
    expect([spanOf([]), spanOf([makeNight(0)]), spanOf([makeNight(0), makeNight(1)])]).toEqual(["", "2025-10-20", "2025-10-20 to 2025-10-21"]);
  });
});

describe("changes", () => {
  const change = (fields: Partial<TrendChange>): TrendChange => ({ run: 1, kind: "changed", cause: "", metric: "flip.mean", before: 0.1, after: 0.2, figures: 1, ...fields });

  it("are those of the chosen kinds, and how many are not listed", () => {
    const listed = [{ ...change({ kind: "regressed" }), row: "a" }, { ...change({}), row: "b" }];
    const night = makeNight(1, { events: { regressed: 1, changed: 40 }, changes: listed });
    expect(changesOf(night, new Set())).toEqual({ listed, more: 39 });
    expect(changesOf(night, new Set(["regressed"]))).toEqual({ listed: listed.slice(0, 1), more: 0 });
    expect(changesOf(makeNight(1, { changes: listed }), new Set()).more).toBe(0); // fewer counted than listed
  });

  it("are better or worse as the figure says", () => {
    const direction = (metric: string, before: number | null, after: number | null): string => directionOf(change({ metric, before, after }), nights.statistics);
    expect(direction("flip.mean", 0.1, 0.2)).toBe("worse");
    expect(direction("psnr", 31, 32)).toBe("better");
    expect(direction("bias.ev", -0.5, 0.2)).toBe("better");
    expect([direction("bias.ev", -0.2, 0.2), direction("psnr", null, 32), direction("odd", 1, 2), direction("psnr", 3, 3)]).toEqual(["", "", "", ""]);
  });
});

describe("rows", () => {
  const trend = (...runs: number[]): Trend => ({ figures: {}, verdicts: [], changes: runs.map((run) => ({ run, kind: "changed", cause: "", metric: "", before: null, after: null, figures: 0 })) });
  const rows = { "Spheres/auto/Chrome": trend(1, 2, 3), "Spheres/auto": trend(9), "Hall/north/Chrome": trend(4), "Hall/north": trend(4) };

  it("are found by every word of their names", () => {
    expect(rowsWith(rows, " chrome  SPHERES ").map(([name]) => name)).toEqual(["Spheres/auto/Chrome"]);
    expect(rowsWith(rows, "").length).toBe(4);
    expect(rowsWith(rows, "[")).toEqual([]);
  });

  it("are ordered by their last change, how many they have, or their name", () => {
    const names = (order: Parameters<typeof inOrder>[1]): string[] => inOrder(rowsWith(rows, ""), order).map(([name]) => name);
    expect(names("last change")).toEqual(["Spheres/auto", "Hall/north", "Hall/north/Chrome", "Spheres/auto/Chrome"]);
    expect(names("most changes")[0]).toBe("Spheres/auto/Chrome");
    expect(names("name")).toEqual(["Hall/north", "Hall/north/Chrome", "Spheres/auto", "Spheres/auto/Chrome"]);
  });

  it("have the mean of FLIP first", () => {
    expect(figuresOf({ figures: { psnr: [], "flip.p95": [], "flip.mean": [] }, verdicts: [], changes: [] })).toEqual(["flip.mean", "flip.p95", "psnr"]);
  });

  it("have a small trend of steps, with gaps", () => {
    const of = (...spans: [number, number, number | null][]): string => trendPath({ figures: { f: spans }, verdicts: [], changes: [] }, "f", 10, 100, 23);
    expect(of([0, 4, 1], [5, 6, 2], [9, 9, 1])).toBe("M0 21.5H50V1.5H70M90 21.5H100");
    expect(of([0, 1, 1], [2, 3, null], [4, 9, 1])).toBe("M0 11.5H20M40 11.5H100");
    expect([of(), of([0, 9, null])]).toEqual(["", ""]);
  });
});

describe("the lines of charts", () => {
  const runs = [makeNight(0, { failed: 1 }), makeNight(1, { failed: 2, isWhole: false, machine: "b", cpuS: 5 }), makeNight(2, { failed: 3, isComplete: false, worst: null }), makeNight(3, { failed: 4, meanFlip: null, machine: "b", cpuS: null })];

  it("leave out what is no whole night", () => {
    expect(countLines(runs).map(({ values }) => values[1])).toEqual([null, null]);
    expect(countLines(runs)[0]?.values).toEqual([1, null, null, 4]);
    expect(flipLines(runs)[1]?.values).toEqual([0.031, null, null, null]);
  });

  it("are of each machine for the cost, those beyond the colours together", () => {
    expect(costLines(runs).map(({ label, values }) => [label, values])).toEqual([["AMD EPYC 7763", [600, null, 600, null]], ["b", [null, 5, null, null]]]);
    const many = Array.from({ length: 9 }, (_, i) => makeNight(i, { machine: `m${i}` }));
    const lines = costLines(many);
    expect(lines.map(({ label }) => label)).toEqual(["m0", "m1", "m2", "m3", "m4", "4 other machines"]);
    expect(many.every((_, run) => lines.filter(({ values }) => values[run] !== null).length === 1)).toBe(true);
    expect(costLines([makeNight(0)])[0]?.isScattered).toBe(false);
  });

  it("have lanes of what is grave, where it happened", () => {
    const all: Record<string, number>[] = [{}, { regressed: 2, changed: 1 }, { crashed: 1 }, { regressed: 1 }];
    const events = all.map((each, i) => makeNight(i, { events: each }));
    expect(lanesOf(events).map(({ kind, runs: at }) => [kind, at])).toEqual([["crashed", [2]], ["regressed", [1, 3]]]);
  });
});

describe("machines and times", () => {
  it("are grouped by machine, device and build, the last used first, with the median of what is known", () => {
    const runs = [makeNight(0, { cpuS: 3, build: "x" }), makeNight(1, { machine: "b" }), makeNight(2, { cpuS: null, build: "x" }), makeNight(3, { cpuS: 5, build: "x" }), makeNight(4, { cpuS: null, build: "y" })];
    expect(machinesOf(runs).map(({ machine, build, nights: number, first, last, cpuS }) => [machine, build[0], number, runs.indexOf(first), runs.indexOf(last), cpuS])).toEqual([["AMD EPYC 7763", "y", 1, 4, 4, null], ["AMD EPYC 7763", "x", 3, 0, 3, 4], ["b", makeNight(1).build[0], 1, 1, 1, 600]]);
    expect(machinesOf([])).toEqual([]);
  });

  it("have the newest step first", () => {
    const step = (run: number, beforeMs: number, nowMs: number) => ({ scene: "s", machine: "m", run, beforeMs, nowMs });
    expect(stepsOf([step(1, 1, 9), step(5, 10, 11), step(5, 10, 2)])).toEqual([step(5, 10, 2), step(5, 10, 11), step(1, 1, 9)]);
    expect([shareOf(step(1, 10, 12)), shareOf(step(1, 0, 5))]).toEqual([expect.closeTo(0.2), null]);
  });
});

describe("a link", () => {
  it("brings back what its sender saw, whatever the names hold", () => {
    for (const shown of [{ night: "", row: "", figure: "" }, { night: "20261123T030012Z-93", row: "a&b=#/ü %/x", figure: "flip.p95" }]) expect(shownBy(linkOf(shown))).toEqual(shown);
    expect(linkOf({ night: "n", row: "", figure: "f" })).toBe("#night=n");
    expect(shownBy("#zoom=3")).toEqual({ night: "", row: "", figure: "" });
  });
});
