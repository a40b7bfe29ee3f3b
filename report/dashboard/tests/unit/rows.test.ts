import { describe, expect, it } from "vitest";

import { countRows, filterOf, matcherOf, sortRows } from "../../src/data/filter";
import { gravityOf } from "../../src/data/gravity";
import { linkNames } from "../../src/data/overview";
import { baseLayerText, checkOf, figureOf, findRow } from "../../src/data/rows";
import { kDefaultState } from "../../src/data/state";
import type { Check, Material, Report, Verdict } from "../../src/data/types";
import { makeFigures, makeMaterial, makeReport, makeScene, makeView } from "./sample";
import { overviewOf, rowsOf } from "../pack_overview";

const attribution = { flip: 0.4, terms: [{ term: "skySpecular", flip: 0.1 }, { term: "sunDiffuse", flip: 0.39 }] };
const report = makeReport([
  makeScene("Desk", [
    makeView("front", [
      makeMaterial("Gold", "fail", 0.4, { attribution, reason: "mean FLIP is above" }),
      makeMaterial("Wood", "pass", 0.02),
      makeMaterial("Inside", "not seen", null),
      makeMaterial("Elsewhere", "not seen", null, { seenElsewhere: true }),
    ]),
  ]),
  makeScene("Broken", [], "is not a glTF"),
]);
const rows = rowsOf(report);
const shownOf = (of: Report, patch: object): string[] => rowsOf(of).filter(matcherOf(overviewOf(of), filterOf({ ...kDefaultState, ...patch }))).map((row) => row.name);
const shown = (patch: object): string[] => shownOf(report, patch);

describe("rows", () => {
  it("has one for each material that counts, each whole image and each scene that failed", () => {
    expect(rows.map((row) => [row.kind, row.name])).toEqual([
      ["material", "Gold"], ["material", "Wood"], ["material", "Inside"], ["whole", "Desk · front"], ["scene", "Broken"],
    ]);
  });

  it("counts the pixels that show it: none where there are no figures", () => {
    expect(rows[0]?.pixels).toBe(100);
    expect(rows[2]?.pixels).toBe(0);
  });

  it("says since the baseline what there is to compare with, and what is new", () => {
    const since = (patch: object) => rowsOf(makeReport([makeScene("Desk", [makeView("front", [makeMaterial("Gold", "pass", 0.1, patch)])])]))[0];
    const changes = { "flip.mean": 0.03 };
    expect(since({ baseline: { new: false, verdict: "pass", notComparable: "", changes } })).toMatchObject({ change: 0.03, changes: ["worse"] });
    expect(since({ baseline: { new: true, verdict: null, notComparable: "", changes: {} } })).toMatchObject({ change: null, changes: ["added"] });
    expect(since({})).toMatchObject({ change: null, changes: [] });
  });
});

describe("the standing of rows", () => {
  const approval = { origin: "a.toml:1", state: "holds" as const, value: 0.3, slack: 0, until: "2027-02-01", daysLeft: 9, owner: "characters", reason: "refit", words: "" };
  const owned = { rule: "b.toml:1", preset: "", reason: "", owner: "props", requireSeen: false, minPixels: 64 };
  const failing = (name: string): Material => makeMaterial(name, "fail", 0.4, { budget: owned });
  const over = makeReport([
    makeScene("Desk", [
      makeView("front", [
        failing("Gold"), failing("Iron"), failing("Wax"), makeMaterial("Wood", "pass", 0.1),
        makeMaterial("Tin", "pass", 0.3, { accepted: "approved", checks: [{ metric: "flip.mean", regress: false, value: 0.3, warn: 0.1, fail: 0.2, verdict: "fail", note: "", approval }] }),
      ]),
    ]),
    makeScene("Broken", [], "is not a glTF"),
  ]);
  const runs = { 0: { standing: "new", nights: 1 }, 1: { standing: "still", nights: 12 }, 2: { standing: "flaky", nights: 3 }, 3: { standing: "fixed" } } as const;
  const all = rowsOf(over, runs);

  it("comes with the nights that it fails for, and with its owner: of its approval, else of its budget", () => {
    expect(all.map(({ name, standing, nights, owner }) => [name, standing, nights, owner])).toEqual([
      ["Gold", "new", 1, "props"], ["Iron", "still", 12, "props"], ["Wax", "flaky", 3, "props"], ["Wood", "fixed", 0, ""], ["Tin", "accepted", 0, "characters"],
      ["Desk · front", "", 0, ""], ["Broken", "", 0, ""],
    ]);
    expect(rowsOf(over)[0]).toMatchObject({ standing: "unknown", changes: [] });
  });

  it("filters and sorts, and its owner is found", () => {
    const shownOver = (patch: object): string[] => all.filter(matcherOf(overviewOf(over, runs), filterOf({ ...kDefaultState, ...patch }))).map((row) => row.name);
    expect(shownOver({ changes: ["new", "flaky"] })).toEqual(["Gold", "Wax"]);
    expect(shownOver({ changes: ["still"] })).toEqual(["Iron"]);
    expect(shownOver({ changes: ["accepted"] })).toEqual(["Tin"]);
    expect(shownOver({ query: "characters" })).toEqual(["Tin"]);
    expect(sortRows(all, "nights", false).map((row) => row.name).slice(0, 3)).toEqual(["Iron", "Wax", "Gold"]);
  });
});

