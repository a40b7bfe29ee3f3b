import { describe, expect, it } from "vitest";

import { problemOf } from "../../src/data/page";
import { kSchema } from "../../src/data/types";
import { makeReport } from "./sample";

describe("a report that the page reads", () => {
  it("is of this page's schema version: an older one is refused in words that name both", () => {
    expect(problemOf(makeReport([]))).toBe("");
    expect(problemOf({ ...makeReport([]), schema: 2 })).toContain(`schema version 2; this page reads version ${kSchema}.`);
    expect(problemOf({ ...makeReport([]), schema: undefined })).toMatch(/schema version unknown/);
  });

  it("is whole", () => {
    expect(problemOf(null)).toMatch(/no report/);
    expect(problemOf({ ...makeReport([]), scenes: {} })).toMatch(/not complete/);
  });
});
