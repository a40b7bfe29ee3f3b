import { describe, expect, it } from "vitest";

import { parseBench } from "../../src/data/bench";
import { frontOf, seriesOf } from "../../src/item/bench_plot";

const variant = (path: string, timeMs: number | null, error: number): object => ({
  path, name: "x", timeMs: { device: { median: timeMs, low: timeMs, high: timeMs } }, error: { truth: { "flip.mean": error }, highend: { "flip.mean": 9 } }, dominated: false,
});
const bench = (variants: object[]): unknown => ({ scenes: [{ scene: "a", variants }], conclusions: { against: "reference", figure: "flip.mean" } });

describe("bench.json", () => {
  it("gives points of the error that its conclusions name, without those that were not timed", () => {
    const parsed = parseBench(bench([variant("mobile", 2, 0.1), variant("mobile", null, 0.2)]));
    expect(parsed?.against).toBe("reference");
    expect(parsed?.scenes[0]?.points).toEqual([{ name: "mobile x", path: "mobile", timeMs: 2, low: 2, high: 2, error: 0.1, dominated: false }]);
  });

  it("is nothing where it is something else", () => {
    for (const value of [null, 3, "x", [], {}, { scenes: 1 }, { scenes: [null, { variants: [1] }] }]) expect(parseBench(value)).toBeNull();
  });
});

describe("the front", () => {
  const points = parseBench(bench([variant("m", 3, 0.1), variant("m", 1, 0.5), variant("m", 2, 0.6), variant("m", 2, 0.3)]))?.scenes[0]?.points ?? [];

  it("has what none beats in both", () => {
    expect(frontOf(points).map((point) => [point.timeMs, point.error])).toEqual([[1, 0.5], [2, 0.3], [3, 0.1]]);
  });

  it("is a series beside the points, by time", () => {
    const { x, ys } = seriesOf(points, ["m"]);
    expect(x).toEqual([1, 2, 2, 3]);
    expect(ys[0]).toEqual([0.5, 0.6, 0.3, 0.1]);
    expect(ys[1]).toEqual([0.5, null, 0.3, 0.1]);
  });
});
