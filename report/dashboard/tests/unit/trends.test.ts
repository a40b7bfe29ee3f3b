import { describe, expect, it } from "vitest";

import type { EarlierRun, ValueSpan } from "../../src/data/history";
import { dayOf, labelledPlaces, limitLines, placesOf, rangeOfValues, runInText, runTitle, stepsOf, valueAt } from "../../src/data/trends";

const spans: ValueSpan[] = [[0, 1, 0.1], [3, 3, 0.2]];
const run: EarlierRun = { name: "r.json.gz", started: "2026-11-21T01:02:03Z", commit: "010e2b14a5531234", verdict: "pass" };

describe("a run", () => {
  it("is called by its day and commit, else by its file", () => {
    expect(dayOf(run)).toBe("2026-11-21");
    expect(runTitle(run)).toBe("2026-11-21, 010e2b14a553");
    expect(runInText(run)).toBe("2026-11-21 (010e2b14a553)");
    expect(runInText({ ...run, commit: "" })).toBe("2026-11-21");
    expect(runTitle({ ...run, commit: "" })).toBe("2026-11-21");
    expect(runTitle({ ...run, commit: "", started: "" })).toBe("r.json.gz");
    expect(runTitle(undefined)).toBe("unknown run");
  });
});

describe("the chart of a figure", () => {
  it("has a step for each run, and a gap where a run has no value or none that is a number", () => {
    const series = [{ label: "a", spans }];
    expect(stepsOf(4, series)).toEqual({ x: [-0.5, 0.5, 0.5, 1.5, 1.5, 2.5, 2.5, 3.5], y: [[0.1, 0.1, 0.1, 0.1, null, null, 0.2, 0.2]] });
    expect(stepsOf(1, [{ label: "a", spans: [[0, 0, null]] }]).y).toEqual([[null, null]]);
    expect([valueAt(spans, 1), valueAt(spans, 2), valueAt([[0, 0, null]], 0)]).toEqual([0.1, undefined, null]);
  });

  it("has today's value behind the runs", () => {
    const series = [{ label: "a", spans, today: 0.3 }, { label: "b", spans: [] }];
    expect(placesOf(4, series)).toBe(5);
    expect(stepsOf(4, series).y.map((values) => values.slice(8))).toEqual([[0.3, 0.3], [null, null]]);
    expect(placesOf(4, [{ label: "a", spans }])).toBe(4);
  });

  it("stays whole where spans leave the runs", () => {
    expect(stepsOf(2, [{ label: "a", spans: [[-3, 9, 1]], today: 2 }]).y).toEqual([[1, 1, 1, 1, 2, 2]]);
  });

  it("has lines at its limits, on both sides of 0 for a size, and none that would press the values flat", () => {
    const series = [{ label: "a", spans }];
    expect(limitLines({ warn: 0.1, fail: 0.2 }, series)).toEqual([{ kind: "warn", value: 0.1 }, { kind: "fail", value: 0.2 }]);
    expect(limitLines({ warn: null, fail: 0.5, isAbsolute: true }, series)).toEqual([{ kind: "fail", value: 0.5 }, { kind: "fail", value: -0.5 }]);
    expect(limitLines({ warn: 0.1, fail: 5 }, series)).toEqual([{ kind: "warn", value: 0.1 }]);
    expect(limitLines(null, series)).toEqual([]);
  });

  it("begins at 0 where its values are not far from it", () => {
    expect(rangeOfValues([0.1, null, 0.5])).toEqual([0, 0.5 + 0.04]);
    expect(rangeOfValues([])).toEqual([0, 1]);
    const [least, most] = rangeOfValues([40, 41]);
    expect(least).toBeLessThan(40);
    expect(least).toBeGreaterThan(39);
    expect(most).toBeGreaterThan(41);
    expect(rangeOfValues([0, 0])[1]).toBeGreaterThan(0);
  });

  it("has dates for some of its places, the last one among them", () => {
    expect(labelledPlaces(3, 10)).toEqual([0, 1, 2]);
    expect(labelledPlaces(10, 4)).toEqual([0, 3, 6, 9]);
    expect(labelledPlaces(365, 6)).toHaveLength(6);
    expect(labelledPlaces(365, 6).at(-1)).toBe(364);
    expect(labelledPlaces(0, 4)).toEqual([]);
  });
});
