import { describe, expect, it } from "vitest";

import { fromHash, kDefaultState, toHash, type State } from "../../src/data/state";

describe("the hash", () => {
  it("is empty for what is shown at first", () => {
    expect(toHash({ ...kDefaultState })).toBe("");
    expect(fromHash("")).toEqual(kDefaultState);
  });

  it("holds the whole state: what it says is read back", () => {
    const state: State = {
      mode: "onion", exposure: -2.5, threshold: 0.125, gain: 8, split: 0.25, opacity: 0.75, zoom: 3.5, panX: 0.1, panY: 0.9, pixelX: 12,
      pixelY: 0, term: "skySpecular", showTruth: true, showBaseline: true, dimOthers: false, scene: "Lamp & desk", view: "front", material: "twice (2)", tab: "terms", list: "views",
      query: "<b>&#x41; ü %", verdicts: ["fail", "not seen"], causedBy: "fog", preset: "hero", sort: "flip.p95", ascending: true,
    };
    for (const key of Object.keys(kDefaultState) as (keyof State)[]) expect(state[key], key).not.toEqual(kDefaultState[key]);
    expect(fromHash(toHash(state))).toEqual(state);
  });

  it("takes nothing that is out of range, no number, or no such mode", () => {
    for (const hash of ["#exposure=99", "#exposure=NaN", "#zoom=", "#zoom=1e9", "#mode=evil", "#tab=x", "#list=x", "#none=1", "#pixelX=Infinity"])
      expect(fromHash(hash), hash).toEqual(kDefaultState);
  });
});
