import { describe, expect, it } from "vitest";

import { countOf, typeset } from "../../src/data/wording";

describe("texts of the report", () => {
  it("get a real minus before numbers, and none before a zero", () => {
    expect(typeset("mean exposure difference -0.28 EV is beyond ±0.25 EV")).toBe("mean exposure difference \u22120.28 EV is beyond ±0.25 EV");
    expect(typeset("is darker on average (dL* -4.0)")).toBe("is darker on average (dL* \u22124.0)");
    expect(typeset("is as bright on average (dL* -0.0)")).toBe("is as bright on average (dL* 0.0)");
    expect(typeset("+0.00 EV instead of -0.31 EV")).toBe("0.00 EV instead of \u22120.31 EV");
    expect(typeset("-0.05, +0.05, -.5")).toBe("\u22120.05, +0.05, \u2212.5");
  });

  it("keep the hyphens of names, options and exponents", () => {
    for (const text of ["high-end", "material-2", "ue4-2020", "--size 1-2", "1e-7", "sun 30,-50"]) expect(typeset(text)).toBe(text);
  });
});

describe("a number of things", () => {
  it("has the singular for one", () => {
    expect([countOf(1, "rows"), countOf(1, "environments"), countOf(1, "meshes"), countOf(1, "images"), countOf(1, "pictures")]).toEqual([
      "1 row", "1 environment", "1 mesh", "1 image", "1 picture",
    ]);
    expect([countOf(0, "rows"), countOf(2, "meshes"), countOf(1234567, "samples")]).toEqual(["0 rows", "2 meshes", "1,234,567 samples"]);
  });
});