describe("the names of links", () => {
  const linksOf = linkNames;

  it("tell apart what is called the same, and are never empty", () => {
    expect(linksOf(["gold", "gold", "", "gold (2)", "gold"])).toEqual(["gold", "gold (2)", "(no name)", "gold (2) (2)", "gold (3)"]);
  });

  it("stay where something else comes before: a link leads to the same material of another run", () => {
    const gold = makeMaterial("Gold", "pass", 0.1);
    const linkOf = (materials: Material[]) => rowsOf(makeReport([makeScene("Desk", [makeView("front", materials)])])).find((row) => row.name === "Gold")?.link;
    expect(linkOf([gold])).toEqual({ scene: "Desk", view: "front", material: "Gold" });
    expect(linkOf([makeMaterial("Iron", "pass", 0.1), gold])).toEqual(linkOf([gold]));
  });
});

describe("a link", () => {
  const find = (scene: string, view = "", material = ""): string | undefined => findRow(overviewOf(report), rows, { scene, view, material })?.name;

  it("leads to the row of a material, a whole image or a scene that failed", () => {
    expect([find("Desk", "front", "Gold"), find("Desk", "front"), find("Broken")]).toEqual(["Gold", "Desk · front", "Broken"]);
    for (const row of rows) expect(findRow(overviewOf(report), rows, row.link)).toBe(row);
  });

  it("leads nowhere where the report does not have it, or no row shows it", () => {
    for (const names of [["Sofa"], ["Desk"], ["Desk", "back"], ["Desk", "front", "Tin"], ["Desk", "front", "Elsewhere"], ["", "front"]] as const) expect(find(...(names as [string])), names.join()).toBeUndefined();
  });
});

describe("a row's words", () => {
  it("have real minus signs, are found with either, and leave what is accepted to itself", () => {
    const reason = "mean exposure difference -0.28 EV is beyond ±0.25 EV";
    const report = makeReport([makeScene("Desk", [makeView("front", [makeMaterial("Gold", "warn", 0.1, { reason, accepted: "2 pixels are NaN" })])])]);
    const [row] = rowsOf(report);
    if (!row) throw new Error("a row");
    expect(row.reason).toBe("mean exposure difference \u22120.28 EV is beyond ±0.25 EV");
    expect(row.accepted).toBe("2 pixels are NaN");
    for (const query of ["-0.28", "\u22120.28", "accepted"]) expect(shownOf(report, { query }), query).toEqual(["Gold"]);
  });
});

describe("a row's figures", () => {
  const check = (metric: string, value: number | null, regress: boolean): Check => ({ metric, regress, value, warn: 0.1, fail: 0.2, verdict: regress ? "pass" : "warn", note: "" });
  const checks = [check("flip.mean", 0.01, true), check("flip.mean", 0.15, false), check("bias.ev", -0.3, false)];
  const view = makeView("front", [makeMaterial("Gold", "pass", 0, { figures: makeFigures(0.15), checks })]);
  Object.assign(view.whole, { figures: makeFigures(0.05), checks: [] });
  const [material, whole] = rowsOf(makeReport([makeScene("Desk", [view])]));
  if (!material || !whole) throw new Error("two rows");

  it("are the material's and the whole image's", () => {
    expect(figureOf(material, "flip.mean")).toBe(0.15);
    expect(figureOf(whole, "flip.mean")).toBe(0.05);
    expect(figureOf(whole, "flip.p95")).toBeNull();
  });

  it("are held against the check of the figure, never against that of its regression", () => {
    expect(checkOf(material, "flip.mean")).toEqual({ metric: "flip.mean", warn: 0.1, fail: 0.2, verdict: "warn" });
    expect(checkOf(material, "bias.ev")?.metric).toBe("bias.ev");
    expect(checkOf(whole, "flip.mean")).toBeNull();
  });
});

describe("the cause", () => {
  it("is the term whose swap lowers FLIP most", () => {
    expect(rows[0]?.cause).toEqual({ term: "skySpecular", before: 0.4, after: 0.1 });
  });

  it("is none where the report did not look for it, or found none", () => {
    expect(rows.map((row) => row.noCause)).toEqual(["", "cause not measured", "not seen in any view", "", ""]);
    expect(rows.slice(1).map((row) => row.cause)).toEqual([null, null, null, null]);
  });
});

