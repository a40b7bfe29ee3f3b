import { describe, expect, it } from "vitest";

import { historyOf, problemOf } from "../../src/data/page";
import { kSchema } from "../../src/data/types";
import { packOverview } from "../pack_overview";
import { makeReport } from "./sample";

const list = packOverview(makeReport([]));

describe("the runs before a report", () => {
  const run = { name: "a.json.gz", started: "2026-11-21T00:00:00Z", commit: "", verdict: "pass" };
  const history = { format: 1, suite: "nightly", branch: "main", runs: [run] };

  it("are read, and left out where they are not of this form", () => {
    expect(historyOf(history)).toBe(history);
    for (const broken of [null, 3, [], { ...history, format: 2 }, { ...history, runs: 3 }, { ...history, runs: [] }, { ...history, runs: [null] }, { ...history, runs: [{ ...run, started: 1 }] }, { ...history, branch: undefined }])
      expect(historyOf(broken)).toBeNull();
  });
});

describe("a report that the page reads", () => {
  it("is of this page's schema version: an older one is refused in words that name both", () => {
    expect(problemOf(makeReport([]), list)).toBe("");
    expect(problemOf({ ...makeReport([]), schema: 2 }, list)).toContain(`schema version 2; this page reads version ${kSchema}.`);
    expect(problemOf({ ...makeReport([]), schema: undefined }, list)).toMatch(/schema version unknown/);
  });

  it("is whole", () => {
    expect(problemOf(null, list)).toMatch(/no report/);
    expect(problemOf({ ...makeReport([]), settings: {} }, list)).toMatch(/not complete/);
    for (const broken of [null, {}, { ...list, texts: 3 }, { ...list, rows: { count: 1 } }]) expect(problemOf(makeReport([]), broken)).toMatch(/list of its rows is not complete/);
  });
});
