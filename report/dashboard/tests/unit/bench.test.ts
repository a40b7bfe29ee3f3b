import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";

import { sweepOf } from "../../src/data/bench";
import { sorted } from "../../src/study/table";

const bench = JSON.parse(readFileSync(new URL("../../../../tests/dashboard/bench.json", import.meta.url), "utf8")) as object;

describe("bench.json", () => {
  it("is read with its pictures, or without any", () => {
    expect(sweepOf(bench, [[]])?.bench.scenes[0]).toMatchObject({ scene: "spheres" });
    expect(sweepOf(bench, null)?.plots).toEqual([]);
  });

  it("is nothing where it is something else, or of another form", () => {
    for (const value of [null, 3, "x", [], {}, { schema: 2 }, { schema: 2, scenes: 1 }, { ...bench, schema: 1 }]) expect(sweepOf(value, null)).toBeNull();
  });
});

describe("the rows of a table", () => {
  const rows = [{ name: "b10", n: 2 }, { name: "b9", n: null }, { name: "a", n: 2 }, { name: "c", n: -1 }];
  const names = (by: (row: (typeof rows)[0]) => string | number | null, ascending: boolean): string[] => sorted(rows, by, ascending).map((row) => row.name);

  it("are sorted as numbers, equal ones as they were, those without one last", () => {
    expect(names((row) => row.n, true)).toEqual(["c", "b10", "a", "b9"]);
    expect(names((row) => row.n, false)).toEqual(["b10", "a", "c", "b9"]);
  });

  it("are sorted as words, numbers in them by their size", () => {
    expect(names((row) => row.name, true)).toEqual(["a", "b9", "b10", "c"]);
  });
});