describe("the filter", () => {
  it("shows materials or views, and scenes that failed in both", () => {
    expect(shown({})).toEqual(["Gold", "Wood", "Inside", "Broken"]);
    expect(shown({ list: "views" })).toEqual(["Desk · front", "Broken"]);
  });

  it("needs every word, in the name, the place, the reason or the cause", () => {
    expect(shown({ query: "desk GOLD" })).toEqual(["Gold"]);
    expect(shown({ query: "above" })).toEqual(["Gold"]);
    expect(shown({ query: "skyspec" })).toEqual(["Gold"]);
    expect(shown({ query: "gold wood" })).toEqual([]);
  });

  it("narrows by verdict, cause and preset", () => {
    expect(shown({ verdicts: ["fail", "not seen"] })).toEqual(["Gold", "Inside"]);
    expect(shown({ causedBy: "skySpecular" })).toEqual(["Gold"]);
    expect(shown({ causedBy: "fog" })).toEqual([]);
    expect(shown({ preset: "default" })).toEqual(["Gold", "Wood", "Inside"]);
  });

  it("counts by verdict", () => {
    expect(countRows(rows)).toEqual({ fail: 1, pass: 2, "not seen": 1, error: 1 });
  });
});

describe("the order", () => {
  const names = (key: string, ascending = false): string[] => sortRows(rows, key, ascending).map((row) => row.name);

  it("has the gravest first, and the worse FLIP first among equals", () => {
    expect(names("gravity")).toEqual(["Broken", "Gold", "Inside", "Wood", "Desk · front"]);
  });

  it("has what is not known last, whichever way", () => {
    expect(names("flip.mean").slice(0, 3)).toEqual(["Gold", "Wood", "Desk · front"]);
    expect(names("flip.mean", true).slice(0, 3)).toEqual(["Desk · front", "Wood", "Gold"]);
  });

  it("sorts names by letter and keeps the list it was given", () => {
    expect(names("name", true)).toEqual(["Broken", "Desk · front", "Gold", "Inside", "Wood"]);
    expect(rows[0]?.name).toBe("Gold");
  });
});

describe("what is neither passed nor failed", () => {
  const graver: Verdict[] = ["pass", "not seen", "too small", "not judged", "warn", "fail", "not run", "error"];
  const materials = [
    makeMaterial("Seen", "pass", 0.01),
    makeMaterial("Hidden", "not seen", null),
    makeMaterial("Speck", "too small", 0.3, { figures: makeFigures(0.3, { pixels: 12 }) }),
    makeMaterial("Lamp", "not judged", 0.02, { figures: makeFigures(0.02, { clippedWhite: 0.8 }) }),
    makeMaterial("Coat", "warn", 0.03, { notModelled: ["clearcoat", "sheen"] }),
    makeMaterial("Bad", "fail", 0.3, { notModelled: ["clearcoat"], reason: "mean FLIP is above" }),
  ];
  const desk = makeReport([makeScene("Desk", [makeView("front", materials)])]);
  const small = rowsOf(desk).filter((row) => row.kind === "material");
  const found = (patch: object): string[] => shownOf(desk, patch);

  it("weighs between what is seen and what is warned of, in the order of the report's verdicts", () => {
    for (let i = 1; i < graver.length; ++i) expect(gravityOf(graver[i]!), graver[i]).toBeGreaterThan(gravityOf(graver[i - 1]!));
    expect(sortRows(small, "gravity", false).map((row) => row.name)).toEqual(["Bad", "Coat", "Lamp", "Speck", "Hidden", "Seen"]);
  });

  it("of a scene that a signal kept from being done is not run", () => {
    const broken = makeScene("Desk", [], "it is broken");
    const stopped = { ...broken, error: { message: "SIGINT interrupted the run", exitCode: 130 } };
    expect(rowsOf(makeReport([broken, stopped])).map(({ verdict }) => verdict)).toEqual(["error", "not run"]);
  });

  it("is as grave as an error where the page does not know the verdict", () => {
    expect(gravityOf("unheard of" as Verdict)).toBe(gravityOf("error"));
  });

  it("is filtered and counted by its own verdict", () => {
    expect(found({ verdicts: ["too small"] })).toEqual(["Speck"]);
    expect(found({ verdicts: ["not judged"] })).toEqual(["Lamp"]);
    expect(countRows(small)).toEqual({ pass: 1, "not seen": 1, "too small": 1, "not judged": 1, warn: 1, fail: 1 });
  });

  it("says and finds what no path models, whatever the verdict is", () => {
    expect(baseLayerText(["clearcoat", "sheen"])).toBe("base layer only: parity does not model clearcoat, sheen");
    expect(baseLayerText([])).toBe("");
    expect(found({ query: "clearcoat" })).toEqual(["Coat", "Bad"]);
    expect(found({ query: "base layer" })).toEqual(["Coat", "Bad"]);
    expect(small.map((row) => row.notModelled.length)).toEqual([0, 0, 0, 0, 2, 1]);
  });
});
